#include "cli/plugin_options.h"

#include <algorithm>

#include "core/error.h"
#include "io/plugin_file.h"
#include "validation/study/plugin_contenders.h"

namespace sandstroke {

void PluginOptions::add_to(CLI::App& command, const std::string& help) {
  command.add_option("--plugin", file, help)->type_name("FILE");
  command.add_option("--law", names, "Only this law of the plugin (repeatable)")->allow_extra_args(false);
  command
      .add_option("--parameters", parameters,
                  "Up to 4 numbers for the plugin's laws (model.parameters), such as 0.25,500")
      ->delimiter(',')
      ->expected(1, static_cast<int>(PluginLawSettings{}.parameters.size()));
}

std::vector<PluginLawSettings> PluginOptions::laws() const {
  if (file.empty() && !(names.empty() && parameters.empty()))
    throw_input_error("--law and --parameters need a plugin; add --plugin FILE.so");
  if (file.empty()) return {};
  PluginLawSettings plugin;
  plugin.plugin = file.string();
  std::copy(parameters.begin(), parameters.end(), plugin.parameters.begin());
  plugin.laws = load_plugin(file);
  return single_laws(plugin, names);
}

}  // namespace sandstroke
