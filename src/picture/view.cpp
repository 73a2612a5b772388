#include "picture/view.h"

namespace sandstroke {

void describe_view(KeyVisitor& v, ViewSettings& view) {
  v.section("view", "how pictures show the sand");
  choose(v, "name", view.name, view_names,
         "the whole bed, the part under the stroke, a map from above, or a custom aim");
  choose(v, "style", view.style, style_names, "sand in the sun, or colour maps with contour lines");
  v.number("azimuth", view.azimuth, degrees, "deg", "direction of the camera, from +x towards +y");
  v.number("elevation", view.elevation, {0.0, 90.0, false}, "deg", "height of the camera above the horizon");
  v.number("distance", view.distance, not_negative, "m", "distance to target; 0 fits the subject");
  v.numbers("target", view.target.data(), 3, any_number, "m", "the point looked at (name = custom)");
  v.number("field_of_view", view.field_of_view, {1.0, 120.0, false}, "deg", "vertical angle of view");
  v.number("light_azimuth", view.light_azimuth, degrees, "deg", "direction of the sun, from +x towards +y");
  v.number("light_elevation", view.light_elevation, sharp_angle, "deg", "height of the sun");
  int size[2] = {view.width, view.height};
  v.integers("size", size, 2, 16, 8192, "width and height in pixels");
  view.width = size[0];
  view.height = size[1];
}

}  // namespace sandstroke
