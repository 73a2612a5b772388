#include "cli/help_formatter.h"

#include <spdlog/fmt/fmt.h>

#include <regex>
#include <set>

namespace sandstroke {
namespace {

/// Describes the values that an option takes.
std::string value_words(const CLI::Option& option) {
  std::string type = option.get_type_name();
  type.erase(0, type.find(':') + 1);  // the check after the colon says more than the type before it
  if (type == "FLOAT") return "NUMBER";
  if (type == "INT") return "INTEGER";
  return std::regex_replace(type, std::regex(R"((?:INT|FLOAT) in \[(.*) - (.*)\])"), "$1 to $2");
}

std::string names(const std::set<CLI::Option*>& options) {
  std::set<std::string> sorted;
  for (const CLI::Option* option : options) sorted.insert(option->get_name());
  return fmt::format("{}", fmt::join(sorted, ", "));
}

}  // namespace

std::string HelpFormatter::make_option_name(const CLI::Option* option, bool is_positional) const {
  const std::string name = CLI::Formatter::make_option_name(option, is_positional);
  return name.substr(0, name.find('{'));  // without a flag's default value
}

std::string HelpFormatter::make_option_opts(const CLI::Option* option) const {
  std::string words = option->get_option_text();
  const bool is_flag = option->get_items_expected_max() == 0;
  if (words.empty()) words = value_words(*option);
  if (is_flag && !words.empty()) words = fmt::format("[={}]", words);
  if (!is_flag && option->get_option_text().empty()) {
    if (!option->get_default_str().empty()) words += fmt::format(" (default {})", option->get_default_str());
    if (option->get_expected_max() == CLI::detail::expected_max_vector_size) words += " ...";
    if (option->get_required()) words += " REQUIRED";
  }
  if (!option->get_needs().empty())
    words += fmt::format("{}(with {})", words.empty() ? "" : " ", names(option->get_needs()));
  if (!option->get_excludes().empty())
    words += fmt::format("{}(not with {})", words.empty() ? "" : " ", names(option->get_excludes()));
  return words.empty() || words.starts_with("[=") ? words : " " + words;
}

}  // namespace sandstroke
