#include "cli/usage_sentence.h"

#include <spdlog/fmt/fmt.h>

#include <set>

#include "cli/command_tree.h"
#include "core/nearest_name.h"

namespace sandstroke {
namespace {

/// The called command, found from those of its words that are commands.
NamedCommand called_command(const CLI::App& app) {
  NamedCommand called{"", &app};
  while (!called.app->get_subcommands().empty()) {
    called.app = called.app->get_subcommands().back();
    called.name += (called.name.empty() ? "" : " ") + called.app->get_name();
  }
  return called;
}

/// The first word that no command or option takes. Empty: none.
std::string left_over(const CLI::App& app) {
  for (const std::string& word : app.remaining())
    if (word != "--") return word;
  return "";
}

std::set<std::string> names_of_commands(const CLI::App& app) {
  std::set<std::string> names;
  for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; }))
    names.insert(command->get_name());
  return names;
}

/// The long names of a command's options without dashes, and those of the program, which every command takes.
std::set<std::string> names_of_options(const CLI::App& app, const CLI::App& command) {
  std::set<std::string> names;
  for (const CLI::App* taker : {&app, &command})
    for (const CLI::Option* option : named_options(*taker))
      names.insert(option->get_lnames().begin(), option->get_lnames().end());
  return names;
}

}  // namespace

std::string usage_sentence(const CLI::App& app, const CLI::ParseError& failure) {
  const NamedCommand called = called_command(app);
  const std::string caller = called.name.empty() ? "sandstroke" : "sandstroke " + called.name;
  const std::string& taker = called.name.empty() ? caller : called.name;
  const std::string more = fmt::format("; see: {} --help", caller);
  const bool awaits_command = called.app->get_require_subcommand_min() > 0;
  const std::string word = left_over(app);

  if (awaits_command && !word.empty() && !word.starts_with("-")) {
    const std::string meant = nearest_name(word, names_of_commands(*called.app));
    return fmt::format("{} is not a command{}{}", word, called.name.empty() ? "" : " of " + called.name,
                       meant.empty() ? more : fmt::format("; did you mean {}?", meant));
  }
  if (failure.get_exit_code() == 0) return "";
  if (word.starts_with("-")) {
    const std::string option = word.substr(0, word.find('='));
    const std::string meant =
        option.starts_with("--") ? nearest_name(option.substr(2), names_of_options(app, *called.app)) : "";
    return fmt::format("{} is not an option of {}{}", option, taker,
                       meant.empty() ? more : fmt::format("; did you mean --{}?", meant));
  }
  if (!word.empty()) return fmt::format("{}: {} takes no more arguments{}", word, taker, more);
  return (awaits_command ? "a command is missing" : failure.what()) + more;
}

}  // namespace sandstroke
