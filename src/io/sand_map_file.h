#pragma once

#include <filesystem>
#include <string>

#include "io/height_map.h"
#include "sim/scene.h"

namespace sandstroke {

/// tan of the angles that a map gives, in the cells of a bed that it covers: area means, if its cells are
/// others. Cells without data have settings.nodata; beyond a round bed's wall they need none. Says in the log
/// which angles were read, and warns if they look like radians. `name` stands for the file. Error: input, if
/// the map does not fit the bed's proportions, lacks data, or has angles that are not between 0 and 90
/// degrees.
HeightGrid talus_slopes_on_bed(HeightMap& map, const SandMap& settings, const BedSettings& bed,
                               const std::string& name);

/// The same ground, with its map read in the cells of this bed (sand.map.file, relative to `folder`). Error:
/// input or io, naming the file.
GroundSettings with_sand_map(GroundSettings ground, const BedSettings& bed,
                             const std::filesystem::path& folder);

/// The attribute of a run file's /provenance with sand_map_hash().
inline constexpr const char* sand_map_attribute = "sand_map_hash";
/// A hash of the map's slopes. Empty: there is no map.
std::string sand_map_hash(const GroundSettings& ground);

}  // namespace sandstroke
