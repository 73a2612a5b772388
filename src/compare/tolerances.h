#pragma once

#include <array>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "core/range.h"

namespace sandstroke {

/// How far apart two runs may be and still count as equal.
struct Tolerances {
  double height = 1e-6;       ///< m, any cell
  double force = 1e-4;        ///< N, on the device, any tick
  double depth = 1e-6;        ///< m, depth and level, any tick
  double pixel = 2.0;         ///< of 255, any channel of any pixel
  double pixel_share = 1e-3;  ///< 0 to 1, pixels that differ by more than pixel_above
  double pixel_above = 0.0;   ///< of 255; 0: pixels that differ at all
};

/// One tolerance, as files and options give it.
struct ToleranceKey {
  const char* name;  ///< in tolerances.toml
  const char* option;
  double Tolerances::*value;
  Range range;
  double golden_least;  ///< below it, the rounding of a golden entry would fail
  const char* unit;     ///< empty: none
  const char* help;

  /// The values it may have where a run is compared with a golden entry.
  constexpr Range golden_range() const {
    return {.lowest = golden_least, .highest = range.highest, .whole = range.whole};
  }
};
inline constexpr std::array<ToleranceKey, 6> tolerance_keys{{
    {"height", "--height-tolerance", &Tolerances::height, not_negative, 1e-9, "m",
     "Largest difference of height"},
    {"force", "--force-tolerance", &Tolerances::force, not_negative, 1e-5, "N",
     "Largest difference of force"},
    {"depth", "--depth-tolerance", &Tolerances::depth, not_negative, 1e-8, "m",
     "Largest difference of depth and sand level"},
    {"pixel",
     "--pixel-tolerance",
     &Tolerances::pixel,
     {.lowest = 0.0, .highest = 255.0, .whole = true},
     0.0,
     "of 255",
     "Largest channel difference"},
    {"pixel_share",
     "--pixel-share",
     &Tolerances::pixel_share,
     {0.0, 1.0},
     0.0,
     "",
     "Fraction of pixels that may differ by more than pixel_above"},
    {"pixel_above",
     "--pixel-above",
     &Tolerances::pixel_above,
     {.lowest = 0.0, .highest = 255.0, .whole = true},
     0.0,
     "of 255",
     "Channel difference beyond which a pixel counts for the fraction. At most 0.1 % of the pixels may "
     "differ by more than 4: --pixel-above 4 --pixel-share 0.001 --pixel-tolerance 255"},
}};

/// Tolerances that somebody set, by name.
using GivenTolerances = std::map<std::string, double>;

/// A tolerance that was used, and where it comes from: "default", an option, or a file.
struct UsedTolerance {
  ToleranceKey key;
  double value;
  std::string source;
};

/// All tolerances. An option overrides the file, and the file overrides the default.
std::vector<UsedTolerance> used_tolerances(const GivenTolerances& options,
                                           const GivenTolerances& in_file = {},
                                           const std::filesystem::path& file = {});
Tolerances values_of(const std::vector<UsedTolerance>& used);

/// Tolerances that are not the default: "force 0.01 N (--force-tolerance), ..."; empty where all are.
std::string changed_tolerances(const std::vector<UsedTolerance>& used);

/// Reads a golden entry's own tolerances (TOML, keys as above); empty where there is no file. Error: input,
/// as TomlReader; io.
GivenTolerances read_tolerances(const std::filesystem::path& file);

}  // namespace sandstroke
