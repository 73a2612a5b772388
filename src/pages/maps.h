#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "picture/image.h"
#include "render/colour_map.h"
#include "sand/height_field.h"

namespace sandstroke {

// A part of a page with maps of golden, run and their difference. All maps of a part have equally many pixels
// and show the same position in the same pixel. Where golden and run differ in shape this does not hold, and
// there is no map of the difference.

/// Two surfaces, or two changes of height, each with its initial one.
struct ComparedSurfaces {
  std::string title;  ///< "Final height"
  HeightField golden, golden_initial, run, run_initial;
  double limit = 0.0;                             ///< m; up to it they count as equal
  ColourScale colours = ColourScale::sequential;  ///< of the heights; diverging: white at zero
};

/// The part of the bed where sand was moved in one of them (by more than settled_fraction of its largest
/// change), or where they differ by more than the limit; with a margin. The whole bed where there is no such
/// part, or where a height is not finite; empty where they differ in shape.
CellRange shown_cells(const ComparedSurfaces& surfaces);

/// A part with maps of surfaces. The difference's colours span at least +-limit. Each spot shows its largest
/// difference, also as a number.
nlohmann::ordered_json surfaces_part(const ComparedSurfaces& surfaces);

/// A part with the estimated error [m] of each cell's height, where it is not 0, with a margin.
nlohmann::ordered_json error_map_part(const HeightField& errors);

/// A part with one picture. name: what it shows, such as "final surface".
nlohmann::ordered_json picture_part(const Image& picture, const std::string& name);

/// A part with two pictures. limit: of 255, in any channel of any pixel.
nlohmann::ordered_json pictures_part(const std::string& title, const Image& golden, const Image& run,
                                     int limit);

}  // namespace sandstroke
