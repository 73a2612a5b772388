#include "import/json_rows.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <utility>

#include "core/error.h"
#include "import/text_parts.h"

namespace sandstroke {
namespace {

using nlohmann::json;

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

/// The cells of a line; empty if it is no object, or not a flat one.
std::vector<JsonCell> cells_of(std::string_view line) {
  std::vector<JsonCell> cells;
  if (!line.starts_with('{')) return cells;
  const json object = json::parse(line, nullptr, false);
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

const std::vector<std::string>& JsonRows::split(std::string_view line, const std::string& location) {
  const std::vector<JsonCell> cells = cells_of(line);
  if (cells.empty())
    throw_input_error("{}: is not a JSON object of numbers as the lines before; correct or remove the line",
                      location);
  for (std::string& field : fields_) field.clear();
  for (const JsonCell& cell : cells) {
    const auto name = std::find(names_.begin(), names_.end(), cell.name);
    if (name == names_.end())
      throw_input_error(
          "{}: '{}' is not in the first line, whose names are {}; give all lines the same names", location,
          cell.name, fmt::join(names_, ", "));
    fields_[static_cast<std::size_t>(name - names_.begin())] = cell.text;
  }
  return fields_;
}

}  // namespace sandstroke
