#include "io/stroke_file.h"

#include <cstring>
#include <fstream>

#include "core/error.h"
#include "core/output_file.h"
#include "haptics/stroke_script.h"
#include "io/hdf5_file.h"
#include "io/stroke_script_toml.h"

namespace sandstroke {
namespace {

constexpr const char* group = "/stroke";
constexpr const char* format = "sandstroke.stroke";
constexpr double format_version = 1.0;

void check_format(const Hdf5Reader& file) {
  if (!file.has(group) || !file.has_attribute(group, "format") ||
      file.text_attribute(group, "format") != format) {
    throw_input_error(
        "{}: {} has no attribute format = \"{}\", so it is no stroke file; check which file was meant",
        file.name(), group, format);
  }
  const double version =
      file.has_attribute(group, "format_version") ? file.number_attribute(group, "format_version") : 0.0;
  if (version != format_version) {
    throw_input_error(
        "{}: {} has format_version {} (0 = none), but this program reads {}; convert the stroke again",
        file.name(), group, version, format_version);
  }
}

/// The pen states; other nonzero flags of foreign files would lose their meaning in 8 bits, so they are
/// rejected.
std::vector<std::uint8_t> contact_states(const std::vector<std::uint32_t>& values, const std::string& name) {
  std::vector<std::uint8_t> states;
  for (const std::uint32_t value : values) {
    if (value > 255)
      throw_input_error("{}: contact of sample {} is {}; it must be 0, 1 or 2", name, states.size(), value);
    states.push_back(static_cast<std::uint8_t>(value));
  }
  return states;
}

}  // namespace

void write_stroke_file(const std::filesystem::path& path, const Stroke& stroke) {
  check_stroke(stroke, path.string());
  Hdf5Writer file(path);
  file.write("/stroke/time", stroke.time);
  file.write("/stroke/position", stroke.position);
  if (!stroke.velocity.empty()) file.write("/stroke/velocity", stroke.velocity);
  if (!stroke.force.empty()) file.write("/stroke/force", stroke.force);
  if (!stroke.switches.empty()) file.write("/stroke/switches", stroke.switches);
  if (!stroke.flags.empty()) file.write("/stroke/flags", stroke.flags);
  if (!stroke.contact.empty()) file.write("/stroke/contact", stroke.contact);
  file.attribute(group, "format", std::string(format));
  file.attribute(group, "format_version", format_version);
  file.attribute(group, "nominal_rate", stroke.nominal_rate);
  file.attribute(group, "gap_threshold", stroke.gap_threshold);
  file.attribute(group, "source", stroke.source);
  file.attribute(group, "frame", stroke.frame);
  file.attribute(group, "complete", stroke.complete ? 1.0 : 0.0);
  file.finish();
}

Stroke read_stroke_file(const std::filesystem::path& path) {
  const Hdf5Reader file(path);
  check_format(file);
  const std::string name = file.name() + ": " + group;
  Stroke stroke;
  stroke.time = file.doubles("/stroke/time");
  stroke.position = file.vectors("/stroke/position");
  if (file.has("/stroke/velocity")) stroke.velocity = file.vectors("/stroke/velocity");
  if (file.has("/stroke/force")) stroke.force = file.vectors("/stroke/force");
  if (file.has("/stroke/switches")) stroke.switches = file.integers("/stroke/switches");
  if (file.has("/stroke/flags")) stroke.flags = file.integers("/stroke/flags");
  if (file.has("/stroke/contact")) stroke.contact = contact_states(file.integers("/stroke/contact"), name);
  const auto has = [&](const char* attribute) { return file.has_attribute(group, attribute); };
  if (has("nominal_rate")) stroke.nominal_rate = file.number_attribute(group, "nominal_rate");
  if (has("gap_threshold")) stroke.gap_threshold = file.number_attribute(group, "gap_threshold");
  if (has("source")) stroke.source = file.text_attribute(group, "source");
  if (has("frame")) stroke.frame = file.text_attribute(group, "frame");
  if (has("complete")) stroke.complete = file.number_attribute(group, "complete") != 0.0;
  check_stroke(stroke, name);
  return stroke;
}

namespace {

bool is_recorded(const std::filesystem::path& path) {
  check_readable(path);
  std::ifstream file(path, std::ios::binary);
  constexpr char hdf5_signature[] = "\x89HDF\r\n\x1a\n";
  char begin[sizeof hdf5_signature - 1] = {};
  file.read(begin, sizeof begin);
  return path.extension() == ".h5" || std::memcmp(begin, hdf5_signature, sizeof begin) == 0;
}

}  // namespace

bool stroke_depends_on_force(const std::filesystem::path& path) {
  return !is_recorded(path) && path.extension() == ".toml" && presses_by_force(read_stroke_script(path));
}

Stroke load_stroke(const std::filesystem::path& path, const ForceSettings& force) {
  if (is_recorded(path)) return read_stroke_file(path);
  if (path.extension() == ".toml") return trace_script(read_stroke_script(path), force);
  throw_input_error(
      "{}: is neither a recorded stroke (.h5) nor a scripted one (.toml); convert a table of "
      "samples first: sandstroke stroke convert {} STROKE.h5 (--help says how)",
      path.string(), path.string());
}

}  // namespace sandstroke
