#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "io/key_table.h"

namespace sandstroke {

/// What a page explains: a file that people write, or what files say.
struct HelpTopic {
  const char* name;
  const char* title;  ///< one line
  const char* intro;  ///< a sentence on what is listed
  std::vector<KeySection> (*keys)();
};

/// scene, script, plan and metrics.
const std::vector<HelpTopic>& help_topics();

// Manual pages for man(1), in its language (roff).
std::string command_manual(const CLI::App& app);   ///< sandstroke(1): every command with its options
std::string topic_manual(const HelpTopic& topic);  ///< sandstroke-TOPIC(5)

}  // namespace sandstroke
