#pragma once

#include <Eigen/Geometry>
#include <string>
#include <string_view>

#include "import/drawn_lines.h"

namespace sandstroke {

/// Draws the data of a path: M, L, H, V, C, S, Q, T, A and Z, absolute and relative (SVG 1.1, chapter 8).
/// Error: input; `location` says which path it is.
void draw_svg_path(std::string_view data, const Eigen::Affine2d& to_mm, const std::string& location,
                   DrawnLines& lines);

}  // namespace sandstroke
