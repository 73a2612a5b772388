#include "haptics/repeated_samples.h"

#include <algorithm>

#include "haptics/stroke_pieces.h"

namespace sandstroke {
namespace {

/// Runs of equal positions (and pen states) within joined pieces.
std::vector<StrokePiece> equal_runs(const Stroke& stroke) {
  const auto repeats = [&](std::size_t i) {
    return stroke.position[i] == stroke.position[i - 1] &&
           (stroke.contact.empty() || stroke.contact[i] == stroke.contact[i - 1]);
  };
  std::vector<StrokePiece> runs;
  for (const StrokePiece& piece : joined_pieces(stroke))
    for (std::size_t begin = piece.begin, end = begin; begin < piece.end; begin = end) {
      ++end;
      while (end < piece.end && repeats(end)) ++end;
      runs.push_back({begin, end});
    }
  return runs;
}

std::size_t usual_size(const std::vector<StrokePiece>& runs) {
  std::vector<std::size_t> sizes;
  for (const StrokePiece& run : runs) sizes.push_back(run.size());
  const auto longest = sizes.begin() + static_cast<std::ptrdiff_t>((sizes.size() - 1) * 9 / 10);
  std::nth_element(sizes.begin(), longest, sizes.end());
  return *longest;
}

}  // namespace

Repeats repeats_of(const Stroke& stroke) {
  const std::vector<StrokePiece> runs = equal_runs(stroke);
  return {1.0 - static_cast<double>(runs.size()) / static_cast<double>(stroke.size()), usual_size(runs)};
}

Stroke without_repeated_samples(const Stroke& stroke) {
  const std::vector<StrokePiece> runs = equal_runs(stroke);
  const std::size_t period = usual_size(runs);
  std::vector<std::size_t> kept;
  for (const StrokePiece& run : runs) {
    std::size_t due = run.begin;
    for (std::size_t i = run.begin; i < run.end; ++i) {
      const bool measured = i == run.begin || (i == due && run.end - i >= period);
      if (measured) due = i + period;
      if (measured || !stroke.joined(i) ||
          stroke.time[i + 1] - stroke.time[kept.back()] > stroke.gap_threshold)
        kept.push_back(i);
    }
  }
  Stroke thinned = stroke;
  keep_samples(thinned, kept);
  return thinned;
}

}  // namespace sandstroke
