#include "sand/tile_patch.h"

namespace sandstroke {

TilePatch::TilePatch() {
  heights_.fill(std::numeric_limits<double>::quiet_NaN());
  factors_.fill(0.0);
}

TilePatch& TilePatch::of_this_thread() {
  thread_local TilePatch patch;
  return patch;
}

}  // namespace sandstroke
