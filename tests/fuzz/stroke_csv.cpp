// A table of samples: a line of options, as `stroke convert` has them but without dashes, and the table.
#include "io/stroke_csv.h"

#include <charconv>
#include <map>

#include "fuzz.h"
#include "play.h"

using namespace sandstroke;

namespace {

std::vector<std::string> split(std::string_view text, char separator) {
  std::vector<std::string> parts;
  while (!text.empty()) {
    const std::size_t end = text.find(separator);
    parts.emplace_back(text.substr(0, end));
    text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
  }
  return parts;
}

double positive(const std::string& text) {
  double number = 0.0;
  std::from_chars(text.data(), text.data() + text.size(), number);
  return number > 0.0 ? number : 1.0;  // the command takes no other
}

StrokeCsvFormat format_of(std::string_view line) {
  std::map<std::string, std::string> options;
  for (const std::string& word : split(line, ' ')) {
    const std::size_t equals = word.find('=');
    options[word.substr(0, equals)] = equals == std::string::npos ? "" : word.substr(equals + 1);
  }
  const auto columns = [&](const std::string& option) {
    std::vector<std::string> names = split(options[option], ',');
    names.resize(names.size() < 3 ? 2 : 3);
    return names;
  };
  StrokeCsvFormat format;
  format.position = {columns("position"),
                     position_unit(options["position-unit"], positive(options["pixel-size"]))};
  if (options.contains("velocity"))
    format.velocity = {columns("velocity"), speed_unit(options["velocity-unit"])};
  if (options.contains("force")) format.force = {columns("force"), force_unit(options["force-unit"])};
  if (options.contains("time")) {
    format.time = options["time"];
    format.time_unit = time_unit(options["time-unit"]);
  }
  format.rate = positive(options["rate"]);
  format.columns = split(options["columns"], ',');
  format.pen_up = options["pen-up"];
  format.skip = options["skip"];
  format.equal_times = options["equal-times"] == "drop"     ? EqualTimes::drop
                       : options["equal-times"] == "spread" ? EqualTimes::spread
                                                            : EqualTimes::error;
  return format;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try_input([&] {
    std::string_view text = as_text(data, size);
    const StrokeCsvFormat format = format_of(take_line(text));
    play(parse_stroke_csv(text, "table.csv", format));
  });
  return 0;
}
