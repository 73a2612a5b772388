#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

namespace sandstroke {

/// Something that a page explains, though it is no command.
struct HelpTopic {
  const char* name;
  const char* title;      ///< one line
  std::string (*text)();  ///< all of it, in lines as they are to be read
};

/// scene, script and plan: the files that people write.
const std::vector<HelpTopic>& help_topics();

// Manual pages for man(1), in its language (roff).
std::string command_manual(const CLI::App& app);   ///< sandstroke(1): every command with its options
std::string topic_manual(const HelpTopic& topic);  ///< sandstroke-TOPIC(5)

}  // namespace sandstroke
