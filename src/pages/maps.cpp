#include "pages/maps.h"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <bit>
#include <cmath>

#include "compare/field_difference.h"
#include "compare/image_difference.h"
#include "core/error.h"
#include "io/png_file.h"
#include "pages/difference_map.h"
#include "render/changed_cells.h"
#include "render/colour_map.h"
#include "render/plain_map.h"
#include "render/render_subject.h"
#include "render/round_scale.h"
#include "report/data_uri.h"

namespace sandstroke {
namespace {

using Json = nlohmann::ordered_json;

constexpr int most_pixels = 1400;  // of a map, along its longer side
constexpr int most_spots = 500;    // of a difference, likewise
constexpr int most_numbers = 250;  // of values that can be read off, likewise
constexpr int scale_colours = 21;
constexpr double most_shown = 5e7;  // cells: each costs some 40 bytes of memory

HeightGrid block(const HeightField& bed, const CellRange& cells) {
  if (static_cast<double>(cells.rows()) * cells.cols() > most_shown)
    throw_input_error(
        "{} x {} cells are too many to show on a page; read the heights from both files, for example with "
        "h5py",
        cells.rows(), cells.cols());
  return HeightGrid::NullaryExpr(cells.rows(), cells.cols(), [&](Eigen::Index row, Eigen::Index col) {
    return bed(cells.row_begin + static_cast<int>(row), cells.col_begin + static_cast<int>(col));
  });
}

ValueRange finite_range(const HeightGrid& values) {
  const auto finite = values.isFinite();
  if (!finite.any()) return {0.0, 0.0};
  return {finite.select(values, HUGE_VAL).minCoeff(), finite.select(values, -HUGE_VAL).maxCoeff()};
}

/// A colour scale from low to high. `one` is the size of its unit [m], or 1 for numbers without a unit.
Json scale_json(const std::string& title, const ValueRange& range, const std::string& unit, double one,
                ColourScale colour_scale) {
  Json colours = Json::array();
  for (int i = 0; i < scale_colours; ++i) {
    const double fraction = i / (scale_colours - 1.0);
    const auto colour = scale_colour(fraction, 0.0, 1.0, colour_scale);
    colours.push_back(fmt::format("#{:02x}{:02x}{:02x}", std::lround(255 * colour[0]),
                                  std::lround(255 * colour[1]), std::lround(255 * colour[2])));
  }
  return {{"title", title},           {"unit", unit}, {"low", range.low / one},
          {"high", range.high / one}, {"one", one},   {"colours", colours}};
}

Json height_scale(const std::string& title, const ValueRange& range, ColourScale colours) {
  const LengthUnit unit = length_unit(std::max(std::abs(range.low), std::abs(range.high)));
  return scale_json(title, range, unit.name, unit.metres, colours);
}

Json map_json(const std::string& name, const Image& image, const Json& scale, const std::string& text = "") {
  Json json{{"name", name},
            {"width", image.width},
            {"height", image.height},
            {"picture", data_uri("image/png", encode_png(image))}};
  if (!scale.is_null()) json["scale"] = scale;
  if (!text.empty()) json["text"] = text;
  return json;
}

Image height_map(const HeightGrid& values, const ValueRange& range, ColourScale colours) {
  const auto rows = static_cast<double>(values.rows()), cols = static_cast<double>(values.cols());
  const double scale = std::min(1.0, most_pixels / std::max(rows, cols));
  return plain_map(values, range.low, range.high, colours,
                   std::max(1, static_cast<int>(std::lround(cols * scale))),
                   std::max(1, static_cast<int>(std::lround(rows * scale))));
}

/// Gives each cell the value of its spot. The grid keeps its size, so that a position stays in the same
/// pixel.
HeightGrid spread(const HeightGrid& values, const Spots& spots) {
  const HeightGrid seen = at_spots(values, spots);
  return HeightGrid::NullaryExpr(values.rows(), values.cols(), [&](Eigen::Index row, Eigen::Index col) {
    return seen(row / spots.side, col / spots.side);
  });
}

/// 32-bit floats, least significant byte first.
std::string float_text(const HeightGrid& values) {
  std::string bytes;
  for (const double value : values.reshaped<Eigen::RowMajor>()) {
    const auto bits = std::bit_cast<std::uint32_t>(static_cast<float>(value));
    for (const int shift : {0, 8, 16, 24}) bytes += static_cast<char>(bits >> shift & 255u);
  }
  return base64(bytes);
}

/// Numbers that a reader can read off: golden height and difference [m] at the worst cell of each spot.
Json numbers_json(const HeightGrid& golden, const HeightGrid& difference) {
  const Spots spots = spots_of(difference, most_numbers);
  return {{"side", spots.side},
          {"cols", spots.cols},
          {"cells", {difference.rows(), difference.cols()}},
          {"golden", float_text(at_spots(golden, spots))},
          {"difference", float_text(at_spots(difference, spots))}};
}

std::string shown_text(const BedGeometry& bed, const CellRange& shown) {
  const std::string cells = fmt::format("{} x {} cells of {:.4g} m", bed.cols(), bed.rows(), bed.cell_size());
  if (shown == bed.cells()) return fmt::format("The whole bed: {}.", cells);
  const double half = 0.5 * bed.cell_size();
  return fmt::format(
      "The bed has {}. The maps show x from {:.4g} to {:.4g} m and y from {:.4g} to {:.4g} m, the area where "
      "one of the two moved sand or where they differ by more than the limit.",
      cells, bed.x_of(shown.col_begin) - half, bed.x_of(shown.col_end - 1) + half,
      bed.y_of(shown.row_begin) - half, bed.y_of(shown.row_end - 1) + half);
}

}  // namespace

CellRange shown_cells(const ComparedSurfaces& s) {
  if (s.golden.rows() != s.run.rows() || s.golden.cols() != s.run.cols()) return {};
  CellRange all;
  const auto add = [&](const CellRange& range) {
    if (range.empty()) return;
    all = all.empty()
              ? range
              : CellRange{std::min(all.row_begin, range.row_begin), std::max(all.row_end, range.row_end),
                          std::min(all.col_begin, range.col_begin), std::max(all.col_end, range.col_end)};
  };
  const auto add_moved = [&](const HeightField& initial, const HeightField& final) {
    add(differing_cells(initial, final, settled_fraction * field_difference(initial, final).max));
  };
  add_moved(s.golden_initial, s.golden);
  add_moved(s.run_initial, s.run);
  add(differing_cells(s.golden, s.run, s.limit));
  return framed_cells(all, s.golden.rows(), s.golden.cols(), s.golden.cell_size(), 0.0);
}

Json surfaces_part(const ComparedSurfaces& s) {
  const CellRange shown = shown_cells(s);
  const bool alike = !shown.empty();
  const HeightGrid golden = block(s.golden, alike ? shown : s.golden.cells());
  const HeightGrid run = block(s.run, alike ? shown : s.run.cells());
  const ValueRange a = finite_range(golden), b = finite_range(run);
  const ValueRange range = value_range(std::min(a.low, b.low), std::max(a.high, b.high), s.colours);
  const Json scale = height_scale(s.title, range, s.colours);
  Json part{{"kind", "maps"}, {"title", s.title}, {"maps", Json::array()}};
  Json& maps = part["maps"];
  maps.push_back(map_json("golden", height_map(golden, range, s.colours), scale));
  maps.push_back(map_json("run", height_map(run, range, s.colours), scale));
  if (!alike) {
    part["text"] = fmt::format("They differ in shape: golden has {} x {} cells, the run {} x {}.",
                               golden.cols(), golden.rows(), run.cols(), run.rows());
    return part;
  }
  part["text"] = shown_text(s.golden, shown);

  const HeightGrid difference = run - golden;
  const double span = std::max(finite_magnitude(difference), s.limit);
  const ValueRange difference_range = value_range(-span, span, ColourScale::diverging);
  const Spots spots = spots_of(difference, most_spots);
  const FieldDifference whole = field_difference(s.golden, s.run);
  std::string text = fmt::format(
      "Largest {:.4g} m at x = {:.4g} m, y = {:.4g} m (row {}, col {}), limit {:.4g} m; RMS {:.4g} m; volume "
      "{:+.4g} m³.",
      whole.max, whole.x, whole.y, whole.row, whole.col, s.limit, whole.rms, whole.volume);
  if (whole.max == 0.0) text = "There is no difference: all cells are the same.";
  if (spots.side > 1 && whole.max != 0.0)
    text +=
        fmt::format(" Each spot of {0} x {0} cells has the colour of its largest difference.", spots.side);
  maps.push_back(map_json("difference",
                          height_map(spread(difference, spots), difference_range, ColourScale::diverging),
                          height_scale("difference", difference_range, ColourScale::diverging), text));

  const BedGeometry& bed = s.golden;
  const double half = 0.5 * bed.cell_size();
  part["extent"] = {{"x", {bed.x_of(shown.col_begin) - half, bed.x_of(shown.col_end - 1) + half}},
                    {"y", {bed.y_of(shown.row_begin) - half, bed.y_of(shown.row_end - 1) + half}}};
  part["spots"] = numbers_json(golden, difference);
  const bool in_sight = whole.row >= shown.row_begin && whole.row < shown.row_end &&
                        whole.col >= shown.col_begin && whole.col < shown.col_end;
  if (whole.max != 0.0 && in_sight) part["largest"] = {{"x", whole.x}, {"y", whole.y}};
  return part;
}

Json error_map_part(const HeightField& errors) {
  const HeightField none(errors.rows(), errors.cols(), errors.cell_size());
  const CellRange shown =
      framed_cells(differing_cells(none, errors, 0.0), errors.rows(), errors.cols(), errors.cell_size(), 0.0);
  const HeightGrid values = block(errors, shown).abs();
  const ValueRange range = value_range(0.0, finite_range(values).high, ColourScale::sequential);
  return {{"kind", "maps"},
          {"title", "Where the heights are uncertain"},
          {"text", "The estimated error of each cell's height (run --error-map)."},
          {"maps",
           {map_json("error", height_map(values, range, ColourScale::sequential),
                     height_scale("error", range, ColourScale::sequential))}}};
}

Json picture_part(const Image& picture, const std::string& name) {
  return {{"kind", "maps"},
          {"title", "Picture"},
          {"text", "In the view of the scene."},
          {"maps", {map_json(name, picture, nullptr)}}};
}

Json pictures_part(const std::string& title, const Image& golden, const Image& run, int limit) {
  Json part{{"kind", "maps"}, {"title", title}, {"maps", Json::array()}};
  Json& maps = part["maps"];
  maps.push_back(map_json("golden", golden, nullptr));
  maps.push_back(map_json("run", run, nullptr));
  if (golden.width != run.width || golden.height != run.height) {
    part["text"] = fmt::format("They differ in size: golden has {} x {} pixels, the run {} x {}.",
                               golden.width, golden.height, run.width, run.height);
    return part;
  }
  part["text"] = fmt::format("{} x {} pixels.", golden.width, golden.height);
  const ImageDifference whole = image_difference(golden, run);
  const int span = std::max({whole.max, limit, 1});
  const ValueRange range{-static_cast<double>(span), static_cast<double>(span)};
  maps.push_back(map_json(
      "difference", picture_difference_map(golden, run, span),
      scale_json("difference", range, "of 255", 1.0, ColourScale::diverging),
      whole.max == 0
          ? std::string("There is no difference: all pixels are the same.")
          : fmt::format("Largest {} of 255 at pixel x = {}, y = {}, limit {}; {:.4g} % of the pixels "
                        "differ. Each pixel has the colour of its channel that differs most.",
                        whole.max, whole.x, whole.y, limit, 100.0 * whole.fraction)));
  part["extent"] = {{"x", {0, golden.width}}, {"y", {golden.height, 0}}};
  if (whole.max > 0) part["largest"] = {{"x", whole.x + 0.5}, {"y", whole.y + 0.5}};
  return part;
}

}  // namespace sandstroke
