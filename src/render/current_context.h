#pragma once

#include <atomic>
#include <memory>

#include "render/offscreen_context.h"

namespace sandstroke {

/// A context that is current from its construction on: what is made after it may use GL.
class CurrentContext {
 public:
  /// Error: io, as make_offscreen_context; input, where there is not the memory for it.
  CurrentContext();
  void make_current() { context_->make_current(); }

 private:
  /// Counts those that there are.
  struct Living {
    Living() { ++count; }
    ~Living() { --count; }
    static inline std::atomic<int> count = 0;
  };

  Living living_;
  std::unique_ptr<OffscreenContext> context_;
};

}  // namespace sandstroke
