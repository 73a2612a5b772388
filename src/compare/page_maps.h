#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "picture/image.h"
#include "sand/height_field.h"

namespace sandstroke {

// Golden, run and their difference as maps: a part of a page. All maps of a part have equally many pixels and
// show the same place in the same pixel, unless golden and run differ in shape: then there is no difference.

/// Two surfaces, or two changes of height, each with what it was initially.
struct ComparedSurfaces {
  std::string title;  ///< "Final height"
  HeightField golden, golden_initial, run, run_initial;
  double limit = 0.0;        ///< m, up to which they count as equal
  bool around_zero = false;  ///< colours of heights: from blue to red, with white at zero
};

/// The part of the bed where sand was moved in one of them (by more than what settles around it), or where
/// they differ by more than the limit; with a margin. The whole bed where there is no such part, and where a
/// height is not finite; empty where they differ in shape.
CellRange shown_cells(const ComparedSurfaces& surfaces);

/// The difference's colours span at least +-limit; each of its spots shows its largest difference, and has it
/// as a number too.
nlohmann::ordered_json surfaces_part(const ComparedSurfaces& surfaces);

/// One picture, and what it shows: "final surface".
nlohmann::ordered_json picture_part(const Image& picture, const std::string& name);

/// Two pictures; limit: of 255, in any channel of any pixel.
nlohmann::ordered_json pictures_part(const std::string& title, const Image& golden, const Image& run,
                                     int limit);

}  // namespace sandstroke
