#include "import/import_stroke.h"

#include <optional>

#include "core/error.h"
#include "core/input_file.h"
#include "core/machine.h"
#include "import/formats.h"
#include "import/merge_strokes.h"
#include "import/sample_files.h"
#include "import/table_option.h"
#include "import/text_table.h"

namespace sandstroke {
namespace {

namespace fs = std::filesystem;

/// Settings for reading the second table. It has the force and the orientation that the settings name, and
/// nothing else may leave its samples out.
TableSettings settings_of_second(const TableSettings& settings) {
  TableSettings second;
  second.part = settings.merge_part;
  second.time = settings.merge_time;
  second.time_unit = settings.merge_time_unit;
  second.rate = settings.merge_rate;
  second.equal_times = settings.equal_times;
  second.missing = settings.missing;
  second.force = settings.force;
  second.force_unit = settings.force_unit;
  second.force_sign = settings.force_sign;
  second.orientation = settings.orientation;
  for (std::string* of_first : {&second.velocity, &second.pressure, &second.stroke_number, &second.pen_state})
    *of_first = "none";
  return second;
}

SampleTable read_samples(const fs::path& path, const TableSettings& settings,
                         const std::optional<Eigen::Matrix3d>& of_first = {}) {
  constexpr std::uintmax_t many_bytes = 16'000'000;  // whose columns are large arrays
  std::error_code not_there;
  if (const auto bytes = fs::file_size(path, not_there); !not_there && bytes > many_bytes)
    keep_freed_memory();
  if (path != "-")
    if (std::optional<SampleTable> samples = read_known_format(path, settings)) return std::move(*samples);
  if (!settings.pen_down.empty())
    throw_input_error("{}: is a table of text, in which pen_down has no meaning; give {} for G-code only",
                      samples_name(path), option_and_key("pen_down"));
  InputFile file(path == "-" ? "/dev/stdin" : path, InputFile::Pipe::taken);
  TextTable table(samples_name(path), settings, of_first);
  for (std::string_view part = file.next_block(); !part.empty(); part = file.next_block()) table.read(part);
  return table.take();
}

}  // namespace

ImportedStroke import_stroke(const fs::path& path, const TableSettings& settings) {
  TableSettings of_first = settings;
  if (!settings.merge.empty())
    for (std::string* columns : {&of_first.force, &of_first.orientation})
      if (!is_none(*columns)) columns->clear();  // of the second table
  ImportedStroke first = stroke_of_table(read_samples(path, of_first), of_first, samples_name(path));
  if (settings.merge.empty()) return first;
  const fs::path beside = sample_files(path, settings).back();
  const TableSettings of_second = settings_of_second(settings);
  const ImportedStroke second = stroke_of_table(read_samples(beside, of_second, first.axes), of_second,
                                                samples_name(beside), first.axes);
  merge_strokes(first, second, settings.merge_shift, samples_name(path), samples_name(beside));
  return first;
}

ImportedStroke import_stroke_text(std::string_view text, const std::string& name,
                                  const TableSettings& settings) {
  TextTable table(name, settings);
  table.read(text);
  return stroke_of_table(table.take(), settings, name);
}

}  // namespace sandstroke
