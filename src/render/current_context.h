#pragma once

#include <atomic>
#include <memory>

#include "render/offscreen_context.h"

namespace sandstroke {

/// A context that is current once it is constructed: members that follow it may use GL.
class CurrentContext {
 public:
  /// Error: io, as make_offscreen_context; input, where memory is short.
  CurrentContext();
  void make_current() { context_->make_current(); }

 private:
  /// Counts the living objects.
  struct Living {
    Living() { ++count; }
    ~Living() { --count; }
    static inline std::atomic<int> count = 0;
  };

  Living living_;
  std::unique_ptr<OffscreenContext> context_;
};

}  // namespace sandstroke
