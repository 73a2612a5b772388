#include "cli/manual.h"

#include <spdlog/fmt/fmt.h>

#include <sstream>

#include "cli/command_tree.h"
#include "cli/help_formatter.h"
#include "core/version.h"
#include "core/warning.h"
#include "io/scene_keys.h"
#include "io/stroke_script_toml.h"
#include "sweep/metrics.h"
#include "sweep/plan_keys.h"

namespace sandstroke {
namespace {

/// Escapes text for roff: dashes stay dashes, and no line becomes a command.
std::string roff(std::string_view text) {
  std::string out;
  for (const char c : text) {
    const bool line_begins = out.empty() || out.back() == '\n';
    if (line_begins && (c == '.' || c == '\'')) out += "\\&";
    if (c == '\\')
      out += "\\e";
    else if (c == '-')
      out += "\\-";
    else
      out += c;
  }
  return out;
}

std::string bold(std::string_view text) { return fmt::format("\\fB{}\\fR", roff(text)); }

/// Lines that roff prints unchanged.
std::string preformatted(std::string text) {
  while (text.ends_with('\n')) text.pop_back();
  return fmt::format(".nf\n{}\n.fi\n", roff(text));
}

/// Breaks a paragraph into short lines at its words.
std::string filled(const std::string& text) {
  std::istringstream words(text);
  std::string lines, line;
  for (std::string word; words >> word; line += (line.empty() ? "" : " ") + word) {
    if (line.size() + word.size() < 70) continue;
    lines += line + '\n';
    line.clear();
  }
  return roff(lines + line) + '\n';
}

/// A headword and its explanation.
std::string entry(const std::string& head, const std::string& text) {
  return fmt::format(".TP\n{}\n{}", head, filled(text));
}

std::string capitals(std::string text) {
  for (char& c : text) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  return text;
}

std::string head(const std::string& name, int section, const std::string& title) {
  return fmt::format(".TH {} {} \"{}\" \"sandstroke {}\"\n.SH NAME\n{} \\- {}\n", capitals(roff(name)),
                     section, commit_date, version, roff(name), roff(title));
}

std::string page_of(const HelpTopic& topic) { return fmt::format("sandstroke-{}", topic.name); }

/// The help text of each option.
std::string options_text(const CLI::App& app) {
  const HelpFormatter words;
  std::string text;
  for (const CLI::Option* option : positional_options(app))
    text += entry("\\fI" + roff(option->get_name(true)) + "\\fR" + roff(words.make_option_opts(option)),
                  option->get_description());
  for (const CLI::Option* option : named_options(app))
    text += entry(bold(words.make_option_name(option, false)) + roff(words.make_option_opts(option)),
                  option->get_description());
  return text;
}

std::string command_text(const NamedCommand& command) {
  const CLI::App& app = *command.app;
  const std::string name = "sandstroke " + command.name;
  std::string usage = HelpFormatter().make_usage(&app, name);
  usage = usage.substr(usage.find(name) + name.size());
  usage.erase(usage.find_last_not_of('\n') + 1);
  std::string text = fmt::format(".SS {}{}\n{}", bold(name), roff(usage), filled(app.get_description()));
  text += options_text(app);
  if (!app.get_footer().empty()) text += ".PP\n" + preformatted(app.get_footer());
  return text;
}

std::vector<KeySection> warning_keys() {
  KeySection section{
      "", "warnings of sandstroke run: word (\"code\" in --json), section of the scene, meaning", {}};
  for (const WarningKind& kind : warning_kinds)
    section.keys.push_back({kind.word, fmt::format("[{}]", kind.section), "", "", kind.meaning});
  return {section};
}

/// Every key with its default, unit and meaning.
std::string keys_text(const std::vector<KeySection>& sections) {
  std::string text;
  for (const KeySection& section : sections) {
    text += section.name.empty() ? ".PP\n" : fmt::format(".SH {}\n", roff(section.header()));
    text += filled(section.help + ".");
    for (const KeyRow& key : section.keys) {
      const std::string value = key.value.empty() ? "" : " = " + key.value;
      text +=
          entry(bold(key.name) + roff(value + (key.unit.empty() ? "" : " " + key.unit)), key.explanation());
    }
  }
  return text;
}

}  // namespace

const std::vector<HelpTopic>& help_topics() {
  static constexpr const char* keys_with_defaults = "Every key with its default.";
  static const std::vector<HelpTopic> topics = {
      {"scene", "scene for sandstroke run (TOML); --set overrides any of its keys", keys_with_defaults,
       all_scene_keys},
      {"script", "strokes written as text (TOML)", keys_with_defaults, script_keys},
      {"plan", "plan for sandstroke sweep (TOML)", keys_with_defaults, all_plan_keys},
      {"metrics", "metrics of sandstroke sweep", "Every metric with its unit and definition.", metric_keys},
      {"warnings", "warnings of sandstroke run", "Every warning with its word, and the section of the scene.",
       warning_keys},
  };
  return topics;
}

std::string command_manual(const CLI::App& app) {
  std::string text = head("sandstroke", 1, "sand that is sculpted with a haptic device, simulated");
  text += fmt::format(".SH SYNOPSIS\n.B sandstroke\n.I COMMAND\n[\\fIOPTIONS\\fR]\n.SH DESCRIPTION\n{}",
                      filled(app.get_description()));
  text += ".SH OPTIONS\n" + options_text(app) + ".SH COMMANDS\n";
  for (const NamedCommand& command : command_tree(app))
    if (command.app != &app) text += command_text(command);
  text += ".SH EXIT STATUS\n" + preformatted(app.get_footer()) + ".SH SEE ALSO\n";
  for (const HelpTopic& topic : help_topics())
    text += fmt::format(".BR {} (5){}\n", roff(page_of(topic)), &topic == &help_topics().back() ? "" : ",");
  return text;
}

std::string topic_manual(const HelpTopic& topic) {
  return head(page_of(topic), 5, topic.title) + ".SH DESCRIPTION\n" + filled(topic.intro) +
         keys_text(topic.keys()) + ".SH SEE ALSO\n.BR sandstroke (1)\n";
}

}  // namespace sandstroke
