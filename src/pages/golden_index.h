#pragma once

#include <string>
#include <vector>

#include "compare/check.h"
#include "picture/image.h"

namespace sandstroke {

/// A scene that was checked against its golden entry.
struct GoldenVerdict {
  Comparison comparison;
  Image picture = {};  ///< of the run; empty: it was not drawn
  bool page = false;   ///< NAME.html lies beside the index
};

/// A page on all scenes: the worst first, each with its picture, its verdict and its worst check.
std::string golden_index(const std::vector<GoldenVerdict>& scenes);

}  // namespace sandstroke
