#include "cli/command_tree.h"

namespace sandstroke {
namespace {

void add_tree(const std::string& name, const CLI::App& app, std::vector<NamedCommand>& tree) {
  tree.push_back({name, &app});
  for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; }))
    add_tree(name + (name.empty() ? "" : " ") + command->get_name(), *command, tree);
}

}  // namespace

std::vector<NamedCommand> command_tree(const CLI::App& app) {
  std::vector<NamedCommand> tree;
  add_tree("", app, tree);
  return tree;
}

std::vector<const CLI::Option*> named_options(const CLI::App& app) {
  return app.get_options([](const CLI::Option* option) { return option->nonpositional(); });
}

std::vector<const CLI::Option*> positional_options(const CLI::App& app) {
  return app.get_options([](const CLI::Option* option) { return option->get_positional(); });
}

}  // namespace sandstroke
