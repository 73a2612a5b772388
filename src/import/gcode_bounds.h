#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace sandstroke {

/// The bounds that a program's comments tell: ";MINX:1.5" (Cura), "; Bounds: X1 Y2 to X3 Y4" (LightBurn),
/// "(X min: 1)", but not those of the stock or the machine. They tell the same thing as the path, so that a
/// wrong unit or a part that was passed over shows.
class GcodeBounds {
 public:
  /// Takes the comments of a line.
  void take(std::string_view line);

  /// A sentence that names both where the comments disagree with the path; none if they agree, or may tell of
  /// a frame around it. `drawn` is what is drawn, `all` what the tool reaches [mm]: either may be meant.
  /// `scale` is the file's unit [mm].
  std::optional<std::string> disagreement(const Eigen::AlignedBox3d& drawn, const Eigen::AlignedBox3d& all,
                                          double scale, const std::string& name) const;

 private:
  bool is_in_inches(const Eigen::AlignedBox3d& drawn, double scale) const;
  void take_bound(std::size_t axis, bool is_max, std::optional<double> value);

  std::array<std::optional<double>, 3> low_ = {}, high_ = {};  // x, y, z
};

}  // namespace sandstroke
