#include "io/key_table.h"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <limits>

#include "io/toml_reader.h"

namespace sandstroke {
namespace {

/// Collects the keys that it is shown. It sets the key `name` to `chosen`, as if read from a file.
class KeyLister : public KeyVisitor {
 public:
  KeyLister() = default;
  KeyLister(std::string name, std::string chosen)
      : reads_(true), name_(std::move(name)), chosen_(std::move(chosen)) {}
  std::vector<KeySection> sections;

  void section(const char* name, const char* help) override { sections.push_back({name, help, {}}); }
  bool optional_section(const char* name, bool present, const char* help) override {
    if (present) section(name, help);
    return present;
  }
  int tables(const char*, int count) override { return count; }
  void table(const char* list, int place, const char* help) override {
    sections.push_back({fmt::format("{}.{}", list, place), help, {}, true});
  }
  bool given(const char*) override { return no_default_ = true; }
  void require(const char*) override { no_default_ = required_ = true; }
  void number(const char* key, double& value, Range range, const char* unit, const char* help) override {
    add(key, literal(value), help, unit, range);
  }
  void numbers(const char* key, double* values, int count, Range range, const char* unit,
               const char* help) override {
    std::vector<std::string> literals;
    for (int i = 0; i < count; ++i) literals.push_back(literal(values[i]));
    add(key, fmt::format("[{}]", fmt::join(literals, ", ")), help, unit, range);
  }
  void profile(const char* key, std::vector<double>&, Range range, const char* unit,
               const char* help) override {
    add(key, "", help, unit, range);
  }
  void points(const char* key, std::vector<Eigen::Vector2d>& values, const char* unit,
              const char* help) override {
    std::vector<std::string> literals;
    for (const Eigen::Vector2d& at : values)
      literals.push_back(fmt::format("[{}, {}]", literal(at.x()), literal(at.y())));
    add(key, values.empty() ? "" : fmt::format("[{}]", fmt::join(literals, ", ")), help, unit);
  }
  void integers(const char* key, int* values, int count, int lowest, int highest, const char* help) override {
    const std::string list = fmt::format("{}", fmt::join(values, values + count, ", "));
    const bool bounded = highest < std::numeric_limits<int>::max();
    add(key, count == 1 ? list : "[" + list + "]", help, "",
        {static_cast<double>(lowest), bounded ? static_cast<double>(highest) : any_number.highest});
  }
  void flag(const char* key, bool& value, const char* help) override {
    add(key, value ? "true" : "false", help).choices = {"true", "false"};
  }
  void text(const char* key, std::string& value, const char* help) override {
    add(key, toml_string(value), help);
  }
  void texts(const char* key, std::vector<std::string>&, const char* help) override { add(key, "", help); }
  void choice(const char* key, int& value, const std::vector<std::string>& names, const char* help) override {
    KeyRow& row = add(key, "", help);
    if (row.name == name_)
      value = static_cast<int>(std::find(names.begin(), names.end(), chosen_) - names.begin());
    if (!row.required) row.value = '"' + names[static_cast<std::size_t>(value)] + '"';
    row.choices = names;
  }
  bool reads() const override { return reads_; }

 private:
  KeyRow& add(const std::string& key, const std::string& value, const std::string& help,
              const std::string& unit = "", Range range = any_number) {
    KeySection& section = sections.back();
    section.keys.push_back({section.name + (section.name.empty() ? "" : ".") + key, no_default_ ? "" : value,
                            unit, range_text(range), help, required_});
    no_default_ = required_ = false;
    return section.keys.back();
  }

  /// The shortest digits that give the same number back, with a point or exponent, as TOML requires.
  static std::string literal(double value) {
    std::string digits = fmt::format("{}", value);
    if (digits.find_first_of(".en") == std::string::npos) digits += ".0";
    return digits;
  }

