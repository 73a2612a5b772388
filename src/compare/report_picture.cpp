#include "compare/report_picture.h"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <vector>

#include "compare/difference_map.h"
#include "compare/field_difference.h"
#include "compare/image_difference.h"
#include "core/error.h"
#include "core/output_file.h"
#include "io/png_file.h"
#include "render/annotate.h"
#include "render/map_picture.h"

namespace sandstroke {
namespace {

constexpr int panel_width = 560, panel_height = 460;  // pixels
constexpr int spots = 110;                            // along the longer side of a difference map
constexpr double cap = 11.0;                          // pixels, capital letters
constexpr int header = 56, footer = 32;               // pixels
constexpr int gap = 10;                               // pixels, between panels
constexpr Rgb ink = {34, 34, 38}, background = {246, 246, 246}, frame = {190, 190, 190};

struct Panel {
  std::string heading;
  Image image;
};

/// What the stroke font can draw.
std::string ascii(std::string text) {
  std::replace_if(
      text.begin(), text.end(), [](char c) { return c < ' ' || c > '~'; }, '?');
  return text;
}

void fill(Image& image, int left, int top, int width, int height, const Rgb& rgb) {
  for (int y = top; y < top + height; ++y)
    for (int x = left; x < left + width; ++x) std::copy(rgb.begin(), rgb.end(), image.pixel(x, y));
}

Image side_by_side(const std::string& title, const std::vector<Panel>& panels, const std::string& numbers) {
  int width = gap, height = 0;
  for (const Panel& panel : panels) {
    width += panel.image.width + gap;
    height = std::max(height, panel.image.height);
  }
  Image sheet(width, header + height + footer);
  fill(sheet, 0, 0, sheet.width, sheet.height, background);
  draw_text(sheet, gap, 2.0 * cap, cap, ascii(title), ink);
  int left = gap;
  for (const Panel& panel : panels) {
    const Image& image = panel.image;
    draw_text(sheet, left, header - 0.8 * cap, cap, panel.heading, ink);
    fill(sheet, left - 1, header - 1, image.width + 2, image.height + 2, frame);
    for (int y = 0; y < image.height; ++y)
      std::copy_n(image.pixel(0, y), 3 * image.width, sheet.pixel(left, header + y));
    left += image.width + gap;
  }
  draw_text(sheet, gap, header + height + 2.0 * cap, cap, numbers, ink);
  return sheet;
}

Panel map_panel(const std::string& heading, const HeightGrid& values, double span) {
  return {heading, map_picture(values, -span, span, true, panel_width, panel_height, heading)};
}

}  // namespace

Image surface_report(const std::string& title, const HeightGrid& golden, const HeightGrid& run,
                     double cell_size, double limit) {
  const double span = std::max({finite_magnitude(golden), finite_magnitude(run), limit});
  std::vector<Panel> panels{map_panel("golden", golden, span), map_panel("run", run, span)};
  if (golden.rows() != run.rows() || golden.cols() != run.cols()) {
    return side_by_side(title, panels,
                        fmt::format("golden {} x {} cells, run {} x {} cells", golden.cols(), golden.rows(),
                                    run.cols(), run.rows()));
  }
  const HeightGrid difference = run - golden;
  panels.push_back(map_panel("difference", at_spots(difference, spots_of(difference, spots)),
                             std::max(finite_magnitude(difference), limit)));
  const FieldDifference numbers = field_difference(golden, run, cell_size);
  return side_by_side(
      title, panels,
      fmt::format("max {:.4g} m at row {}, col {} (x = {:.4g} m, y = {:.4g} m), limit {:.4g} m; RMS "
                  "{:.4g} m; volume {:+.4g} m^3",
                  numbers.max, numbers.row, numbers.col, numbers.x, numbers.y, limit, numbers.rms,
                  numbers.volume));
}

Image picture_report(const std::string& title, const Image& golden, const Image& run, int limit) {
  std::vector<Panel> panels{{"golden", golden}, {"run", run}};
  if (golden.width != run.width || golden.height != run.height) {
    return side_by_side(title, panels,
                        fmt::format("golden {} x {} pixels, run {} x {} pixels", golden.width, golden.height,
                                    run.width, run.height));
  }
  const ImageDifference numbers = image_difference(golden, run);
  const int span = std::max({numbers.max, limit, 1});
  panels.push_back({fmt::format("difference (-{} blue to +{} red)", span, span),
                    picture_difference_map(golden, run, span)});
  return side_by_side(title, panels,
                      fmt::format("max {}/255 at x = {}, y = {}, limit {}/255; {:.4g} % of the pixels differ",
                                  numbers.max, numbers.x, numbers.y, limit, 100.0 * numbers.share));
}

void write_report(const std::filesystem::path& path, const std::function<Image()>& draw) {
  Image sheet;
  try {
    sheet = draw();
  } catch (const Error& error) {
    if (error.kind() != ErrorKind::input) throw;
    return;
  }
  make_folder(path.parent_path());
  write_png(path, sheet);
}

}  // namespace sandstroke
