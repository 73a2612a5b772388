#include "record/interlock.h"

namespace sandstroke {

void Interlock::see(double time, double force_due) noexcept {
  if (seen_ && time - *seen_ > longest_pause) close();
  seen_ = time;
  if (is_open()) return;
  if (!(force_due < least_force)) {
    clear_since_.reset();
    return;
  }
  if (!clear_since_) clear_since_ = time;
  if (time - *clear_since_ >= clear_time_) open_since_ = time;
}

void Interlock::close() noexcept {
  clear_since_.reset();
  open_since_.reset();
}

}  // namespace sandstroke
