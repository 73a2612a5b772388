#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "io/key_table.h"

namespace sandstroke {

/// The topic of a manual page: a kind of file that people write, the metrics, or the warnings.
struct HelpTopic {
  const char* name;
  const char* title;  ///< one line
  const char* intro;  ///< a sentence about the list
  std::vector<KeySection> (*keys)();
};

/// scene, script, plan, metrics and warnings.
const std::vector<HelpTopic>& help_topics();

// Manual pages for man(1), in its language (roff).
std::string command_manual(const CLI::App& app);   ///< sandstroke(1): every command with its options
std::string topic_manual(const HelpTopic& topic);  ///< sandstroke-TOPIC(5)

}  // namespace sandstroke
