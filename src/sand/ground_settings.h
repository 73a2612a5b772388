#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "rules/talus.h"
#include "tool/triangle_mesh.h"

namespace sandstroke {

enum class RegionShape { rectangle, circle, polygon };

/// A part of the bed with sand of its own kind. The shape decides which lengths count.
struct SandRegion {
  RegionShape shape = RegionShape::rectangle;
  Eigen::Vector2d centre = Eigen::Vector2d::Zero();  ///< m: rectangle, circle
  Eigen::Vector2d size = {0.5, 0.5};                 ///< m along x and y: rectangle
  double radius = 0.25;                              ///< m: circle
  std::vector<Eigen::Vector2d> points = {};          ///< m: corners of the polygon, along its outline
  double soft = 0.0;                                 ///< m: width of the band around the edge in which the
                                                     ///< sand's kind changes; 0: a sharp edge
  // Its own numbers of the sand; none: as around it.
  std::optional<double> talus_angle = {};     ///< deg
  std::optional<double> friction_angle = {};  ///< deg, internal friction
  std::optional<double> density = {};         ///< kg/m^3, of the bulk
  std::optional<double> k_s = {};             ///< N, of the paper's force
  std::optional<double> cohesion = {};        ///< Pa, of moist sand

  bool operator==(const SandRegion&) const = default;
};

/// Sand of another kind below a level plane, as the force knows it; none: the scene's own.
struct SandLayer {
  double top = 0.0;                           ///< m, height of that plane
  std::optional<double> friction_angle = {};  ///< deg
  std::optional<double> density = {};         ///< kg/m^3

  bool operator==(const SandLayer&) const = default;
};

/// A file of talus angles by place. A picture says none, so they are those of its black and white.
struct SandMap {
  std::string file;
  std::optional<double> low, high;                     ///< deg, of a picture's black and white
  std::optional<double> nodata;                        ///< deg, of cells without data; none: they are refused
  std::shared_ptr<const HeightGrid> slopes = nullptr;  ///< tan of its angles in the bed's cells (null: not
                                                       ///< read)
};

enum class StoneShape { sphere, ellipsoid, box, mesh };

/// A body that sand lies on and flows around. Only its upper side counts. The shape decides which lengths do.
struct StoneSettings {
  StoneShape shape = StoneShape::sphere;
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();    ///< m; where the origin of a mesh's file is
  double radius = 0.05;                                ///< m: sphere
  Eigen::Vector3d size = {0.1, 0.1, 0.1};              ///< m: full extents of ellipsoid and box
  std::string file = {};                               ///< of the mesh
  double scale = 1.0;                                  ///< m per unit of length in that file
  double turn = 0.0;                                   ///< deg about z, from +x towards +y; not of the sphere
  double talus_angle = 0.0;                            ///< deg, of sand that lies on it; 0: as around it
  std::shared_ptr<const TriangleMesh> mesh = nullptr;  ///< that file's, in m (null: not read)

  bool operator==(const StoneSettings&) const = default;
};

/// What the sand lies on, and its kinds by place.
struct GroundSettings {
  std::optional<double> floor;  ///< m, height of a level floor; none: the sand is as deep as may be
  std::optional<SandMap> map;
  std::vector<SandRegion> regions;  ///< later ones lie over earlier ones, and over the map
  std::vector<SandLayer> layers;    ///< in any order
  std::vector<StoneSettings> stones;
  double stiffness = 1000.0;  ///< N/m, of floor and stones under the hand; 0: it does not feel them

  /// Whether there is something below which no sand gets.
  bool is_solid() const { return floor.has_value() || !stones.empty(); }
  /// Whether a stone is read from a file.
  bool has_mesh() const {
    return std::any_of(stones.begin(), stones.end(),
                       [](const StoneSettings& stone) { return stone.shape == StoneShape::mesh; });
  }
  /// Whether sand rests at other angles in places.
  bool has_slopes() const {
    return map || std::any_of(regions.begin(), regions.end(),
                              [](const SandRegion& region) { return region.talus_angle; });
  }
  /// Whether the force of the contact differs by place (StrengthByPlace).
  bool has_strengths() const {
    return !layers.empty() || std::any_of(regions.begin(), regions.end(), [](const SandRegion& region) {
      return region.friction_angle || region.density;
    });
  }
  /// Whether the paper's force differs by place.
  bool has_k_s() const {
    return std::any_of(regions.begin(), regions.end(), [](const SandRegion& region) { return region.k_s; });
  }
  bool empty() const { return !is_solid() && !map && regions.empty() && layers.empty(); }
};

}  // namespace sandstroke
