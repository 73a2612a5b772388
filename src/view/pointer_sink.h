#pragma once

#include <span>

#include "view/messages.h"

namespace sandstroke {

/// Takes what a pointer in a page does. Called by the server's thread.
class PointerSink {
 public:
  virtual ~PointerSink() = default;
  /// Takes samples that just came from the page whose pointer is the hand.
  virtual void take(std::span<const PointerSample> samples) = 0;
  /// That page is gone.
  virtual void leave() = 0;
};

}  // namespace sandstroke
