#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "core/key_visitor.h"

namespace sandstroke {

/// One key of a file that people write, for lists of its keys.
struct KeyRow {
  std::string name;   ///< dotted, as --set takes it
  std::string value;  ///< as TOML text; empty: no default
  std::string unit;   ///< empty: none
  std::string range;  ///< in words; empty: any number, or no number
  std::string help;
  bool required = false;
  std::vector<std::string> choices = {};  ///< its possible values; empty: not one of a few names
  std::vector<std::string> presets = {};  ///< "accurate: 240.0": its value with a preset
  std::string condition = {};  ///< "bed.surface.kind is noise or ripples": where it applies; empty: always

  /// The name within its section.
  std::string key() const { return name.substr(name.rfind('.') + 1); }
  /// A sentence with its help, its possible values, its values with presets, and where it applies.
  std::string explanation() const;
};

struct KeySection {
  std::string name, help;  ///< no name: at the file's top
  std::vector<KeyRow> keys;
  bool in_list = false;  ///< one table of a list; its place ends the name: "stone.1"

  /// The line above its keys: [tool], [[stone]].
  std::string header() const;
};

/// Shows every key to the visitor.
using ShowKeys = std::function<void(KeyVisitor&)>;

/// The keys that are shown, with their values.
std::vector<KeySection> listed_keys(const ShowKeys& show);

/// Every key that can be shown, with its default. Keys that only go with a choice (the radius of a cone) are
/// listed with that choice. `show` must start from the defaults each time.
std::vector<KeySection> all_keys(const ShowKeys& show);

/// Where those keys apply that do not always apply, by their names.
std::map<std::string, std::string> conditions(const std::vector<KeySection>& sections);

/// The keys as aligned lines: key, default, unit, meaning (for help pages).
std::string key_table(const std::vector<KeySection>& sections);

}  // namespace sandstroke
