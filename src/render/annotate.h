#pragma once

#include <Eigen/Core>
#include <string>
#include <string_view>
#include <vector>

#include "picture/image.h"
#include "render/colour_map.h"

namespace sandstroke {

inline constexpr Rgb annotation_ink = {34, 34, 38};

/// Draws anti-aliased lines through points, in pixels from the upper left corner. A line of one point is a
/// dot. What lies outside the image is cut off.
void draw_lines(Image& image, const std::vector<std::vector<Eigen::Vector2d>>& lines, double half_width,
                Rgb rgb);

/// Draws a line of ASCII text with anti-aliased single strokes. x, y: left end of the base line in pixels, y
/// down; cap_height: of capital letters, in pixels. What lies outside the image is cut off.
void draw_text(Image& image, double x, double y, double cap_height, std::string_view text, Rgb rgb);

/// The width in pixels of the text that draw_text draws.
double text_width(double cap_height, std::string_view text);

/// Capital height [pixels] that reads well in a picture of this height.
double annotation_cap_height(int image_height);

/// The content of a colour bar: a quantity in metres from low to high (low < high).
struct Legend {
  std::string quantity = "height";
  double low = 0.0, high = 1.0;  ///< m
  ColourScale scale = ColourScale::sequential;
  double contour_interval =
      0.0;  ///< m; > 0: the bar shows the picture's contour lines, unless they would touch
};

/// Width [pixels] of the strip at the right border that draw_legend uses in a picture of this height. It
/// depends on the quantity, never on the range. Only a scale with numbers of many digits needs more.
int legend_width(const Legend& legend, int image_height);

/// Draws the colour bar with round numbers, title and unit on a light strip along the right border.
void draw_legend(Image& image, const Legend& legend);

}  // namespace sandstroke
