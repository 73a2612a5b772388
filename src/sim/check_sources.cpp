#include "sim/check_sources.h"

#include <spdlog/fmt/fmt.h>

#include <cmath>

#include "core/error.h"
#include "core/machine.h"
#include "sim/sand_sources.h"

namespace sandstroke {
namespace {

/// What is known of a source without its path.
void check_settings(const Scene& scene, const SourceSettings& source, const std::string& key) {
  if (source.rate == 0.0)
    throw_input_error(
        "{}.rate = 0: it neither pours nor takes sand; set a rate in kg/s, or remove the [[source]]", key);
  if (!(source.start < source.stop))
    throw_input_error("{}.stop = {} s is not after its start = {} s; set a later stop", key, source.stop,
                      source.start);
  if (!scene.stroke && source.path.empty() && std::isinf(source.stop))
    throw_input_error(
        "{}.stop is missing, and no [stroke] ends the run; set the time in seconds at which it stops", key);
}

/// at [m]: a place of the nozzle; where: in words.
void check_place(const Scene& scene, const Eigen::Vector3d& at, const std::string& where) {
  const BedSettings& bed = scene.bed;
  const BedGeometry cells(bed.rows, bed.cols, bed.cell_size(), bed.shape);
  if (const double beyond = cells.beyond_edge(at.x(), at.y()); beyond > 0.0)
    throw_input_error(
        "{} is {:.4g} mm beyond the bed's edge, at x = {:.4g} m, y = {:.4g} m; move it over the bed, or "
        "enlarge "
        "bed.size",
        where, 1e3 * beyond, at.x(), at.y());
}

void check_path(const Scene& scene, const SourceSettings& source, const std::string& key) {
  const Stroke& path = *source.stroke;
  if (path.follows_sand)
    throw_input_error(
        "{}.path = \"{}\": its heights count from the sand, but a nozzle's from z = 0; give one with heights",
        key, source.path);
  for (std::size_t i = 0; i < path.size(); ++i)
    if (path.pen_down(i))
      check_place(scene, source.at + path.position[i], fmt::format("{}.path: sample {}", key, i));
}

/// About the highest place that it pours from [m].
double highest_of(const SourceSettings& source) {
  double highest = source.at.z();
  if (source.stroke)
    for (const Eigen::Vector3d& position : source.stroke->position)
      highest = std::max(highest, source.at.z() + position.z());
  return highest;
}

}  // namespace

void check_sources(const Scene& scene, const std::string& name) {
  double packets = 0.0;
  for (std::size_t i = 0; i < scene.sources.size(); ++i) {
    const SourceSettings& source = scene.sources[i];
    const std::string key = fmt::format("{}: source.{}", name, i + 1);
    check_settings(scene, source, key);
    if (source.path.empty())
      check_place(scene, source.at, key + ".at");
    else if (source.stroke)
      check_path(scene, source, key);
    if (source.rate > 0.0) packets += fall_time(highest_of(source), 0.0) * scene.device.servo_rate;
  }
  check_memory(packets * SandSources::bytes_per_packet(), name + ": the sand in the air from all [[source]]",
               "lower the sources, or device.servo_rate");
}

}  // namespace sandstroke
