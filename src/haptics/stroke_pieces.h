#pragma once

#include <cstddef>
#include <vector>

#include "haptics/stroke.h"

namespace sandstroke {

/// Samples begin to end - 1 of a stroke, all joined (Stroke::joined); one or more.
struct StrokePiece {
  std::size_t begin = 0, end = 0;

  std::size_t size() const { return end - begin; }
  double duration(const std::vector<double>& time) const { return time[end - 1] - time[begin]; }  ///< s
};

/// All pieces of a stroke, in order; a sample in the air is a piece of its own.
inline std::vector<StrokePiece> joined_pieces(const Stroke& stroke) {
  std::vector<StrokePiece> pieces;
  for (std::size_t begin = 0, end = 0; begin < stroke.size(); begin = end) {
    while (stroke.joined(end)) ++end;
    pieces.push_back({begin, ++end});
  }
  return pieces;
}

}  // namespace sandstroke
