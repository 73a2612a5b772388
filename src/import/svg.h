#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "import/sample_table.h"

namespace sandstroke {

/// Reads a drawing (SVG 1.1): the outlines of path, line, polyline, polygon, rect, circle and ellipse, in
/// their order, with the transforms of their groups. Gives x and y in mm by width, height and viewBox (px are
/// 1/96 inch); y points down in SVG and is negated. Each subpath lifts at its end. What is hidden (display,
/// visibility) or only defined (defs, symbol, clipPath, mask, pattern, marker) is left out. Warnings tell of
/// text, images and clones, which are not drawn, of style sheets that hide, and of a page without a size.
/// There is no time: a speed gives it. Error: io; input.
SampleTable read_svg(const std::filesystem::path& path);
/// The same from text; `name` stands for the file in messages.
SampleTable parse_svg(std::string_view text, const std::string& name);

/// True if a text begins as an SVG document.
bool looks_like_svg(std::string_view text);

}  // namespace sandstroke
