#include "io/sand_map_file.h"

#include <spdlog/fmt/fmt.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "core/error.h"
#include "core/hash.h"
#include "core/input_file.h"
#include "core/range.h"
#include "core/warning.h"
#include "hdf5/hdf5_file.h"
#include "io/map_fit.h"
#include "io/map_on_bed.h"

namespace sandstroke {
namespace {

/// The values of a map as angles [deg], looked at one by one.
class TalusAngles {
 public:
  TalusAngles(const MapLayout& map, const SandMap& settings)
      : gray_(map.gray),
        low_(settings.low.value_or(0.0)),
        high_(settings.high.value_or(0.0)),
        no_data_slope_(settings.nodata ? talus_slope(*settings.nodata) : no_slope) {}

  /// Turns a line's values into slopes. What is no angle becomes not-a-number.
  void make_slopes(std::vector<double>& line) {
    for (double& value : line) value = slope(value);
  }

  /// Error: input, if some were no angles.
  void check(const std::string& name) const {
    if (wrong_ > 0)
      throw_input_error(
          "{}: {} cells have values that are not between 0 and 90, such as {}; give angles in degrees, or "
          "mark these cells as no data (in NumPy: nan; gdal_translate -a_nodata VALUE)",
          name, wrong_, a_wrong_one_);
    if (lowest_ > highest_) throw_input_error("{}: no cell has a talus angle; save the map again", name);
  }

  double lowest() const { return lowest_; }
  double highest() const { return highest_; }
  std::int64_t missing() const { return missing_; }

 private:
  static constexpr double no_slope = std::numeric_limits<double>::quiet_NaN();

  double slope(double value) {
    if (std::isnan(value)) {
      ++missing_;
      return no_data_slope_;
    }
    const double angle = gray_ ? std::lerp(low_, high_, value) : value;
    if (!sharp_angle.contains(angle)) {
      if (wrong_++ == 0) a_wrong_one_ = angle;
      return no_slope;
    }
    lowest_ = std::min(lowest_, angle);
    highest_ = std::max(highest_, angle);
    // tan takes 0.4 us, and maps have few different angles: a 16-bit picture 65536.
    Known& known = known_[std::bit_cast<std::uint64_t>(angle) * 0x9E3779B97F4A7C15u >> 48];
    if (known.angle != angle) known = {angle, talus_slope(angle)};
    return known.slope;
  }

  struct Known {
    double angle = 0.0, slope = 0.0;
  };

  bool gray_;
  double low_, high_, no_data_slope_;
  double lowest_ = std::numeric_limits<double>::infinity(), highest_ = -lowest_, a_wrong_one_ = 0.0;
  std::int64_t missing_ = 0, wrong_ = 0;
  std::vector<Known> known_ = std::vector<Known>(std::size_t{1} << 16);  // by a hash of the angle
};

void check_low_and_high(const MapLayout& map, const SandMap& settings, const std::string& name) {
  if (map.gray && !(settings.low && settings.high))
    throw_input_error(
        "{}: the picture does not say its angles; set sand.map.low and sand.map.high to the talus angles of "
        "black and white",
        name);
  if (!map.gray && (settings.low || settings.high))
    throw_input_error(
        "{}: sand.map.low and high are for pictures, and this map holds the angles themselves; leave them "
        "out",
        name);
}

void say_angles(const MapLayout& map, const MapFit& fit, const TalusAngles& angles, const SandMap& settings,
                const std::string& name) {
  std::string text = fit.text;
  text += angles.lowest() == angles.highest()
              ? fmt::format("; talus angle {:.4g} deg", angles.lowest())
              : fmt::format("; talus angles {:.4g} to {:.4g} deg", angles.lowest(), angles.highest());
  if (angles.missing() > 0)
    text += fmt::format(
        "; {} cells without data{}", angles.missing(),
        settings.nodata ? fmt::format(" were set to {:g} deg", *settings.nodata) : " lie beyond the wall");
  if (!map.from_top) text += "; its first row is at the smallest y";
  spdlog::info("{}: {}", name, text);

  constexpr double right_angle = 1.6;  // rad, and a little more
  if (angles.highest() < right_angle)
    warn({WarningCode::map_radians,
          fmt::format("{}: no angle is above {:.3g} degrees; if the map holds radians or slopes, turn them "
                      "into degrees (numpy.degrees(a), numpy.degrees(numpy.arctan(a)))",
                      name, angles.highest())});
}

/// The mean of those that are numbers.
double mean_of_numbers(const HeightGrid& values) {
  double sum = 0.0;
  std::int64_t count = 0;
  for (Eigen::Index row = 0; row < values.rows(); ++row)
    for (Eigen::Index col = 0; col < values.cols(); ++col)
      if (!std::isnan(values(row, col))) {
        sum += values(row, col);
        ++count;
      }
  return sum / static_cast<double>(count);
}

std::unique_ptr<HeightMap> open_talus_map(const std::filesystem::path& path) {
  if (begins_with(path, hdf5_signature))
    throw_input_error(
        "{}: is an HDF5 file, and a run file holds no talus angles; give a 16-bit grayscale PNG, a GeoTIFF, "
        "a "
        "NumPy array (.npy) or an ESRI ASCII grid (.asc)",
        path.string());
  std::unique_ptr<HeightMap> map = open_height_map(path);
  if (!map)
    throw_input_error(
        "{}: is no map that sandstroke reads; save the talus angles as a 16-bit grayscale PNG, a GeoTIFF, a "
        "NumPy array (.npy) or an ESRI ASCII grid (.asc)",
        path.string());
  return map;
}

}  // namespace

HeightGrid talus_slopes_on_bed(HeightMap& map, const SandMap& settings, const BedSettings& bed,
                               const std::string& name) {
  const MapLayout& layout = map.layout();
  check_low_and_high(layout, settings, name);
  const MapFit fit = fit_on_bed(layout, bed, std::nullopt, name);
  TalusAngles angles(layout, settings);
  const MapMeans means = means_on_bed(map, bed, MapMeans::Way::running, name, [&](std::vector<double>& line) {
    angles.make_slopes(line);
    return false;
  });
  angles.check(name);
  HeightGrid slopes = upright(means.means(), layout);
  // No sand flows beyond the wall, but a coarser bed's cell may reach there.
  if (angles.missing() > 0)
    check_no_gaps(slopes, bed, name, "set sand.map.nodata to the angle that they shall have", "talus angle",
                  mean_of_numbers(slopes));
  say_angles(layout, fit, angles, settings, name);
  return slopes;
}

GroundSettings with_sand_map(GroundSettings ground, const BedSettings& bed,
                             const std::filesystem::path& folder) {
  if (!ground.map) return ground;
  SandMap& map = *ground.map;
  if (map.slopes && map.slopes->rows() == bed.rows && map.slopes->cols() == bed.cols) return ground;
  const std::filesystem::path path = folder / map.file;
  map.slopes =
      std::make_shared<HeightGrid>(talus_slopes_on_bed(*open_talus_map(path), map, bed, path.string()));
  return ground;
}

std::string sand_map_hash(const GroundSettings& ground) {
  if (!ground.map || !ground.map->slopes) return "";
  const HeightGrid& slopes = *ground.map->slopes;
  ContentHash hash;
  hash.add(fmt::format("{} {} ", slopes.rows(), slopes.cols()));
  hash.add(slopes.data(), static_cast<std::size_t>(slopes.size()) * sizeof(double));
  return hash.text();
}

}  // namespace sandstroke
