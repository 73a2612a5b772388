#pragma once

#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

#include "core/error.h"

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

/// The result of `make`, or an empty one where the file does not hold it (Error: input).
template <class Make>
auto as_far_as_known(const Make& make) -> decltype(make()) {
  try {
    return make();
  } catch (const Error& error) {
    if (error.kind() != ErrorKind::input) throw;
    return {};
  }
}

}  // namespace sandstroke
