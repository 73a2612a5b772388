#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace sandstroke {

/// Text that would be markup, a script or a format if anything took it for more than text.
inline const std::string hostile =
    "</script><script>document.documentElement.dataset.hacked = 1</script>"
    "<img src=x onerror=\"document.documentElement.dataset.hacked = "
    "1\"><!--'\"&lt;{a|b}{b}%s${1}`]]>javascript:alert(1)\x01\x7f\u2028\u2029\u202e\u00e9\U0001f4a5 ";

/// Every text of the data becomes hostile, in the same way, so that what refers still refers. Names of
/// columns and designs stay.
inline void poison(nlohmann::ordered_json& data, const std::string& key = "") {
  if (data.is_string() && key != "error" && key != "column" && key != "design")
    data = hostile + data.get<std::string>();
  if (data.is_object())
    for (auto& [name, value] : data.items()) poison(value, name);
  if (data.is_array())
    for (nlohmann::ordered_json& value : data) {
      if (key == "columns") {
        value["title"] = hostile;
        value["unit"] = hostile;
      } else {
        poison(value, key);
      }
    }
}

}  // namespace sandstroke
