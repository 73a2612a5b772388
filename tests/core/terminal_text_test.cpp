#include "core/terminal_text.h"

#include <gtest/gtest.h>

#include <utility>

namespace sandstroke {
namespace {

TEST(TerminalText, LettersOfAnyLanguageStay) {
  const std::string text = "sand µm \xC2\xA0 שלום العربية \xEF\xBF\xBD \xF0\x9F\x8F\x96 ~ C:\\x1b\ttab";
  EXPECT_EQ(terminal_text(text), text);
  EXPECT_EQ(terminal_line(text), text);
}

TEST(TerminalText, WhatControlsATerminalIsShown) {
  for (const auto& [text, shown] : std::initializer_list<std::pair<std::string, std::string>>{
           {"a\x1b[2Jz", "a\\x1b[2Jz"},
           {"\x1b]0;title\x07", "\\x1b]0;title\\x07"},
           {std::string("a\0z", 3), "a\\x00z"},
           {"forged\rline\bx\x7F", "forged\\x0dline\\x08x\\x7f"},
           {"\xC2\x9B"
            "2J\xC2\x80\xC2\x9F",
            "\\u009b2J\\u0080\\u009f"},
           {"\xE2\x80\xAE"
            "txt\xE2\x80\xAA\xE2\x81\xA6\xE2\x81\xA9",
            "\\u202etxt\\u202a\\u2066\\u2069"},
           {"\x9B"
            "2J",
            "\\x9b2J"},          // C1 as one byte: no UTF-8
           {"\xC3(", "\\xc3("},  // cut off
           {"\xC0\x9B", "\\xc0\\x9b"},
           {"\xED\xA0\x80", "\\xed\\xa0\\x80"}}) {
    EXPECT_EQ(terminal_text(text), shown);
    EXPECT_EQ(terminal_line(text), shown);
  }
}

TEST(TerminalText, OnlyALineHasNoOtherLines) {
  EXPECT_EQ(terminal_text("two\nlines\n"), "two\nlines\n");
  EXPECT_EQ(terminal_line("two\nlines\n"), "two\\x0alines\\x0a");
}

}  // namespace
}  // namespace sandstroke
