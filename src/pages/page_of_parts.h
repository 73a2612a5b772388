#pragma once

#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

namespace sandstroke {

/// A page on one run or two: a head and parts. Its data has at least the lists `parts` and `missing`.
struct PageOfParts {
  std::string_view script;  ///< its own, beside those of parts
  std::string title;
  nlohmann::ordered_json data;

  /// Appends what `make` returns, unless that is null. Where `make` finds its data missing or damaged (Error:
  /// input), the page says why `name` is not shown.
  void add_part(const std::string& name, const std::function<nlohmann::ordered_json()>& make);
  std::string html() const;
};

}  // namespace sandstroke
