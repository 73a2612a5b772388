#include "sim/scene_sand_map.h"

#include "core/error.h"

namespace sandstroke {
namespace {

void show_given_angle(KeyVisitor& v, const char* key, std::optional<double>& angle, const char* help) {
  if (!(v.reads() ? v.given(key) : angle.has_value())) return;
  double value = angle.value_or(0.0);
  v.number(key, value, sharp_angle, "deg", help);
  angle = value;
}

}  // namespace

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
  show_given_angle(v, "low", map->low, "angle of a picture's black, which a picture needs");
  show_given_angle(v, "high", map->high, "angle of a picture's white, which a picture needs");
  show_given_angle(v, "nodata", map->nodata,
                   "angle of the map's cells without data; left out: they are refused");
}

void check_sand_map(const SandMap& map, const std::string& name) {
  if (map.file.empty()) throw_input_error("{}: sand.map.file is missing; name a map of talus angles", name);
}

}  // namespace sandstroke
