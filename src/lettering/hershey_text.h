#pragma once

#include <Eigen/Core>
#include <string>
#include <string_view>
#include <vector>

namespace sandstroke {

/// Text as pen strokes. Coordinates in units of the capital height: x to the right from the first letter's
/// left edge, y up from the base line (capitals span 0 to 1).
struct SingleStrokeText {
  std::vector<std::vector<Eigen::Vector2d>> polylines;  ///< one per pen-down
  double width = 0.0;
};

/// A single-stroke Hershey font. "futural" is part of the program. Others ("rowmans", "cursive", ...) come
/// from Debian's package hershey-fonts-data.
class HersheyFont {
 public:
  /// Error: input, if there is no such font, or its file is damaged; io.
  explicit HersheyFont(std::string_view name);
  /// Error: input, if a letter is missing.
  SingleStrokeText draw(std::string_view text) const;

 private:
  std::string name_;
  std::vector<SingleStrokeText> glyphs_;  // from the space (code 32) on
};

/// Reads the glyphs of a font in James Hurt's format (.jhf), from ASCII's space on. Each glyph has five
/// columns for its number, three for its count of letter pairs, then the pairs; a long glyph goes on in the
/// next line. Error: input, with the font's name.
std::vector<SingleStrokeText> read_jhf(std::string_view jhf, std::string_view name);

/// Draws text with the named font. Error: input, if the font or a letter is missing.
SingleStrokeText hershey_text(std::string_view text, std::string_view font = "futural");

}  // namespace sandstroke
