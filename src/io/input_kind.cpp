#include "io/input_kind.h"

#include <algorithm>
#include <array>

#include "core/error.h"
#include "core/output_file.h"
#include "haptics/recording.h"
#include "hdf5/hdf5_file.h"
#include "io/png_file.h"
#include "io/scene_keys.h"
#include "io/stroke_format.h"
#include "io/toml_reader.h"

namespace sandstroke {
namespace {

namespace fs = std::filesystem;

struct KindText {
  InputKind kind;
  const char* name;
  const char* format;  // attribute of an HDF5 file's root
  const char* use;     // what to do with it; {} is the file
};

constexpr const char* use_of_stroke =
    "a scene plays it: sandstroke run SCENE.toml --stroke {0}; sandstroke stroke info {0} says what is in it";
constexpr std::array<KindText, 11> kinds{{
    {InputKind::scene, "a scene", "", "run it: sandstroke run {0}"},
    {InputKind::plan, "a sweep plan", "", "run it: sandstroke sweep {0}"},
    {InputKind::script, "a stroke script", "", use_of_stroke},
    {InputKind::stroke, "a stroke", "", use_of_stroke},
    {InputKind::recording, "the journal of a recording that was cut off", "",
     "make a stroke of it first: sandstroke stroke repair {0}"},
    {InputKind::run, "a run file", "sandstroke.run",
     "sandstroke info {0} says what is in it, sandstroke render {0} draws it"},
    {InputKind::golden, "a golden entry's content", "sandstroke.golden",
     "sandstroke golden check runs a scene and compares it with that"},
    {InputKind::sweep, "a sweep's table of results", "sandstroke.sweep", "sweep.html beside it shows them"},
    {InputKind::point, "a sweep's point", "sandstroke.point",
     "sandstroke sweep collect makes a table of all"},
    {InputKind::bench, "a table of bench's results", "sandstroke.bench", "bench.html beside it shows them"},
    {InputKind::picture, "a PNG picture", "", "check which file was meant"},
}};

const KindText& text_of(InputKind kind) {
  return *std::find_if(kinds.begin(), kinds.end(), [&](const KindText& text) { return text.kind == kind; });
}

InputKind kind_of_hdf5(const fs::path& path) {
  const Hdf5Reader file(path);
  if (file.has_attribute("/", "format")) {
    const std::string format = file.text_attribute("/", "format");
    for (const KindText& text : kinds)
      if (format == text.format) return text.kind;
  }
  return file.has(stroke_group) ? InputKind::stroke : InputKind::unknown;
}

/// By its tables, where those of just one kind are there.
InputKind kind_of_toml(const fs::path& path) {
  const TomlReader file = TomlReader::from_file(path);
  Scene every_section;
  every_section.stroke.emplace();
  const std::vector<KeySection> sections = scene_settings(every_section);
  const bool scene = std::any_of(sections.begin(), sections.end(),
                                 [&](const KeySection& section) { return file.is_table(section.name); });
  const bool plan = file.is_table("sweep") || file.is_table("axes"), script = file.has("segment");
  if (scene + plan + script != 1) return InputKind::unknown;
  return scene ? InputKind::scene : plan ? InputKind::plan : InputKind::script;
}

}  // namespace

InputKind kind_of(const fs::path& path) {
  std::error_code not_there;
  if (!fs::is_regular_file(path, not_there)) return InputKind::unknown;
  if (path.extension() == journal_extension) return InputKind::recording;
  if (begins_with(path, png_signature)) return InputKind::picture;
  try {
    if (begins_with(path, hdf5_signature)) return kind_of_hdf5(path);
    constexpr std::uintmax_t most_bytes = 10'000'000;  // of a text that somebody wrote
    return fs::file_size(path) <= most_bytes ? kind_of_toml(path) : InputKind::unknown;
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
