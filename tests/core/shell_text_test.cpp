#include "core/shell_text.h"

#include <gtest/gtest.h>

#include <array>
#include <cstdio>

namespace sandstroke {
namespace {

/// The word as a shell reads it.
std::string echoed(const std::string& word) {
  FILE* shell = popen(("printf %s " + shell_quoted(word)).c_str(), "r");
  std::array<char, 256> text{};
  const std::size_t length = fread(text.data(), 1, text.size(), shell);
  pclose(shell);
  return {text.data(), length};
}

TEST(ShellText, AShellReadsBackEveryText) {
  for (const std::string text : {"plain", "two words", "it's", "$(rm x) `y` \"z\" \\ ; & | > *", "a\nb",
                                 "\xc3\xa9", "/*", "/?*", "~", "/[a-z]*"})
    EXPECT_EQ(echoed(text), text);
}

TEST(ShellText, QuotesOnlyWhereItMust) {
  EXPECT_EQ(shell_quoted("relaxation.talus_angle=27.5"), "relaxation.talus_angle=27.5");
  EXPECT_EQ(shell_quoted("a b"), "'a b'");
  EXPECT_EQ(shell_quoted(""), "''");
}

}  // namespace
}  // namespace sandstroke
