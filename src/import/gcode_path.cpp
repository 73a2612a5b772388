#include "import/gcode_path.h"

#include <algorithm>
#include <limits>

#include "core/error.h"

namespace sandstroke {
namespace {

using Eigen::Vector3d;
using Samples = std::vector<GcodeSample>;

/// True if Z moves, and never together with X or Y.
bool z_lifts_a_pen(const Samples& samples) {
  bool moves = false;
  for (const GcodeSample& sample : samples) {
    if (sample.along_z && sample.along_xy) return false;
    moves = moves || sample.along_z;
  }
  return moves;
}

std::vector<bool> pen_is_down(const GcodePath& path, bool by_z) {
  const bool has_word = !path.pen_word.empty();
  double lowest = std::numeric_limits<double>::infinity();  // Z of a move along X or Y
  for (const GcodeSample& sample : path.samples)
    if (sample.along_xy) lowest = std::min(lowest, sample.position.z());
  std::vector<bool> down;
  for (const GcodeSample& sample : path.samples)
    down.push_back((!has_word || sample.down) &&
                   (!by_z || sample.position.z() < 0.0 || sample.position.z() <= lowest));
  return down;
}

/// Times [s]; empty if the file gives no speed. Moves before the first F go as fast as the moves after it.
std::vector<double> times_of(const Samples& samples) {
  const auto said =
      std::find_if(samples.begin(), samples.end(), [](const auto& sample) { return sample.feed > 0.0; });
  std::vector<double> times;
  if (said == samples.end()) return times;
  double time = 0.0;
  for (const GcodeSample& sample : samples)
    times.push_back(time += sample.length / (sample.feed > 0.0 ? sample.feed : said->feed));
  return times;
}

}  // namespace

SampleTable table_of_gcode(const GcodePath& path, const std::string& name) {
  const Samples& samples = path.samples;
  const bool has_word = !path.pen_word.empty();
  if (samples.empty())
    throw_input_error("{}: has no moves (G0 to G3 with X, Y or Z); give a file with a path", name);
  const bool by_z = z_lifts_a_pen(samples);
  const bool has_z = by_z || std::any_of(samples.begin(), samples.end(),
                                         [](const auto& sample) { return sample.position.z() != 0.0; });
  const std::vector<bool> down = pen_is_down(path, by_z);
  const std::vector<double> time = times_of(samples);

  SampleTable table;
  table.line_tolerance = gcode_line_tolerance;
  table.columns = {{"x", "mm", {}}, {"y", "mm", {}}};
  if (has_z) table.columns.push_back({"z", "mm", {}});
  if (!time.empty()) table.columns.push_back({"time", "s", {}});
  for (std::size_t i = 0; i < samples.size(); ++i) {
    if (!down[i]) continue;
    const Vector3d& at = samples[i].position;
    table.columns[0].values.push_back(at.x());
    table.columns[1].values.push_back(at.y());
    if (has_z) table.columns[2].values.push_back(at.z());
    if (!time.empty()) table.columns.back().values.push_back(time[i]);
    table.lines.push_back(samples[i].line);
    if (by_z || has_word)
      table.lifts.push_back((has_word && samples[i].lifts) || (i + 1 < down.size() && !down[i + 1]));
  }
  const bool is_spindle = path.pen_word == gcode_spindle;
  if (table.size() == 0)
    throw_input_error(
        "{}: the pen is never down; {}", name,
        has_word && !is_spindle
            ? fmt::format("pen_up = \"{}\" lifts it all the time; name the other position", path.pen_word)
            : "lower it with M3 (S above 0) or Z before a G1 move");

  std::vector<std::string> passed;
  for (const int code : path.passed_over) passed.push_back(fmt::format("G{:g}", code / 10.0));
  table.description =
      fmt::format("G-code: {} points{}{}{}", table.size(),
                  by_z    ? ", the pen is up where Z is high"
                  : has_z ? ", Z is a height"
                          : "",
                  is_spindle                    ? ", the pen is down after M3"
                  : has_word                    ? fmt::format(", the pen is up after {}", path.pen_word)
                  : path.draws_rapidly && !by_z ? ", G0 draws too, because nothing lifts the pen"
                                                : "",
                  passed.empty() ? "" : fmt::format(", {} skipped", fmt::join(passed, ", ")));
  return table;
}

}  // namespace sandstroke