  bool reads_ = false;
  std::string name_, chosen_;
  bool no_default_ = false, required_ = false;  // of the next key
};

/// The keys with their defaults, except for one choice; no name: no exception.
std::vector<KeySection> keys_with(const ShowKeys& show, const std::string& name, const std::string& chosen) {
  KeyLister lister(name, chosen);
  show(lister);
  return std::move(lister.sections);
}

auto find_key(const std::vector<KeyRow>& keys, const std::string& name) {
  return std::find_if(keys.begin(), keys.end(), [&](const KeyRow& key) { return key.name == name; });
}

/// Adds keys that are not there yet, each before the key it precedes in `more`.
void merge(std::vector<KeyRow>& keys, const std::vector<KeyRow>& more) {
  auto place = keys.cend();
  for (auto key = more.rbegin(); key != more.rend(); ++key) {
    const auto found = find_key(keys, key->name);
    place = found != keys.end() ? found : keys.insert(place, *key);
  }
}

/// Adds to `all` the keys that each value of one choice brings. A preset's values go to the keys that it
/// sets.
void try_choices(const ShowKeys& show, const KeyRow& by, std::vector<KeySection>& all) {
  std::map<std::string, std::vector<std::string>> brought_by;  // key -> the choices that show it
  for (const std::string& chosen : by.choices) {
    const std::vector<KeySection> other = keys_with(show, by.name, chosen);
    for (std::size_t i = 0; i < all.size(); ++i) {
      merge(all[i].keys, other[i].keys);
      for (KeyRow& key : all[i].keys) {
        const auto made = find_key(other[i].keys, key.name);
        if (made == other[i].keys.end()) continue;
        brought_by[key.name].push_back(chosen);
        if (by.key() == "preset" && made->value != key.value && key.name != by.name)
          key.presets.push_back(chosen + ": " + made->value);
      }
    }
  }
  if (by.key() == "preset") return;  // a preset only makes choices that could be made without it
  for (KeySection& section : all) {
    for (KeyRow& key : section.keys) {
      const std::vector<std::string>& with = brought_by[key.name];
      if (!with.empty() && with.size() < by.choices.size())
        key.condition = fmt::format("{} is {}", by.name, fmt::join(with, " or "));
    }
  }
}

}  // namespace

std::string KeySection::header() const {
  return in_list ? fmt::format("[[{}]]", name.substr(0, name.rfind('.'))) : fmt::format("[{}]", name);
}

std::string KeyRow::explanation() const {
  std::string sentence = help;
  if (!choices.empty()) sentence += fmt::format(" ({})", fmt::join(choices, " | "));
  if (!range.empty()) sentence += "; " + range;
  if (!presets.empty()) sentence += fmt::format("; with preset {}", fmt::join(presets, ", "));
  if (required) sentence += "; must be given";
  if (!condition.empty()) sentence += "; applies where " + condition;
  return sentence;
}

std::vector<KeySection> listed_keys(const ShowKeys& show) {
  KeyLister lister;
  show(lister);
  return std::move(lister.sections);
}

std::vector<KeySection> all_keys(const ShowKeys& show) {
  const std::vector<KeySection> base = keys_with(show, "", "");
  std::vector<KeySection> all = base;
  for (const KeySection& section : base)
    for (const KeyRow& key : section.keys) try_choices(show, key, all);
  return all;
}

std::map<std::string, std::string> conditions(const std::vector<KeySection>& sections) {
  std::map<std::string, std::string> found;
  for (const KeySection& section : sections)
    for (const KeyRow& key : section.keys)
      if (!key.condition.empty()) found[key.name] = key.condition;
  return found;
}

std::string key_table(const std::vector<KeySection>& sections) {
  std::string table;
  for (const KeySection& section : sections) {
    if (!table.empty()) table += '\n';
    table +=
        section.name.empty() ? section.help + '\n' : fmt::format("{}  {}\n", section.header(), section.help);
    for (const KeyRow& key : section.keys)
      table += fmt::format("  {:<28} {:<14} {:<7} {}\n", key.name, key.value, key.unit, key.explanation());
  }
  return table;
}

}  // namespace sandstroke
