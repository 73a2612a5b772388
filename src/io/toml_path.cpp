#include "io/toml_path.h"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <charconv>

namespace sandstroke {

std::vector<std::string> key_parts(std::string_view key) {
  std::vector<std::string> parts;
  while (true) {
    const auto dot = key.find('.');
    parts.emplace_back(key.substr(0, dot));
    if (dot == std::string_view::npos) return parts;
    key.remove_prefix(dot + 1);
  }
}

bool is_place(std::string_view part) {
  return !part.empty() && std::all_of(part.begin(), part.end(), [](char c) { return c >= '0' && c <= '9'; });
}

bool is_list(const toml::node& node) {
  const toml::array* array = node.as_array();
  return array && (array->empty() || array->is_array_of_tables());
}

toml::node* child(toml::node& parent, const std::string& part) {
  if (toml::table* table = parent.as_table()) return table->get(part);
  std::size_t place = 0;
  const char* end = part.data() + part.size();
  if (!is_list(parent) || !is_place(part) || std::from_chars(part.data(), end, place).ec != std::errc{} ||
      place == 0)
    return nullptr;
  return parent.as_array()->get(place - 1);
}

const toml::node* child(const toml::node& parent, const std::string& part) {
  return child(const_cast<toml::node&>(parent), part);  // it only looks
}

std::string at_first_places(std::string_view key) {
  std::vector<std::string> parts = key_parts(key);
  for (std::size_t i = 1; i < parts.size(); ++i)
    if (is_place(parts[i])) parts[i].assign(1, '1');
  return fmt::format("{}", fmt::join(parts, "."));
}

std::string at_places_of(std::string_view key, std::string text) {
  std::string list;
  for (const std::string& part : key_parts(key)) {
    if (!list.empty() && is_place(part)) {
      const std::string first = list + "1.", here = list + part + '.';
      for (std::size_t at = text.find(first); at != std::string::npos;
           at = text.find(first, at + here.size()))
        text.replace(at, first.size(), here);
    }
    list += part + '.';
  }
  return text;
}

}  // namespace sandstroke
