#include "io/toml_reader.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "core/error.h"
#include "core/input_file.h"
#include "core/nearest_name.h"
#include "io/toml_key_depth.h"
#include "io/toml_path.h"

namespace sandstroke {

std::string toml_string(const std::string& text) {
  try {
    return nlohmann::json(text).dump();
  } catch (const nlohmann::json::type_error&) {
    throw_input_error("{}: is not UTF-8, which TOML requires; rename it", text);
  }
}

std::string range_text(Range range) {
  const bool from_below = range.lowest > any_number.lowest, to_above = range.highest < any_number.highest;
  if (from_below && to_above)
    return range.open ? fmt::format("above {} and below {}", range.lowest, range.highest)
                      : fmt::format("from {} to {}", range.lowest, range.highest);
  if (from_below)
    return range.open ? fmt::format("above {}", range.lowest) : fmt::format("{} or more", range.lowest);
  return to_above ? fmt::format("{} or less", range.highest) : "";
}

struct TomlReader::Document {
  std::string name;
  toml::table root;
  std::set<const toml::node*> read;
  std::set<std::string> asked_for;               // every dotted key that some reader knows
  std::map<std::string, std::string> overrides;  // dotted key -> the --set that gave it
  std::set<std::string> lists;                   // those whose tables are named by their places
};

namespace {

toml::table parse(std::string_view text, const std::string& name) {
  check_key_depth(text, name);
  try {
    return toml::parse(text, name);
  } catch (const toml::parse_error& failure) {
    throw_input_error("{}:{}: not valid TOML: {}", name, failure.source().begin.line, failure.description());
  }
}

std::string type_name(const toml::node& node) {
  switch (node.type()) {
    case toml::node_type::table:
      return "a table";
    case toml::node_type::array:
      return "an array";
    case toml::node_type::string:
      return "a string";
    case toml::node_type::integer:
      return "an integer";
    case toml::node_type::floating_point:
      return "a number";
    case toml::node_type::boolean:
      return "true or false";
    default:
      return "a date or time";
  }
}

/// True for "35deg" or "[5mm, 6mm]".
bool begins_as_number(std::string_view text) {
  const auto begin = text.find_first_not_of("[ +-.");
  return begin != std::string_view::npos && text[begin] >= '0' && text[begin] <= '9';
}

/// A value as TOML text, on one line. A number has the shortest digits that give it back.
std::string literal_of(const toml::node& node) {
  if (const auto* number = node.as_floating_point()) return fmt::format("{}", number->get());
  if (const auto* number = node.as_integer()) return fmt::format("{}", number->get());  // decimal
  if (const auto* text = node.as_string()) return toml_string(text->get());
  if (const toml::array* array = node.as_array()) {
    std::vector<std::string> elements;
    for (const toml::node& element : *array) elements.push_back(literal_of(element));
    return fmt::format("[{}]", fmt::join(elements, ", "));
  }
  if (const toml::table* table = node.as_table()) {
    std::vector<std::string> entries;
    for (const auto& [key, value] : *table)
      entries.push_back(fmt::format("{} = {}", key.str(), literal_of(value)));
    return fmt::format("{{ {} }}", fmt::join(entries, ", "));
  }
  std::ostringstream text;
  node.visit([&](const auto& value) { text << value; });
  return text.str();
}

}  // namespace

TomlReader::TomlReader(std::shared_ptr<Document> document, toml::table* table, std::string prefix)
    : document_(std::move(document)), table_(table), prefix_(std::move(prefix)) {}

TomlReader TomlReader::from_file(const std::filesystem::path& path) {
  return from_text(read_text_file(path), path.string());
}

TomlReader TomlReader::from_text(std::string_view text, const std::string& name) {
  auto document = std::make_shared<Document>();
  document->name = name;
  document->root = parse(text, name);
  toml::table* root = &document->root;
  return {std::move(document), root, ""};
}

const std::string& TomlReader::name() const { return document_->name; }

std::string TomlReader::overrides_in(std::string_view sentence) const {
  std::vector<std::string> named;
  for (const auto& [key, assignment] : document_->overrides)
    if (sentence.find(key) != std::string_view::npos) named.push_back("--set " + assignment);
  return fmt::format("{}", fmt::join(named, ", "));
}

void TomlReader::take_out(const std::string& key) {
  if (key.find('=') != std::string::npos)
    throw_input_error("--unset {}: give only the key, without a value", key);
  check_key_depth(key, "--unset");
  const std::vector<std::string> parts = key_parts(key);
  toml::node* node = &document_->root;
  for (std::size_t i = 0; node && i + 1 < parts.size(); ++i) node = child(*node, parts[i]);
  if (node && is_list(*node) && child(*node, parts.back()))
    throw_input_error(
        "--unset {}: would give the tables behind it other numbers; take the table out of {}, or take out "
        "its keys, as {}.KEY",
        key, document_->name, key);
  if (toml::table* table = node ? node->as_table() : nullptr; table && table->erase(parts.back())) return;
  const std::vector<std::string> keys = keys_in("");
  const std::string meant = nearest_name(key, {keys.begin(), keys.end()});
  throw_input_error("--unset {}: {} has no such key; {}", key, document_->name,
                    meant.empty() ? "leave the option out" : fmt::format("did you mean {}?", meant));
}

void TomlReader::fail_in_list(const std::string& assignment, const std::string& list,
                              const std::string& place, std::size_t tables, bool found) const {
  if (!is_place(place))
    throw_input_error("--set {}: {} is a list of tables in {}; say which one, as {}.1.{}", assignment, list,
                      document_->name, list, place);
  const std::string key = list + "." + place;
  if (found)
    throw_input_error("--set {}: {} is a table; set one of its keys, as {}.KEY=value", assignment, key, key);
  throw_input_error("--set {}: {} has {} [[{}]] {}, counted from 1, and no {}", assignment, document_->name,
                    tables, list, tables == 1 ? "table" : "tables", key);
}

void TomlReader::override_with(const std::string& assignment) {
  const auto equals = assignment.find('=');
  if (assignment.starts_with('!')) return take_out(assignment.substr(1));
  if (equals == 0 || equals == std::string::npos)
    throw_input_error("--set {}: not an assignment; write --set section.key=value", assignment);
  const std::string key = assignment.substr(0, equals);
  const std::string value = assignment.substr(equals + 1);
  check_key_depth(assignment, "--set");

  toml::table parsed;
  try {
    parsed = toml::parse("value = " + value);
  } catch (const toml::parse_error&) {
    parsed.insert("value", value);  // a bare word: --set relaxation.law=isotropic
  }
  if (parsed.size() != 1)
    throw_input_error("--set {}: the value is not a TOML value; put text in quotes", assignment);

  const std::vector<std::string> parts = key_parts(key);
  toml::table* table = &document_->root;
  std::string way;
  for (std::size_t i = 0; i + 1 < parts.size(); ++i) {
    toml::node* next = &table->insert(parts[i], toml::table{}).first->second;
    way += (i > 0 ? "." : "") + parts[i];
    if (is_list(*next)) {
      const std::string& place = parts[++i];
      toml::node* entry = child(*next, place);
      if (!entry || i + 1 == parts.size())
        fail_in_list(assignment, way, place, next->as_array()->size(), entry != nullptr);
      next = entry;
      way += "." + place;
    }
    table = next->as_table();
    if (!table) throw_input_error("--set {}: {} is not a table in {}", assignment, way, document_->name);
  }
  parsed.begin()->second.visit([&](auto& node) { table->insert_or_assign(parts.back(), std::move(node)); });
  document_->overrides[key] = assignment;
}

const toml::node* TomlReader::find(std::string_view key) const {
  document_->asked_for.insert(prefix_ + std::string(key));
  const toml::node* node = table_;
  std::string before;
  for (const std::string& part : key_parts(key)) {
    const bool list = is_list(*node);
    if (list && !is_place(part))
      fail(key, fmt::format("is not found: '{}' is a list of tables; write [{}]", before, before));
    if (!list && !node->is_table())
      fail(key, fmt::format("'{}' is {}, not a table", before, type_name(*node)));
    if (!(node = child(*node, part))) return nullptr;
    document_->read.insert(node);
    before = part;
  }
  return node;
}

bool TomlReader::has(std::string_view key) const { return find(key) != nullptr; }

void TomlReader::skip(std::string_view key) const {
  find(key);
  document_->asked_for.erase(prefix_ + std::string(key));  // no error suggests it
}

void TomlReader::require(std::string_view key) const {
  if (has(key)) return;
  const toml::node* inner = table_;  // the innermost one that exists
  std::vector<std::string> parts = key_parts(key);
  while (const toml::node* next = child(*inner, parts.front())) {
    inner = next;
    parts.erase(parts.begin());
  }
  std::set<std::string> others;
  for (const auto& [name, node] : *inner->as_table())
    if (!document_->read.contains(&node)) others.emplace(name.str());
  const std::string misspelt = nearest_name(parts.front(), others);
  fail(key, misspelt.empty()
                ? "is missing; add it"
                : fmt::format("is missing; add it, or is {} meant to be {}?", misspelt, parts.front()));
}

void TomlReader::fail(std::string_view key, const std::string& sentence) const {
  const std::string full = prefix_ + std::string(key);
  if (const std::string set = override_of(full); !set.empty())
    throw_input_error("{}: {} {}", set, full, sentence);
  const toml::node* located = table_;  // the innermost one that is there
  bool in_list = !prefix_.empty(), whole = true;
  for (const std::string& part : key_parts(key)) {
    in_list = in_list || is_list(*located);
    const toml::node* next = child(*located, part);
    if (!(whole = next != nullptr)) break;
    located = next;
  }
  if (const auto line = located->source().begin.line; line > 0 && (whole || in_list))
    throw_input_error("{}:{}: {} {}", document_->name, line, full, sentence);
  throw_input_error("{}: {} {}", document_->name, full, sentence);
}

double TomlReader::checked(std::string_view key, const toml::node& node, Range range,
                           std::string_view unit) const {
  if (const auto* text = node.as_string(); text && begins_as_number(text->get()))
    fail(key, fmt::format("is '{}'; give only the number{}", text->get(),
                          unit.empty() ? "" : fmt::format(", in {}", unit)));
  if (!node.is_number()) fail(key, fmt::format("is {}; give a number", type_name(node)));
  const std::optional<double> converted = node.value<double>();  // none for most integers beyond 2^53
  if (!converted)
    fail(key, fmt::format("is {}, but whole numbers are exact only up to 2^53 = 9007199254740992; give a "
                          "smaller one, or write it with a decimal point",
                          node.value<std::int64_t>().value_or(0)));
  const double number = *converted;
  if (!std::isfinite(number)) fail(key, fmt::format("is {}; give a finite number", number));
  if (!range.contains(number)) fail(key, fmt::format("is {}; give a number {}", number, range_text(range)));
  if (range.whole && number != std::floor(number))
    fail(key, fmt::format("is {}; give a whole number", number));
  return number;
}

double TomlReader::number(std::string_view key, double fallback, Range range, std::string_view unit) const {
  const toml::node* node = find(key);
  return node ? checked(key, *node, range, unit) : fallback;
}

int TomlReader::integer(std::string_view key, int fallback, int lowest, int highest) const {
  const toml::node* node = find(key);
  if (!node) return fallback;
  if (!node->is_integer()) fail(key, fmt::format("is {}; give an integer", type_name(*node)));
  const std::int64_t number = *node->value<std::int64_t>();
  if (number < lowest || number > highest)
    fail(key, fmt::format("is {}; give an integer from {} to {}", number, lowest, highest));
  return static_cast<int>(number);
}

bool TomlReader::boolean(std::string_view key, bool fallback) const {
  const toml::node* node = find(key);
  if (!node) return fallback;
  if (!node->is_boolean()) fail(key, fmt::format("is {}; give true or false", type_name(*node)));
  return *node->value<bool>();
}

std::string TomlReader::text(std::string_view key, const std::string& fallback) const {
  const toml::node* node = find(key);
  if (!node) return fallback;
  // With --set stroke.table.time=1 the shell has taken the quotes away.
  const auto set = document_->overrides.find(prefix_ + std::string(key));
  if (node->is_number() && set != document_->overrides.end())
    return set->second.substr(set->first.size() + 1);
  if (!node->is_string()) fail(key, fmt::format("is {}; give a string in quotes", type_name(*node)));
  return *node->value<std::string>();
}

std::vector<double> TomlReader::numbers(std::string_view key, const std::vector<double>& fallback,
                                        Range range, std::string_view unit) const {
  if (!has(key)) return fallback;
  const std::vector<double> found = profile(key, fallback, range, unit);
  if (found.size() != fallback.size())
    fail(key, fmt::format("has {} numbers; give {}", found.size(), fallback.size()));
  return found;
}

std::vector<double> TomlReader::profile(std::string_view key, const std::vector<double>& fallback,
                                        Range range, std::string_view unit) const {
  const toml::node* node = find(key);
  if (!node) return fallback;
  const toml::array* array = node->as_array();
  if (!array) return {checked(key, *node, range, unit)};
  if (array->empty()) fail(key, "is empty; give at least one number");
  std::vector<double> found;
  for (const toml::node& element : *array) found.push_back(checked(key, element, range, unit));
  return found;
}

std::vector<std::vector<double>> TomlReader::points(std::string_view key) const {
  const toml::node* node = find(key);
  std::vector<std::vector<double>> found;
  if (!node) return found;
  const char* expected = "is not a list of points; write [[x, y], [x, y], ...]";
  if (!node->is_array()) fail(key, expected);
  for (const toml::node& element : *node->as_array()) {
    const toml::array* point = element.as_array();
    if (!point || point->size() != 2) fail(key, expected);
    found.push_back({checked(key, (*point)[0], any_number), checked(key, (*point)[1], any_number)});
  }
  return found;
}

int TomlReader::choice(std::string_view key, int fallback, const std::vector<std::string>& names) const {
  if (!has(key)) return fallback;
  const std::string name = text(key, "");
  const auto found = std::find(names.begin(), names.end(), name);
  if (found == names.end()) fail(key, fmt::format("is '{}'; take one of: {}", name, fmt::join(names, ", ")));
  return static_cast<int>(found - names.begin());
}

std::vector<std::string> TomlReader::texts(std::string_view key,
                                           const std::vector<std::string>& fallback) const {
  const toml::node* node = find(key);
  if (!node) return fallback;
  std::vector<std::string> found;
  if (!node->is_array()) fail(key, fmt::format("is {}; give a list of strings", type_name(*node)));
  for (const toml::node& element : *node->as_array()) {
    if (!element.is_string()) fail(key, fmt::format("holds {}; give strings", type_name(element)));
    found.push_back(*element.value<std::string>());
  }
  return found;
}

std::vector<std::string> TomlReader::keys_in(std::string_view key,
                                             const std::vector<std::string>& leaves) const {
  const toml::node* top = key.empty() ? table_ : find(key);
  if (!top) return {};
  if (!top->is_table()) fail(key, fmt::format("is {}; write a [{}] table", type_name(*top), key));
  std::vector<std::pair<toml::source_position, std::string>> found;
  const auto visit = [&](const auto& self, const toml::table& table, const std::string& prefix) -> void {
    for (const auto& [name, node] : table) {
      if (name.str().find('.') != std::string_view::npos)
        fail(key, fmt::format("holds \"{}\"; write dotted keys without quotes", name.str()));
      const toml::table* inner = node.as_table();
      const std::string full = prefix + std::string(name.str());
      const auto in_it = [&](const std::string& leaf) { return inner->contains(leaf); };
      if (inner && std::none_of(leaves.begin(), leaves.end(), in_it))
        self(self, *inner, full + ".");
      else
        found.emplace_back(name.source().begin, full);
    }
  };
  visit(visit, *top->as_table(), "");
  std::sort(found.begin(), found.end());
  std::vector<std::string> keys;
  for (auto& [place, full] : found) keys.push_back(std::move(full));
  return keys;
}

std::string TomlReader::literal(std::string_view key) const {
  const toml::node* node = find(key);
  return node ? literal_of(*node) : "";
}

std::vector<std::string> TomlReader::literals(std::string_view key) const {
  const toml::node* node = find(key);
  std::vector<std::string> found;
  if (!node) return found;
  const toml::array* array = node->as_array();
  if (!array) return {literal_of(*node)};
  for (const toml::node& element : *array) found.push_back(literal_of(element));
  return found;
}

bool TomlReader::is_table(std::string_view key) const {
  const toml::node* node = find(key);
  return node && node->is_table();
}

std::vector<TomlReader> TomlReader::tables(std::string_view key) const {
  std::vector<TomlReader> found;
  const toml::node* node = find(key);
  if (!node) return found;
  if (!node->is_array_of_tables())
    fail(key, fmt::format("is {}; write [[{}]] tables", type_name(*node), key));
  auto* array = const_cast<toml::node*>(node)->as_array();  // the document is ours; find() only looks
  for (toml::node& element : *array) {
    document_->read.insert(&element);
    found.push_back({document_, element.as_table(), prefix_ + std::string(key) + "."});
  }
  return found;
}

int TomlReader::count_tables(std::string_view key) const {
  const std::string full = prefix_ + std::string(key);
  document_->lists.insert(full);
  const toml::node* node = find(key);
  if (!node) return 0;
  if (node->is_table() && node->as_table()->size() > 0 && is_place(node->as_table()->begin()->first.str()))
    fail(key, fmt::format("has no table in {}; add one that begins with [[{}]]", document_->name, full));
  if (node->is_table()) fail(key, fmt::format("is one table; write [[{}]], with two brackets", full));
  if (!is_list(*node)) fail(key, fmt::format("is {}; write [[{}]] tables", type_name(*node), full));
  return static_cast<int>(node->as_array()->size());
}

std::string TomlReader::override_of(const std::string& key) const {
  for (const auto& [set, assignment] : document_->overrides)
    if (set == key || set.starts_with(key + ".") || key.starts_with(set + ".")) return "--set " + assignment;
  return {};
}

void TomlReader::reject_unread(const Conditions& conditions, const LeaveOut& leave_out) const {
  const auto reject = [&](const std::string& key, const toml::node& node) {
    const std::string set = override_of(key);
    const std::string location =
        set.empty() ? fmt::format("{}:{}", document_->name, node.source().begin.line) : set;
    const auto known = conditions ? conditions() : std::map<std::string, std::string>{};
    const std::string first = at_first_places(key);
    if (const auto found = known.find(first); found != known.end()) {
      const std::string condition = at_places_of(key, found->second);
      if (leave_out && leave_out(key, condition)) return;
      throw_input_error("{}: {} applies only where {}; remove it, or change that setting", location, key,
                        condition);
    }
    std::set<std::string> names;
    for (const std::string& other : document_->asked_for) names.insert(at_first_places(other));
    for (const auto& [other, condition] : known) names.insert(other);
    const std::string suggestion = at_places_of(key, nearest_name(first, names));
    throw_input_error("{}: unknown key {}{}", location, key,
                      suggestion.empty()
                          ? "; remove it (sandstroke help scene, script or plan lists the keys)"
                          : fmt::format("; did you mean {}?", suggestion));
  };
  const auto visit = [&](const auto& self, const toml::table& table, const std::string& prefix) -> void {
    for (const auto& [key, node] : table) {
      const std::string full = prefix + std::string(key.str());
      if (!document_->read.contains(&node)) reject(full, node);
      if (const toml::table* inner = node.as_table()) self(self, *inner, full + ".");
      if (const toml::array* array = node.as_array()) {
        const bool named_by_place = document_->lists.contains(full);
        int place = 0;
        for (const toml::node& element : *array) {
          const std::string inside = named_by_place ? fmt::format("{}.{}.", full, ++place) : full + ".";
          if (const toml::table* inner = element.as_table()) self(self, *inner, inside);
        }
      }
    }
  };
  visit(visit, document_->root, "");
}

}  // namespace sandstroke
