#include "io/input_kind.h"

#include <algorithm>
#include <array>

#include "core/input_file.h"
#include "haptics/recording.h"
#include "io/png_file.h"
#include "io/scene_keys.h"
#include "io/stroke_format.h"
#include "io/toml_reader.h"

namespace sandstroke {
namespace {

namespace fs = std::filesystem;

bool is_scene(const TomlReader& file) {
  const std::vector<KeySection> sections = all_scene_keys();
  return std::any_of(sections.begin(), sections.end(),
                     [&](const KeySection& section) { return file.is_table(section.name); });
}
bool is_plan(const TomlReader& file) { return file.is_table("sweep") || file.is_table("axes"); }
bool is_script(const TomlReader& file) { return file.has("segment"); }

/// A kind of file: its name, how it is recognised, and what to do with it.
struct KindText {
  InputKind kind;
  const char* name;
  const char* format;                  // attribute of an HDF5 file's root
  bool (*in_toml)(const TomlReader&);  // by the tables that only this kind has
  const char* use;                     // {} is the file
  int version = 1;                     // of the format
};

constexpr const char* use_of_stroke =
    "play it in a scene: sandstroke run SCENE.toml --stroke {0}; show it: sandstroke stroke info {0}";
constexpr std::array<KindText, 11> kinds{{
    {InputKind::scene, "a scene", "", is_scene, "run it: sandstroke run {0}"},
    {InputKind::plan, "a sweep plan", "", is_plan, "run it: sandstroke sweep {0}"},
    {InputKind::script, "a stroke script", "", is_script, use_of_stroke},
    {InputKind::stroke, "a stroke", "", nullptr, use_of_stroke},
    {InputKind::recording, "the journal of a recording that was cut off", "", nullptr,
     "convert it to a stroke first: sandstroke stroke repair {0}"},
    {InputKind::run, "a run file", "sandstroke.run", nullptr,
     "show it: sandstroke info {0}; draw it: sandstroke render {0}", 2},
    {InputKind::golden, "a golden entry", "sandstroke.golden", nullptr,
     "compare a scene with it: sandstroke golden check", 2},
    {InputKind::sweep, "a sweep's table of results", "sandstroke.sweep", nullptr,
     "open sweep.html in the same folder"},
    {InputKind::point, "a sweep's point", "sandstroke.point", nullptr,
     "collect all points: sandstroke sweep collect FOLDER"},
    {InputKind::bench, "a table of bench's results", "sandstroke.bench", nullptr,
     "open bench.html in the same folder"},
    {InputKind::picture, "a PNG picture", "", nullptr, "name another file"},
}};

const KindText& text_of(InputKind kind) {
  return *std::find_if(kinds.begin(), kinds.end(), [&](const KindText& text) { return text.kind == kind; });
}

InputKind kind_of_hdf5(const fs::path& path) {
  const Hdf5Reader file(path);
  for (const KindText& text : kinds)
    if (*text.format && has_format(file, text.kind)) return text.kind;
  return file.has(stroke_group) ? InputKind::stroke : InputKind::unknown;
}

InputKind kind_of_toml(const fs::path& path) {
  const TomlReader file = TomlReader::from_file(path);
  InputKind found = InputKind::unknown;
  for (const KindText& text : kinds) {
    if (!text.in_toml || !text.in_toml(file)) continue;
    if (found != InputKind::unknown) return InputKind::unknown;
    found = text.kind;
  }
  return found;
}

}  // namespace

OutputKind output_kind(InputKind kind) {
  const KindText& text = text_of(kind);
  return hdf5_output(text.name, text.format, text.version);
}

bool has_format(const Hdf5Reader& file, InputKind kind) {
  return file.has_attribute("/", "format") && file.text_attribute("/", "format") == text_of(kind).format;
}

InputKind kind_of(const fs::path& path) {
  std::error_code not_there;
  if (!fs::is_regular_file(path, not_there)) return InputKind::unknown;
  if (path.extension() == journal_extension) return InputKind::recording;
  try {
    if (begins_with(path, png_signature)) return InputKind::picture;
    if (begins_with(path, hdf5_signature)) return kind_of_hdf5(path);
    return kind_of_toml(path);
  } catch (const Error&) {
    return InputKind::unknown;
  }
}

void expect_kind(const fs::path& path, std::initializer_list<InputKind> wanted) {
  const InputKind kind = kind_of(path);
  if (kind == InputKind::unknown || std::find(wanted.begin(), wanted.end(), kind) != wanted.end()) return;
  const KindText& is = text_of(kind);
  throw_input_error("{}: is {}, not {}; {}", path.string(), is.name, text_of(*wanted.begin()).name,
                    fmt::format(fmt::runtime(is.use), path.string()));
}

}  // namespace sandstroke
