#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "core/key_visitor.h"

namespace sandstroke {

/// One key of a file that people write, as the list of its keys tells of it.
struct KeyRow {
  std::string name;   ///< dotted, as --set takes it
  std::string value;  ///< as TOML text; empty: no default
  std::string unit;   ///< empty: none
  std::string range;  ///< in words; empty: any number, or no number
  std::string help;
  bool required = false;
  std::vector<std::string> choices = {};  ///< what it can be; empty: not one of a few names
  std::vector<std::string> presets = {};  ///< "accurate: 240.0": what a preset makes of it
  std::string condition = {};  ///< "bed.surface.kind is noise or ripples": where it applies; empty: always

  /// The name within its section.
  std::string key() const { return name.substr(name.rfind('.') + 1); }
  /// In a sentence: its help, what it can be, what presets make of it, and where it applies.
  std::string explanation() const;
};

struct KeySection {
  std::string name, help;  ///< no name: at the file's top
  std::vector<KeyRow> keys;
};

/// Shows every key to the visitor.
using ShowKeys = std::function<void(KeyVisitor&)>;

/// The keys that are shown, with their values.
std::vector<KeySection> listed_keys(const ShowKeys& show);

/// Every key that can be shown, with its default: also those that only go with a choice (the radius of a
/// cone), and with which. `show` must start from the defaults each time.
std::vector<KeySection> all_keys(const ShowKeys& show);

/// Where those keys apply that not always do, by their names.
std::map<std::string, std::string> conditions(const std::vector<KeySection>& sections);

/// As aligned lines: key, default, unit, meaning (for help pages).
std::string key_table(const std::vector<KeySection>& sections);

}  // namespace sandstroke
