#include <spdlog/fmt/fmt.h>

#include <memory>

#include "cli/command_tree.h"
#include "cli/commands.h"
#include "cli/help_formatter.h"
#include "cli/manual.h"
#include "cli/standard_output.h"
#include "core/error.h"

namespace sandstroke {
namespace {

struct HelpArguments {
  std::vector<std::string> words;
  bool man = false;
};

const HelpTopic* topic_named(const std::string& name) {
  for (const HelpTopic& topic : help_topics())
    if (topic.name == name) return &topic;
  return nullptr;
}

std::vector<std::string> topic_names() {
  std::vector<std::string> names;
  for (const HelpTopic& topic : help_topics()) names.push_back(topic.name);
  return names;
}

std::string help(const CLI::App& app, const HelpArguments& arguments) {
  const std::string asked = fmt::format("{}", fmt::join(arguments.words, " "));
  if (const HelpTopic* topic = topic_named(asked))
    return arguments.man ? topic_manual(*topic) : key_table(topic->keys());
  if (arguments.man && asked.empty()) return command_manual(app);
  if (!arguments.man)
    for (const NamedCommand& command : command_tree(app))
      if (command.name == asked)
        return HelpFormatter().make_help(command.app, "sandstroke" + (asked.empty() ? "" : " " + asked),
                                         CLI::AppFormatMode::Normal) +
               "\n";
  throw_input_error("help {}: unknown topic; take {}{}", asked, fmt::join(topic_names(), ", "),
                    arguments.man ? ", or nothing for the commands" : " or a command (sandstroke --help)");
}

}  // namespace

void add_help_command(CLI::App& app, Command& chosen) {
  CLI::App* command = app.add_subcommand(
      "help", "Explain a command, the keys of a scene, script or plan, or a sweep's metrics");
  auto arguments = std::make_shared<HelpArguments>();
  std::vector<std::string> names = topic_names();
  const std::string topics = fmt::format("{}", fmt::join(names, ", "));
  for (const NamedCommand& other : command_tree(app))
    if (other.app->get_parent() == &app && other.app != command) names.push_back(other.name);
  std::string footer;
  for (const HelpTopic& topic : help_topics())
    footer += fmt::format("  sandstroke help {:<10} {}\n", topic.name, topic.title);
  command
      ->add_option("TOPIC", arguments->words,
                   fmt::format("A command, or one of {}. Default: all commands", topics))
      ->type_name("{" + fmt::format("{}", fmt::join(names, ",")) + "}")
      ->option_text("...");
  command->add_flag("--man", arguments->man, "Print a manual page (for man)");
  command->footer(footer);
  command->callback([&app, arguments, &chosen] {
    chosen = [&app, arguments] {
      print_text("{}", help(app, *arguments));
      return 0;
    };
  });
}

}  // namespace sandstroke
