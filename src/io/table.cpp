#include "io/table.h"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <sstream>

namespace sandstroke {
namespace {

std::string quoted(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string result = "\"";
  for (const char c : text) result += c == '"' ? std::string("\"\"") : std::string(1, c);
  return result + '"';
}

const std::vector<double>* numbers_of(const TableColumn& column) {
  return std::get_if<std::vector<double>>(&column.values);
}
const std::string& text_at(const TableColumn& column, std::size_t row) {
  return std::get<std::vector<std::string>>(column.values)[row];
}

}  // namespace

std::size_t Table::rows() const {
  if (columns.empty()) return 0;
  return std::visit([](const auto& values) { return values.size(); }, columns.front().values);
}

void write_csv(std::ostream& file, const Table& table) {
  const auto end_field = [&](std::size_t column) {
    file.put(column + 1 < table.columns.size() ? ',' : '\n');
  };
  for (std::size_t i = 0; i < table.columns.size(); ++i) file << quoted(table.columns[i].name), end_field(i);
  for (std::size_t row = 0; row < table.rows(); ++row)
    for (std::size_t i = 0; i < table.columns.size(); ++i) {
      const std::vector<double>* numbers = numbers_of(table.columns[i]);
      if (!numbers)
        file << quoted(text_at(table.columns[i], row));
      else if (!std::isnan((*numbers)[row]))
        fmt::format_to(std::ostreambuf_iterator<char>(file), "{}", (*numbers)[row]);
      end_field(i);
    }
}

std::string csv_text(const Table& table) {
  std::ostringstream text;
  write_csv(text, table);
  return text.str();
}

void write_table(Hdf5Writer& file, const std::string& group, const Table& table) {
  for (const TableColumn& column : table.columns) {
    const std::string dataset = group + "/" + column.name;
    std::visit([&](const auto& values) { file.write(dataset, values); }, column.values);
    file.attribute(dataset, "title", column.title);
    if (!column.unit.empty()) file.attribute(dataset, "units", column.unit);
  }
}

nlohmann::ordered_json number_or_null(double value) {
  return std::isfinite(value) ? nlohmann::ordered_json(value) : nlohmann::ordered_json();
}

nlohmann::ordered_json row_json(const Table& table, std::size_t row) {
  nlohmann::ordered_json json;
  for (const TableColumn& column : table.columns) {
    const std::vector<double>* numbers = numbers_of(column);
    if (!numbers)
      json[column.name] = text_at(column, row);
    else
      json[column.name] = number_or_null((*numbers)[row]);
  }
  return json;
}

nlohmann::ordered_json columns_json(const Table& table) {
  nlohmann::ordered_json json = nlohmann::ordered_json::array();
  for (const TableColumn& column : table.columns)
    json.push_back({{"name", column.name}, {"title", column.title}, {"unit", column.unit}});
  return json;
}

std::string aligned_text(const Table& table, int digits) {
  std::string text;
  std::vector<std::vector<std::string>> cells;  // by column
  for (const TableColumn& column : table.columns) {
    cells.push_back({column.title + (column.unit.empty() ? "" : " [" + column.unit + "]")});
    for (std::size_t row = 0; row < table.rows(); ++row) {
      const std::vector<double>* numbers = numbers_of(column);
      if (!numbers)
        cells.back().push_back(text_at(column, row));
      else
        cells.back().push_back(std::isnan((*numbers)[row]) ? "-"
                                                           : fmt::format("{:.{}g}", (*numbers)[row], digits));
    }
  }
  for (std::size_t row = 0; row <= table.rows(); ++row) {
    std::string line;
    for (std::size_t i = 0; i < cells.size(); ++i) {
      std::size_t width = 0;
      for (const std::string& cell : cells[i]) width = std::max(width, cell.size());
      line += numbers_of(table.columns[i]) ? fmt::format("{:>{}}  ", cells[i][row], width)
                                           : fmt::format("{:<{}}  ", cells[i][row], width);
    }
    text += line.substr(0, line.find_last_not_of(' ') + 1) + '\n';
  }
  return text;
}

}  // namespace sandstroke
