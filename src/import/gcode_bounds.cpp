#include "import/gcode_bounds.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <vector>

#include <spdlog/fmt/fmt.h>

namespace sandstroke {
namespace {

/// A comment in small letters, without blanks and the marks between words; "minimum" is "min".
std::string plain_comment(std::string_view line) {
  std::string plain;
  const std::size_t begin = line.find_first_of(";(");
  for (const char c : line.substr(std::min(begin, line.size())))
    if (std::string_view(" \t\r_:=").find(c) == std::string_view::npos)
      plain += c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  constexpr std::string_view end_of_word = "imum";
  for (auto at = plain.find(end_of_word); at != std::string::npos; at = plain.find(end_of_word, at))
    plain.erase(at, end_of_word.size());
  return plain;
}

/// The number with which a text begins.
std::optional<double> leading_number(std::string_view text) {
  double value = 0.0;
  if (text.starts_with('+')) text.remove_prefix(1);
  const auto [end, failure] =
      std::from_chars(text.data(), text.data() + text.size(), value, std::chars_format::fixed);
  if (failure != std::errc() || !std::isfinite(value)) return {};
  return value;
}

/// The number after a word in a text.
std::optional<double> number_after(std::string_view text, std::string_view word) {
  const std::size_t at = text.find(word);
  if (at == std::string_view::npos) return {};
  return leading_number(text.substr(at + word.size()));
}

constexpr std::string_view axis_letters = "xyz";

}  // namespace

void GcodeBounds::take_bound(std::size_t axis, bool is_max, std::optional<double> value) {
  std::optional<double>& bound = (is_max ? high_ : low_)[axis];
  if (!value) return;
  if (!bound)  // a program may tell them for each of its parts
    bound = value;
  else
    bound = is_max ? std::max(*bound, *value) : std::min(*bound, *value);
}

void GcodeBounds::take(std::string_view line) {
  if (line.find_first_of(";(") == std::string_view::npos) return;
  const std::string comment = plain_comment(line);
  for (const char* thing : {"stock", "material", "block", "machine", "bed"})
    if (comment.find(thing) != std::string::npos) return;  // not the path's
  const std::string_view bounds = comment;
  if (const std::size_t at = bounds.find("bounds"), to = bounds.find("to", at + 6);
      at != std::string_view::npos && to != std::string_view::npos) {
    for (std::size_t axis = 0; axis < axis_letters.size(); ++axis) {
      take_bound(axis, false, number_after(bounds.substr(at, to - at), axis_letters.substr(axis, 1)));
      take_bound(axis, true, number_after(bounds.substr(to), axis_letters.substr(axis, 1)));
    }
    return;
  }
  for (std::size_t axis = 0; axis < axis_letters.size(); ++axis)
    for (const bool is_max : {false, true}) {
      const std::string letter(axis_letters.substr(axis, 1)), word = is_max ? "max" : "min";
      const std::optional<double> after = number_after(comment, word + letter);
      take_bound(axis, is_max, after ? after : number_after(comment, letter + word));
    }
}

/// True if an extent is that of the path times 25.4: one of both is in the wrong unit.
bool GcodeBounds::is_in_inches(const Eigen::AlignedBox3d& drawn, double scale) const {
  for (std::size_t axis = 0; axis < axis_letters.size(); ++axis) {
    if (!low_[axis] || !high_[axis]) continue;
    const double ratio =
        (*high_[axis] - *low_[axis]) * scale / drawn.sizes()[static_cast<Eigen::Index>(axis)];
    if (std::abs(ratio / 25.4 - 1.0) < 0.02) return true;
  }
  return false;
}

std::optional<std::string> GcodeBounds::disagreement(const Eigen::AlignedBox3d& drawn,
                                                     const Eigen::AlignedBox3d& all, double scale,
                                                     const std::string& name) const {
  const double size = std::max(all.sizes().maxCoeff(), 0.0);
  const double tolerance =
      std::max(0.5, 0.01 * size);  // mm: lines have a width, and curves an approximate box
  std::vector<std::string> told, read;
  bool may_be_frame = true;  // all bounds are outside of all that is reached
  for (std::size_t axis = 0; axis < axis_letters.size(); ++axis)
    for (const bool is_max : {false, true}) {
      const std::optional<double>& bound = (is_max ? high_ : low_)[axis];
      if (!bound || drawn.isEmpty()) continue;
      const auto i = static_cast<Eigen::Index>(axis);
      const double of_drawn = (is_max ? drawn.max() : drawn.min())[i],
                   of_all = (is_max ? all.max() : all.min())[i];
      const double value = *bound * scale;
      may_be_frame = may_be_frame && (is_max ? value - of_all : of_all - value) > tolerance;
      if (std::min(std::abs(value - of_drawn), std::abs(value - of_all)) <= tolerance) continue;
      const std::string title = fmt::format("{} {}", is_max ? "max" : "min", axis_letters[axis]);
      told.push_back(fmt::format("{} = {:.6g}", title, value));
      read.push_back(fmt::format("{} = {:.6g}", title, of_drawn));
    }
  if (told.empty() || (may_be_frame && !is_in_inches(drawn, scale))) return {};
  return fmt::format(
      "{}: its comments say {} mm, but the path that was read has {} mm; look for a wrong unit (G20, G21), "
      "and for parts that were passed over",
      name, fmt::join(told, ", "), fmt::join(read, ", "));
}

}  // namespace sandstroke
