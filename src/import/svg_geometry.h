#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <string>
#include <string_view>

#include "import/drawn_lines.h"

namespace sandstroke {

/// Takes numbers off an attribute of SVG: "10-5.5.5,1e3". Each cut skips blanks and commas before it.
class SvgNumbers {
 public:
  explicit SvgNumbers(std::string_view text) : rest_(text) {}
  /// The next number, if it is finite.
  std::optional<double> cut();
  /// The next flag of an arc: 0 or 1, perhaps right before another number.
  std::optional<bool> cut_flag();
  /// The next letter; 0: none follows.
  char cut_letter();
  bool at_end();
  std::string_view rest() const { return rest_; }

 private:
  void skip_blanks();
  std::string_view rest_;
};

/// A length in px (1/96 inch): "210mm", "12"; `whole` is what 100 % are. None: it is no length, or its unit
/// is that of a font.
std::optional<double> svg_length(std::string_view text, double whole);

/// The transform of an attribute: "translate(1 2) rotate(30)". Error: input; `location` says where it is.
Eigen::Affine2d svg_transform(std::string_view text, const std::string& location);

/// An arc of an ellipse: centre + cos(angle) a + sin(angle) b.
struct EllipseArc {
  Eigen::Vector2d centre, a, b;
  double start = 0.0, sweep = 0.0;  // rad
};

/// Draws the arc from the last point on, transformed. It ends at `end` (before the transform).
void draw_ellipse_arc(const EllipseArc& arc, const Eigen::Vector2d& end, const Eigen::Affine2d& to_mm,
                      DrawnLines& lines);

}  // namespace sandstroke
