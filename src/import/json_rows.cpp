#include "import/json_rows.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <utility>

#include "core/error.h"
#include "import/text_parts.h"

namespace sandstroke {
namespace {

using nlohmann::json;

constexpr std::string_view not_json[] = {"NaN", "Infinity", "-Infinity"};

struct JsonCell {
  std::string name, text;
};

/// Appends the cells of a value. False: it holds lists of lists, of texts, or longer ones, or is too deep.
bool append_cells(const json& value, const std::string& name, int depth, std::vector<JsonCell>& cells) {
  constexpr std::size_t longest_list = 16;  // a matrix
  constexpr int deepest = 8;
  if (depth > deepest) return false;
  if (value.is_object()) {
    for (auto item = value.begin(); item != value.end(); ++item)
      if (!append_cells(item.value(), name.empty() ? item.key() : name + "." + item.key(), depth + 1, cells))
        return false;
    return true;
  }
  if (value.is_array()) {
    if (value.size() > longest_list) return false;
    for (std::size_t i = 0; i < value.size(); ++i) {
      if (!value[i].is_number() && !value[i].is_null()) return false;
      append_cells(value[i], name + "[" + std::to_string(i) + "]", depth + 1, cells);
    }
    return true;
  }
  cells.push_back({name, value.is_null() ? "" : value.is_string() ? value.get<std::string>() : value.dump()});
  return true;
}

/// The line with null for NaN, Infinity and -Infinity, which Python writes and JSON has not.
std::string with_nulls(std::string_view line) {
  std::string plain;
  bool in_text = false;
  for (std::size_t at = 0; at < line.size(); ++at) {
    const std::string_view rest = line.substr(at);
    const auto number = in_text ? std::end(not_json)
                                : std::find_if(std::begin(not_json), std::end(not_json),
                                               [&](std::string_view one) { return rest.starts_with(one); });
    if (number != std::end(not_json)) {
      plain += "null";
      at += number->size() - 1;
      continue;
    }
    plain += line[at];
    if (in_text && line[at] == '\\' && at + 1 < line.size())
      plain += line[++at];  // perhaps a quote
    else if (line[at] == '"')
      in_text = !in_text;
  }
  return plain;
}

/// The cells of a line; empty if it is no object, or not a flat one.
std::vector<JsonCell> cells_of(std::string_view line) {
  std::vector<JsonCell> cells;
  if (!line.starts_with('{')) return cells;
  json object = json::parse(line, nullptr, false);
  if (object.is_discarded()) object = json::parse(with_nulls(line), nullptr, false);
  if (object.is_discarded() || !append_cells(object, "", 0, cells)) cells.clear();
  return cells;
}

}  // namespace

std::vector<std::string> JsonRows::names_in(std::string_view line) {
  std::vector<std::string> names;
  for (const JsonCell& cell : cells_of(line)) names.push_back(cell.name);
  if (names.size() < 2) names.clear();
  return names;
}

bool JsonRows::begin(std::string_view text) {
  const std::size_t end = text.find('\n');
  if (end == std::string_view::npos || names_in(text.substr(0, end)).empty()) return false;
  const std::string_view rest = without_blanks(text.substr(end));
  return rest.starts_with('{');
}

JsonRows::JsonRows(std::vector<std::string> names) : names_(std::move(names)), fields_(names_.size()) {
  for (std::size_t i = 0; i < names_.size(); ++i) columns_.emplace(names_[i], i);
}

const std::vector<std::string>& JsonRows::split(std::string_view line, const std::string& location) {
  const std::vector<JsonCell> cells = cells_of(line);
  if (cells.empty())
    throw_input_error("{}: is not a JSON object of numbers as the lines before; correct or remove the line",
                      location);
  for (std::string& field : fields_) field.clear();
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const std::string& name = cells[i].name;
    std::size_t column = i;  // most lines have the first one's order
    if (i >= names_.size() || names_[i] != name) {
      const auto found = columns_.find(name);
      if (found == columns_.end())
        throw_input_error(
            "{}: '{}' is not in the first line, whose names are {}; give all lines the same names", location,
            name, fmt::join(names_, ", "));
      column = found->second;
    }
    fields_[column] = cells[i].text;
  }
  return fields_;
}

}  // namespace sandstroke
