#include "import/gcode_path.h"

#include <algorithm>
#include <limits>

#include "core/error.h"
#include "import/gcode_pen.h"
#include "import/table_option.h"

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

/// The lowest Z of a move along X or Y.
double lowest_drawn(const Samples& samples) {
  double lowest = std::numeric_limits<double>::infinity();
  for (const GcodeSample& sample : samples)
    if (sample.along_xy && sample.height_known) lowest = std::min(lowest, sample.position.z());
  return lowest;
}

std::vector<bool> pen_is_down(const GcodePath& path, bool by_z, bool has_z) {
  const bool has_word = !path.pen_word.empty();
  const double lowest = lowest_drawn(path.samples);
  std::vector<bool> down;
  for (const GcodeSample& sample : path.samples)
    down.push_back((!has_word || sample.down) && (!has_z || sample.height_known) &&
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

std::string description_of(const GcodePath& path, std::size_t points, bool by_z, bool has_z) {
  std::string text = fmt::format("G-code: {} points", points);
  if (by_z)
    text += ", the pen is up where Z is high";
  else if (has_z)
    text += ", Z is a height";
  if (path.pen_is_named)
    text += path.pen_word.empty() ? ", all moves draw" : fmt::format(", {} moves the pen", path.pen_word);
  else if (!path.pen_word.empty())
    text += fmt::format(", the pen is down after {}", path.pen_word);
  if (path.pen_word.empty() && !path.pen_is_named && path.moves_rapidly && !by_z)
    text += fmt::format(", G0 draws too, because nothing lifts the pen (set {} to G0 if it lifts)",
                        option_and_key("pen_up"));
  else if (path.draws_rapidly && !path.pen_word.empty() && !by_z)
    text += ", G0 draws too where the pen is down";
  std::vector<std::string> passed;
  for (const auto& [letter, code] : path.passed_over) passed.push_back(gcode_word_text(letter, code));
  if (!passed.empty()) text += fmt::format(", {} skipped", fmt::join(passed, ", "));
  if (!path.homes.empty())
    text += fmt::format(", nothing is drawn on the way home ({} times, first in line {})", path.homes.size(),
                        *path.homes.begin());
  return text;
}

}  // namespace

bool z_may_lift_a_pen(const Samples& samples) {
  const double lowest = lowest_drawn(samples);
  const auto last =
      std::find_if(samples.rbegin(), samples.rend(), [](const auto& sample) { return sample.along_xy; });
  return std::any_of(last, samples.rend(), [&](const auto& sample) { return sample.position.z() > lowest; });
}

SampleTable table_of_gcode(const GcodePath& path, const std::string& name) {
  const Samples& samples = path.samples;
  const bool has_word = !path.pen_word.empty();
  if (samples.empty())
    throw_input_error("{}: has no moves (G0 to G3 with X, Y or Z); give a file with a path", name);
  bool by_z = z_lifts_a_pen(samples);
  const bool has_z = by_z || std::any_of(samples.begin(), samples.end(),
                                         [](const auto& sample) { return sample.position.z() != 0.0; });
  const std::vector<bool> down = pen_is_down(path, by_z, has_z);
  if (std::find(down.begin(), down.end(), false) == down.end()) by_z = false;  // it lifts nothing
  const std::vector<double> time = times_of(samples);

  SampleTable table;
  table.line_tolerance = gcode_line_tolerance;
  table.columns = {{"x", "mm", {}}, {"y", "mm", {}}};
  if (has_z) table.columns.push_back({"z", "mm", {}});
  if (!time.empty()) table.columns.push_back({"time", "s", {}});
  const bool lifts = by_z || has_word || !path.homes.empty();
  for (std::size_t i = 0; i < samples.size(); ++i) {
    if (!down[i]) continue;
    const Vector3d& at = samples[i].position;
    table.columns[0].values.push_back(at.x());
    table.columns[1].values.push_back(at.y());
    if (has_z) table.columns[2].values.push_back(at.z());
    if (!time.empty()) table.columns.back().values.push_back(time[i]);
    table.lines.push_back(samples[i].line);
    const bool goes_home = i + 1 < samples.size() && samples[i + 1].from_home;
    if (lifts)
      table.lifts.push_back((has_word && samples[i].lifts) || goes_home ||
                            (i + 1 < down.size() && !down[i + 1]));
  }
  if (table.size() == 0)
    throw_input_error("{}: the pen is never down; {}", name,
                      path.pen_is_named
                          ? fmt::format("pen_up = \"{}\" lifts it all the time; name the other position, or "
                                        "the word that lowers it in {}",
                                        path.pen_word, option_and_key("pen_down"))
                          : "lower it with M3 (S above 0) or Z before a G1 move");
  table.description = description_of(path, table.size(), by_z, has_z);
  return table;
}

Eigen::AlignedBox3d box_of_gcode(const SampleTable& table) {
  Eigen::AlignedBox3d box;
  const bool has_z = table.columns.size() > 2 && table.columns[2].name == "z";
  for (std::size_t i = 0; i < table.size(); ++i)
    box.extend(Vector3d(table.columns[0].values[i], table.columns[1].values[i],
                        has_z ? table.columns[2].values[i] : 0.0));
  return box;
}

}  // namespace sandstroke
