#pragma once

#include "picture/image.h"

namespace sandstroke {

/// Shrinks a picture to `width`. Each pixel is the mean of those that it covers. A narrower picture stays as
/// it is.
Image shrunk(const Image& picture, int width);

}  // namespace sandstroke
