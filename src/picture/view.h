#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "core/key_visitor.h"

namespace sandstroke {

/// Named positions of the camera. `custom` takes azimuth, elevation, distance and target from the settings.
enum class ViewName { overview, stroke, top, custom };
/// sand: natural look. height, difference: colour maps with contour lines and a legend, for measuring.
enum class RenderStyle { sand, height, difference };

/// Their names in files and on the command line, in the order of the values.
inline const std::vector<std::string> view_names = {"overview", "stroke", "top", "custom"};
inline const std::vector<std::string> style_names = {"sand", "height", "difference"};

/// The camera and the light ([view] in a scene). Angles in degrees; azimuth counts from +x towards +y.
struct ViewSettings {
  ViewName name = ViewName::overview;
  RenderStyle style = RenderStyle::sand;
  double azimuth = -70.0;                            ///< deg, from the target to the camera
  double elevation = 40.0;                           ///< deg above the horizon
  double distance = 0.0;                             ///< m, camera to target; 0: frames the subject
  Eigen::Vector3d target = Eigen::Vector3d::Zero();  ///< m
  double field_of_view = 35.0;                       ///< deg, vertical
  double light_azimuth = 145.0;                      ///< deg, towards the sun
  double light_elevation = 20.0;                     ///< deg
  int width = 1280, height = 720;                    ///< pixels
};

/// Shows all keys of [view] to the visitor. It is the only list of them.
void describe_view(KeyVisitor& visitor, ViewSettings& view);

}  // namespace sandstroke
