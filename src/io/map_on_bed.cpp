#include "io/map_on_bed.h"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <array>
#include <limits>
#include <vector>

#include "core/error.h"
#include "io/map_fit.h"

namespace sandstroke {
namespace {

/// True for a number that programs of maps write for no data: none is the height of a bed.
bool is_usual_no_data(double value) {
  constexpr std::array usual = {-9999.0, -99999.0, -32767.0, -32768.0, 999999.0};  // the last: NumPy's masks
  constexpr double most = 1e15;  // most others are near the largest float; NumPy's masks are 1e20
  return std::find(usual.begin(), usual.end(), value) != usual.end() || std::abs(value) > most;
}

constexpr double no_height = std::numeric_limits<double>::quiet_NaN();

/// The lowest or the highest value of a map, and how many cells have it.
struct MapEnd {
  double value;
  std::int64_t cells = 0;

  void meet(double other, bool beyond) {
    if (beyond) *this = {other, 0};
    if (other == value) ++cells;
  }
};

/// The values of a map, looked at one by one.
struct MapValues {
  MapEnd lowest{std::numeric_limits<double>::infinity()}, highest{-lowest.value};
  std::int64_t missing = 0;

  /// Returns whether the line has cells without data.
  bool look_at(const std::vector<double>& line) {
    const std::int64_t before = missing;
    for (const double value : line) {
      lowest.meet(value, value < lowest.value);
      highest.meet(value, value > highest.value);
      missing += std::isnan(value);
    }
    return missing > before;
  }

  /// Error: input, if some are no heights.
  void check(const std::string& name) const {
    for (const MapEnd& end : {lowest, highest}) {
      if (end.cells == 0) throw_input_error("{}: no cell has a height; save the map again", name);
      if (std::isinf(end.value))
        throw_input_error("{}: {} cells have heights that are not finite numbers; correct them", name,
                          end.cells);
      if (is_usual_no_data(end.value))
        throw_input_error(
            "{}: {} cells have the height {} m, which usually means no data, but the file does not say so; "
            "mark it as no data (gdal_translate -a_nodata {}; in NumPy: nan)",
            name, end.cells, end.value, end.value);
    }
  }
};

/// The heights that values stand for: scaled, or stretched so that two of them come to lie at low and high.
struct HeightRule {
  double scale = 1.0, low = 0.0, high = 0.0, first = 0.0, last = 0.0;
  bool stretched = false;

