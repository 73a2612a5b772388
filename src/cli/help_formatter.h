#pragma once

#include <CLI/CLI.hpp>
#include <string>

namespace sandstroke {

/// Writes help in a reader's words: "NUMBER >= 0", "0 to 90", "(default 1)". CLI11 would print names of C++
/// types.
class HelpFormatter : public CLI::Formatter {
 public:
  std::string make_option_name(const CLI::Option* option, bool is_positional) const override;
  std::string make_option_opts(const CLI::Option* option) const override;
};

}  // namespace sandstroke
