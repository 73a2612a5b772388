#include "sim/scene_sand_map.h"

#include "core/error.h"

namespace sandstroke {

void describe_sand_map(KeyVisitor& v, std::optional<SandMap>& map) {
  if (!v.optional_section("sand.map", map.has_value(),
                          "angles of repose by place, instead of relaxation.talus_angle; the map covers the "
                          "bed, and a cell takes the mean of tan(angle) over it"))
    return;
  if (!map) map.emplace();
  if (v.reads()) v.require("file");
  v.text("file", map->file,
         "a 16-bit grayscale PNG, or a map of degrees: a GeoTIFF, a NumPy array (.npy) or an ESRI ASCII grid "
         "(.asc); relative to the scene");
  show_if_given(v, "low", map->low, sharp_angle, "deg", "angle of a picture's black, which a picture needs");
  show_if_given(v, "high", map->high, sharp_angle, "deg",
                "angle of a picture's white, which a picture needs");
  show_if_given(v, "nodata", map->nodata, sharp_angle, "deg",
                "angle of the map's cells without data; left out: they are refused");
}

void check_sand_map(const SandMap& map, const std::string& name) {
  if (map.file.empty()) throw_input_error("{}: sand.map.file is missing; name a map of talus angles", name);
}

}  // namespace sandstroke
