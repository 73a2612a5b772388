#include "io/stroke_file.h"

#include <spdlog/spdlog.h>

#include "core/error.h"
#include "core/hash.h"
#include "core/input_file.h"
#include "core/warning.h"
#include "haptics/stroke_script.h"
#include "import/import_stroke.h"
#include "import/sample_files.h"
#include "io/input_kind.h"
#include "io/stroke_format.h"
#include "io/stroke_script_toml.h"

namespace sandstroke {
namespace {

/// The pen states. Refuses larger numbers of other programs, which would lose their meaning in 8 bits.
std::vector<std::uint8_t> contact_states(const std::vector<std::uint32_t>& values, const std::string& name) {
  std::vector<std::uint8_t> states;
  for (const std::uint32_t value : values) {
    if (value > 255)
      throw_input_error("{}: contact of sample {} is {}; it must be 0, 1 or 2", name, states.size(), value);
    states.push_back(static_cast<std::uint8_t>(value));
  }
  return states;
}

template <class T>
void add(ContentHash& hash, const std::vector<T>& column) {
  hash.add(column.data(), column.size() * sizeof(T));
}

}  // namespace

void write_stroke_file(const std::filesystem::path& path, const Stroke& stroke) {
  check_stroke(stroke, path.string());
  Hdf5GridWriter file(path, stroke_output);
  std::vector<std::string> names;
  visit_columns(stroke, [&](const std::string& name, const auto& column) {
    if (column.empty()) return;
    file.write("/stroke/" + name, column);
    names.push_back(name);
  });
  describe_stroke_columns(file, names);
  write_stroke_attributes(file, stroke);
  file.attribute(stroke_group, "duration", stroke.duration());
  file.finish();
}

Stroke read_stroke_file(const std::filesystem::path& path) {
  const Hdf5Reader file(path);
  check_stroke_format(file);
  const std::string name = file.name() + ": " + stroke_group;
  Stroke stroke;
  stroke.time = file.doubles("/stroke/time");
  stroke.position = file.vectors("/stroke/position");
  if (file.has("/stroke/velocity")) stroke.velocity = file.vectors("/stroke/velocity");
  if (file.has("/stroke/force")) stroke.force = file.vectors("/stroke/force");
  if (file.has("/stroke/orientation")) stroke.orientation = file.quaternions("/stroke/orientation");
  if (file.has("/stroke/pressure")) stroke.pressure = file.doubles("/stroke/pressure");
  if (file.has("/stroke/switches")) stroke.switches = file.integers("/stroke/switches");
  if (file.has("/stroke/flags")) stroke.flags = file.integers("/stroke/flags");
  if (file.has("/stroke/contact")) stroke.contact = contact_states(file.integers("/stroke/contact"), name);
  read_stroke_attributes(file, stroke);
  check_stroke(stroke, name);
  return stroke;
}

bool is_recorded(const std::filesystem::path& path) {
  if (path == "-" || is_pipe(path)) return false;  // it can be read only once
  check_readable(path);
  return path.extension() == ".h5" || begins_with(path, hdf5_signature);
}

bool is_script(const std::filesystem::path& path) {
  return !is_recorded(path) && path.extension() == ".toml";
}

bool stroke_depends_on_force(const std::filesystem::path& path) {
  return is_script(path) && presses_by_force(read_stroke_script(path));
}

std::string content_hash(const Stroke& stroke) {
  ContentHash hash;
  add(hash, stroke.time);
  add(hash, stroke.position);
  add(hash, stroke.contact);
  add(hash, stroke.force);
  add(hash, stroke.pressure);
  hash.add(&stroke.gap_threshold, sizeof stroke.gap_threshold);
  if (stroke.tip_speed > 0.0) hash.add("speed", 5);
  if (stroke.follows_sand) hash.add("sand", 4);
  return hash.text();
}

Stroke load_stroke(const std::filesystem::path& path, const ForceSettings& force,
                   const TableSettings& table) {
  return read_as({InputKind::stroke, InputKind::script}, path, [&] {
    if (is_recorded(path)) return read_stroke_file(path);
    if (path.extension() == ".toml") return trace_script(read_stroke_script(path), force);
    ImportedStroke imported = import_stroke(path, table);
    spdlog::info("{}: {}", samples_name(path), imported.description);
    for (const std::string& warning : imported.warnings) warn({WarningCode::stroke_import, warning});
    imported.stroke.source = samples_name(path.filename());
    return std::move(imported.stroke);
  });
}

}  // namespace sandstroke
