#include "lettering/hershey_text.h"

#include <charconv>
#include <filesystem>

#include "core/asset.h"
#include "core/error.h"
#include "core/input_file.h"

SANDSTROKE_DECLARE_ASSET(futural);

namespace sandstroke {
namespace {

constexpr const char* built_in = "futural";
const std::filesystem::path fonts = "/usr/share/hershey-fonts";
constexpr std::size_t most_font_bytes = 1'000'000;
constexpr char zero = 'R';               // a coordinate is a letter, counted from R
constexpr double capital_height = 21.0;  // in a font's units
constexpr int base_line = 9;             // y of the base line; y points down
constexpr char first_code = ' ', last_code = '~';

bool is_line_end(char c) { return c == '\n' || c == '\r'; }

/// Reads a glyph from pairs of letters: its left and right edge, then points; " R" lifts the pen.
SingleStrokeText glyph_of(std::string_view pairs) {
  const int left = pairs[0] - zero, right = pairs[1] - zero;
  SingleStrokeText glyph{{}, (right - left) / capital_height};
  bool down = false;
  for (std::size_t i = 2; i < pairs.size(); i += 2) {
    const bool lifts = pairs[i] == ' ' && pairs[i + 1] == zero;
    if (!lifts) {
      if (!down) glyph.polylines.emplace_back();
      glyph.polylines.back().emplace_back((pairs[i] - zero - left) / capital_height,
                                          (base_line - (pairs[i + 1] - zero)) / capital_height);
    }
    down = !lifts;
  }
  return glyph;
}

std::vector<SingleStrokeText> glyphs_of(const std::string& name) {
  if (name == built_in) return read_jhf(SANDSTROKE_ASSET(futural), name);
  const std::filesystem::path file = fonts / (name + ".jhf");
  // Only a plain name stays inside the folder of fonts.
  if (name.empty() || name.find('/') != std::string::npos || !std::filesystem::exists(file))
    throw_input_error("there is no font '{}'; take {}, or one of Debian's hershey-fonts-data in {}", name,
                      built_in, fonts.string());
  return read_jhf(read_text_file(file, most_font_bytes), name);
}

}  // namespace

std::vector<SingleStrokeText> read_jhf(std::string_view jhf, std::string_view name) {
  constexpr std::size_t number_columns = 5, count_columns = 3;
  std::vector<SingleStrokeText> glyphs;
  for (std::size_t at = 0; at < jhf.size();) {
    std::string_view columns = jhf.substr(std::min(at + number_columns, jhf.size()), count_columns);
    columns.remove_prefix(std::min(columns.find_first_not_of(' '), columns.size()));
    std::size_t count = 0;
    std::from_chars(columns.data(), columns.data() + columns.size(), count);
    std::string pairs;
    for (at += number_columns + count_columns; at < jhf.size() && pairs.size() < 2 * count; ++at)
      if (!is_line_end(jhf[at])) pairs += jhf[at];
    while (at < jhf.size() && is_line_end(jhf[at])) ++at;
    if (count == 0 || pairs.size() < 2 * count)
      throw_input_error("font '{}' is damaged at its glyph {}; install hershey-fonts-data again, or take {}",
                        name, glyphs.size() + 1, built_in);
    glyphs.push_back(glyph_of(pairs));
  }
  return glyphs;
}

HersheyFont::HersheyFont(std::string_view name) : name_(name), glyphs_(glyphs_of(name_)) {}

SingleStrokeText HersheyFont::draw(std::string_view text) const {
  SingleStrokeText drawn;
  for (const char letter : text) {
    const auto index = static_cast<std::size_t>(letter - first_code);
    if (letter < first_code || letter > last_code || index >= glyphs_.size() ||
        (glyphs_[index].width == 0.0 && glyphs_[index].polylines.empty()))
      throw_input_error("font '{}' has no letter of code {}; write the text with ASCII letters", name_,
                        static_cast<int>(static_cast<unsigned char>(letter)));
    for (std::vector<Eigen::Vector2d> line : glyphs_[index].polylines) {
      for (Eigen::Vector2d& point : line) point.x() += drawn.width;
      drawn.polylines.push_back(std::move(line));
    }
    drawn.width += glyphs_[index].width;
  }
  return drawn;
}

SingleStrokeText hershey_text(std::string_view text, std::string_view font) {
  return HersheyFont(font).draw(text);
}

}  // namespace sandstroke
