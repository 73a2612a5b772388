// A table of samples: a line of settings, as --set takes those of [stroke.table], and the table. A second
// table, to be merged, begins after a line of ====.
#include "fuzz.h"
#include "import/import_stroke.h"
#include "import/merge_strokes.h"
#include "import/text_table.h"
#include "io/key_reader.h"
#include "play.h"

using namespace sandstroke;

namespace {

TableSettings settings_of(std::string_view line) {
  TomlReader toml = TomlReader::from_text("", "settings");
  while (!line.empty()) {
    const std::size_t end = std::min(line.find(' '), line.size());
    if (end > 0) toml.override_with("stroke.table." + std::string(line.substr(0, end)));
    line.remove_prefix(std::min(end + 1, line.size()));
  }
  TableSettings table;
  read_keys(toml, [&](KeyVisitor& visitor) {
    visitor.section("stroke.table", "");
    describe_table(visitor, table);
  });
  return table;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try_input([&] {
    std::string_view text = as_text(data, size), second;
    const TableSettings settings = settings_of(take_line(text));
    if (const std::size_t end = text.find("====\n"); end != std::string_view::npos) {
      second = text.substr(end + 5);
      text = text.substr(0, end);
    }
    ImportedStroke first = import_stroke_text(text, "table.csv", settings);
    if (!second.empty()) {
      TextTable table("second.csv", {}, first.axes);
      table.read(second);
      merge_strokes(first, stroke_of_table(table.take(), {}, "second.csv", first.axes), settings.merge_shift,
                    "table.csv", "second.csv");
      check_stroke(first.stroke, "table.csv");
    }
    play(first.stroke);
  });
  return 0;
}
