#include "cli/table_options.h"

#include <algorithm>
#include <cctype>

#include "cli/commands.h"
#include "cli/parse_number.h"
#include "core/error.h"
#include "import/table_option.h"
#include "io/key_table.h"

namespace sandstroke {
namespace {

/// Gives each key the value of its option. The command line has checked the value.
class OptionReader : public KeyVisitor {
 public:
  explicit OptionReader(const TableOptions& given) : given_(given) {}

  void number(const char* key, double& value, Range, const char*, const char*) override {
    if (const std::string* text = find(key)) parse_number(*text, value);
  }
  void integers(const char* key, int* values, int, int, int, const char*) override {
    double number = values[0];
    if (const std::string* text = find(key)) parse_number(*text, number);
    values[0] = static_cast<int>(number);
  }
  void text(const char* key, std::string& value, const char*) override {
    if (const std::string* given = find(key)) value = *given;
  }
  void choice(const char* key, int& value, const std::vector<std::string>& names, const char*) override {
    if (const std::string* text = find(key))
      value = static_cast<int>(std::find(names.begin(), names.end(), *text) - names.begin());
  }
  bool reads() const override { return true; }

  // [stroke.table] uses none of these.
  void section(const char*, const char*) override {}
  bool optional_section(const char*, bool, const char*) override { return true; }
  int tables(const char*, int count) override { return count; }
  void table(const char*, int, const char*) override {}
  bool given(const char*) override { return false; }
  void require(const char*) override {}
  void numbers(const char*, double*, int, Range, const char*, const char*) override {}
  void profile(const char*, std::vector<double>&, Range, const char*, const char*) override {}
  void points(const char*, std::vector<Eigen::Vector2d>&, const char*, const char*) override {}
  void flag(const char*, bool&, const char*) override {}
  void texts(const char*, std::vector<std::string>&, const char*) override {}

 private:
  const std::string* find(const char* key) const {
    const auto found = given_.find(key);
    return found == given_.end() || found->second.empty() ? nullptr : &found->second;
  }

  const TableOptions& given_;
};

/// Adds an option for each key that it is shown.
class OptionAdder : public OptionReader {
 public:
  OptionAdder(CLI::App& command, TableOptions& given)
      : OptionReader(given), command_(command), given_(given) {}

  void number(const char* key, double&, Range range, const char* unit, const char* help) override {
    add(key, help, *unit ? unit : "NUMBER")->check(number_within(range));
  }
  void integers(const char* key, int*, int, int lowest, int highest, const char* help) override {
    add(key, help, "N")
        ->check(number_within({static_cast<double>(lowest), static_cast<double>(highest), false, true}));
  }
  void text(const char* key, std::string&, const char* help) override { add(key, help, "TEXT"); }
  void choice(const char* key, int&, const std::vector<std::string>& names, const char* help) override {
    const std::string choices = fmt::format("{} ({})", help, fmt::join(names, " | "));
    add(key, choices.c_str(), "CHOICE")->check(CLI::IsMember(names));
  }

 private:
  CLI::Option* add(const char* key, const char* help, const char* value) {
    std::string sentence = help;
    sentence[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(sentence[0])));
    return command_.add_option(option_of(key), given_[key], sentence)->option_text(value);
  }

  CLI::App& command_;
  TableOptions& given_;
};

}  // namespace

void add_table_options(CLI::App& command, TableOptions& given) {
  OptionAdder adder(command, given);
  TableSettings table;
  describe_table(adder, table);
}

TableSettings table_settings(const TableOptions& given) {
  OptionReader reader(given);
  TableSettings table;
  describe_table(reader, table);
  return table;
}

}  // namespace sandstroke
