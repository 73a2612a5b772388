#include "record/switch_press.h"

namespace sandstroke {

bool SwitchPress::pressed(std::uint32_t switches, std::int64_t time) noexcept {
  if ((switches >> number_ & 1U) == 0) {
    seen_up_ = true;
    down_since_.reset();
    return false;
  }
  if (!seen_up_) return false;
  if (!down_since_) down_since_ = time;
  return time - *down_since_ >= debounce_;
}

}  // namespace sandstroke