  double height(double value) const { return height(value, 1.0); }
  /// Of a cell of which this fraction has data; `sum` is its mean times the fraction.
  double height(double sum, double fraction) const {
    if (!stretched) return scale * sum;
    if (sum == last && fraction == 1.0) return high;  // to the bit
    return low * fraction + (high - low) * ((sum - first * fraction) / (last - first));
  }
};

HeightRule rule_of(const MapLayout& map, const MapValues& values, const SurfaceSettings& surface) {
  HeightRule rule{surface.scale,
                  surface.low,
                  surface.high,
                  map.gray ? 0.0 : values.lowest.value,
                  map.gray ? 1.0 : values.highest.value,
                  surface.low != surface.high};
  if (rule.stretched && rule.first == rule.last) rule.last = rule.first + 1.0;  // a level map lies at `low`
  return rule;
}

void check_settings(const MapLayout& map, const BedSettings& bed, const std::string& name) {
  const SurfaceSettings& surface = bed.surface;
  if (map.gray && surface.low == surface.high)
    throw_input_error(
        "{}: the picture does not say its heights, and bed.surface.low and high are both {} m; set them to "
        "the heights of black and white",
        name, surface.low);
  if (!map.cell && surface.scale != 1.0 && surface.low != surface.high)
    throw_input_error(
        "{}: bed.surface.scale = {} does nothing, because the file has no lengths, and bed.surface.low and "
        "high give its heights; leave it out",
        name, surface.scale);
  if (surface.nodata) check_heights(*surface.nodata, *surface.nodata, bed, name + ": bed.surface.nodata");
}

void say(const MapLayout& map, const MapFit& fit, const MapValues& values, const HeightRule& rule,
         const BedSettings& bed, const std::string& name) {
  std::string text = fit.text;
  const bool other_heights = !map.gray && (rule.stretched || rule.scale != 1.0);
  if (other_heights)
    text += fmt::format("; heights {:.4g} to {:.4g} m became {:.4g} to {:.4g} m", values.lowest.value,
                        values.highest.value, rule.height(values.lowest.value),
                        rule.height(values.highest.value));
  if (values.missing > 0)
    text += fmt::format("; {} cells without data{}", values.missing,
                        bed.surface.nodata ? fmt::format(" were set to {:g} m", *bed.surface.nodata)
                                           : " lie beyond the wall");
  if (!map.from_top) text += "; its first row is at the smallest y";
  if (!fit.as_it_is || other_heights || values.missing > 0 || !map.from_top)
    spdlog::info("{}: {}", name, text);
}

}  // namespace

void check_heights(double lowest, double highest, const BedSettings& bed, const std::string& what) {
  constexpr double most = 10.0;
  const double length = std::max(bed.width, bed.depth);
  if (lowest >= -most * length && highest <= most * length) return;
  throw_input_error(
      "{}: heights from {:g} to {:g} m are beyond the {:g} m (ten times its length) that a bed of {} m by {} "
      "m may have; give them in metres from z = 0{}",
      what, lowest, highest, most * length, bed.width, bed.depth,
      bed.surface.kind == SurfaceKind::file
          ? ", or set bed.surface.low and high to the heights of the lowest and the highest"
          : "");
}

void check_no_gaps(HeightGrid& values, const BedSettings& bed, const std::string& name,
                   const std::string& way_out, const char* value, double beyond_wall) {
  const BedGeometry cells(bed.rows, bed.cols, bed.cell_size(), bed.shape);
  const BedGeometry circle(bed.rows, bed.cols, bed.cell_size(), BedShape::round);
  std::int64_t gaps = 0, in_circle = 0;
  for (int row = 0; row < bed.rows; ++row)
    for (int col = 0; col < bed.cols; ++col) {
      if (!std::isnan(values(row, col))) continue;
      if (!cells.has_sand(row, col)) values(row, col) = beyond_wall;
      gaps += cells.has_sand(row, col);
      in_circle += circle.has_sand(row, col);
    }
  if (gaps == 0) return;
  throw_input_error("{}: {} of the bed's {} cells have no {} (no data, or not a number); {}{}", name, gaps,
                    static_cast<std::int64_t>(bed.rows) * bed.cols, value, way_out,
                    in_circle == 0 ? ", or set bed.shape = \"round\", whose wall leaves them all out" : "");
}

HeightGrid heights_on_bed(HeightMap& map, const BedSettings& bed, const std::string& name) {
  const MapLayout& layout = map.layout();
  check_settings(layout, bed, name);
  const MapFit fit = fit_on_bed(layout, bed, bed.surface.scale, name);
  MapValues values;
  const MapMeans means = means_on_bed(map, bed, MapMeans::Way::sums, name,
                                      [&](const std::vector<double>& line) { return values.look_at(line); });
  values.check(name);
  const HeightRule rule = rule_of(layout, values, bed.surface);
  check_heights(rule.height(values.lowest.value), rule.height(values.highest.value), bed, name);

  HeightGrid heights = upright(means.means(), layout);
  if (values.missing == 0) {
    heights = heights.unaryExpr([&](double sum) { return rule.height(sum); });
  } else {
    const HeightGrid missing = upright(means.missing(), layout);
    const double fill = bed.surface.nodata.value_or(no_height);
    heights = heights.binaryExpr(missing, [&](double sum, double gap) {
      return gap == 0.0 ? rule.height(sum) : rule.height(sum, 1.0 - gap) + fill * gap;
    });
    check_no_gaps(heights, bed, name, "set bed.surface.nodata to the height that they shall have");
  }
  say(layout, fit, values, rule, bed, name);
  return heights;
}

}  // namespace sandstroke
