#include "import/foreign_text.h"

#include <algorithm>
#include <cctype>
#include <string>

#include "core/error.h"
#include "core/output_file.h"
#include "core/shell_text.h"
#include "import/text_parts.h"

namespace sandstroke {
namespace {

namespace fs = std::filesystem;

bool holds(std::string_view text, std::string_view part) { return text.find(part) != std::string_view::npos; }

/// A command of Python whose argument is the file. The code has no " in it.
[[noreturn]] void refuse_with_python(const fs::path& path, const char* kind, const char* way,
                                     const char* code, const char* after = "") {
  throw_input_error("{}: is {}, which sandstroke cannot read; {}: python3 -c \"{}\" {}{}", path.string(),
                    kind, way, code, shell_quoted(path.string()), after);
}

constexpr const char* as_table = "save it as CSV";

/// A script begins with [[segment]] or a name, and a table may begin with "[mm]".
bool begins_as_json(std::string_view text) {
  if (text.starts_with('{')) return true;
  const std::size_t inner = text.find_first_not_of("[ \t\r\n");
  return text.starts_with('[') && inner != std::string_view::npos &&
         holds("{]-0123456789\"", text.substr(inner, 1));
}

/// True for "key:" or "key: value".
bool is_yaml_pair(std::string_view line) {
  const std::string_view key = cut_before(line, ':');
  const auto is_of_name = [](char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; };
  return !key.empty() && std::all_of(key.begin(), key.end(), is_of_name) && (line.empty() || line[0] == ' ');
}

void refuse_json(const fs::path& path, std::string_view text) {
  const std::string ending = small_ending(path);
  std::string_view rest = text;
  const std::string_view first = cut_line(rest);
  const bool by_lines =
      ending == ".ndjson" || ending == ".jsonl" ||
      (first.starts_with('{') && first.ends_with('}') && without_blanks(rest).starts_with('{'));
  if (!begins_as_json(text) && !by_lines && ending != ".json") return;
  if (holds(first, "\"drawing\""))
    refuse_with_python(
        path, "a file of Quick Draw", "make a table of its first drawing",
        "import json, sys; strokes = json.loads(open(sys.argv[1]).readline())['drawing']; "
        "print('x,y'); [print(*('%s,%s' % (x, -y) for x, y in zip(*s[:2])), 'UP', sep='\\n') for s "
        "in strokes]",
        " > drawing.csv, and name that with --pen-up UP");
  if (by_lines)
    refuse_with_python(
        path, "JSON lines", as_table,
        "import json, sys, pandas; pandas.json_normalize([json.loads(l) for l in open(sys.argv[1]) if "
        "l.strip()]).to_csv('samples.csv', index=False)");
  refuse_with_python(path, "JSON", as_table,
                     "import json, sys, pandas; d = json.load(open(sys.argv[1])); (pandas.json_normalize(d) "
                     "if isinstance(d, list) and isinstance(d[0], dict) else "
                     "pandas.DataFrame(d)).to_csv('samples.csv', index=False)");
}

/// True for a line such as "0.5, 1, 2": not indented, with two numbers, and no pair of YAML.
bool is_table_row(std::string_view line) {
  if (line.starts_with(' ') || holds(line, ": ")) return false;
  int numbers = 0;
  while (!line.empty() && numbers < 2) {
    const std::size_t end = std::min(line.find_first_of(",; \t\r"), line.size());
    numbers += finite_number(line.substr(0, end)) ? 1 : 0;
    line.remove_prefix(std::min(end + 1, line.size()));
  }
  return numbers == 2;
}

/// True for documents of YAML between lines of "---"; a table may stand below those of its metadata.
bool holds_yaml_documents(std::string_view text) {
  const std::string_view first = cut_line(text);
  if (first != "---" && !(holds(first, ":") && is_yaml_pair(first))) return false;
  bool documents = false, rows = false;
  while (!text.empty()) {
    const std::string_view line = cut_before(text, '\n');
    const bool ends = without_blanks(line) == "---";
    documents = documents || ends;
    rows = !ends && (rows || is_table_row(line));
  }
  return documents && !rows;
}

void refuse_yaml(const fs::path& path, std::string_view text) {
  const std::string ending = small_ending(path);
  if (!holds_yaml_documents(text) && ending != ".yaml" && ending != ".yml") return;
  if (holds(text, "stamp:"))
    refuse_with_python(
        path, "YAML, as rostopic echo prints it", as_table,
        "import sys, yaml, pandas; t = pandas.json_normalize([m for m in "
        "yaml.safe_load_all(open(sys.argv[1])) if m]); s = t.filter(like='stamp.'); t.insert(0, "
        "'time', s.iloc[:, 0] * 10**9 + s.iloc[:, 1]); t.drop(columns=s.columns).to_csv('samples.csv', "
        "index=False)");
  refuse_with_python(path, "YAML", as_table,
                     "import sys, yaml, pandas; pandas.json_normalize([m for d in "
                     "yaml.safe_load_all(open(sys.argv[1])) if d for m in (d if isinstance(d, list) else "
                     "[d])]).to_csv('samples.csv', index=False)");
}

}  // namespace

void refuse_foreign_text(const fs::path& path, std::string_view text) {
  if (text.starts_with('<')) {
    const char* kind = holds(text, "<gpx")    ? "a GPX track (degrees on the globe)"
                       : holds(text, "<html") ? "HTML"
                                              : "XML, but neither InkML nor SVG";
    throw_input_error("{}: is {}, which sandstroke cannot read; save or export its samples as CSV",
                      path.string(), kind);
  }
  std::string_view rest = text;
  if (cut_line(rest) == "0" && cut_line(rest) == "SECTION")
    throw_input_error(
        "{}: is a DXF drawing, which sandstroke cannot read; save it as SVG (in Inkscape or "
        "LibreCAD)",
        path.string());
  refuse_json(path, text);
  refuse_yaml(path, text);
}

}  // namespace sandstroke
