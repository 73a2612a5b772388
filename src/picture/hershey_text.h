#pragma once

#include <Eigen/Core>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

struct hershey_font;  // of the library hersheyfont

namespace sandstroke {

/// Text as pen strokes. Coordinates in units of the capital height: x to the right from the first letter's
/// left edge, y up from the base line (capitals span 0 to 1).
struct SingleStrokeText {
  std::vector<std::vector<Eigen::Vector2d>> polylines;  ///< one per pen-down
  double width = 0.0;
};

/// A single-stroke Hershey font from hershey-fonts-data ("futural", "rowmans", "cursive", ...), read once.
class HersheyFont {
 public:
  /// Error: input, if there is no such font.
  explicit HersheyFont(std::string_view name);
  /// Error: input, if a letter is missing.
  SingleStrokeText draw(std::string_view text) const;

 private:
  std::string name_;
  std::unique_ptr<hershey_font, void (*)(hershey_font*)> font_;
};

/// Draws text with a font of that name. Error: input, if the font or a letter is missing.
SingleStrokeText hershey_text(std::string_view text, std::string_view font = "futural");

}  // namespace sandstroke
