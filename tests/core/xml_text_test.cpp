#include "core/xml_text.h"

#include <gtest/gtest.h>

namespace sandstroke {
namespace {

TEST(XmlText, MarkupAndSpacesBecomeReferences) {
  EXPECT_EQ(xml_escaped("<a b=\"c\" d='e'>&\n\t"), "&lt;a b=&quot;c&quot; d=&apos;e&apos;&gt;&amp;&#10;&#9;");
}

TEST(XmlText, CharactersOfUtf8Stay) {
  const std::string text =
      "sand µm \xC2\x80 \xE0\xA0\x80 \xEF\xBF\xBD \xF0\x90\x80\x80 \xF4\x8F\xBF\xBF ~\x7F";
  EXPECT_EQ(xml_escaped(text), text);
}

TEST(XmlText, WhatXmlCannotCarryIsReplacedByteByByte) {
  for (const auto& [text, escaped] : std::initializer_list<std::pair<std::string, std::string>>{
           {"a\x01z", "a?z"},  // control character
           {std::string("a\0z", 3), "a?z"},
           {"a\xFFz", "a?z"},  // in no UTF-8
           {"a\x80z", "a?z"},  // a character's second byte without its first
           {"a\xC3", "a?"},    // cut off
           {"a\xC3z", "a?z"},
           {"\xE2\x82<", "??&lt;"},
           {"\xC0\xBC", "??"},  // '<', overlong
           {"\xC1\xBF", "??"},  // U+007F, the largest that is overlong in two bytes
           {"\xE0\x80\xBC", "???"},
           {"\xE0\x9F\xBF", "???"},       // U+07FF
           {"\xF0\x8F\xBF\xBD", "????"},  // U+FFFD
           {"\xED\xA0\x80", "???"},       // surrogate
           {"\xEF\xBF\xBF", "???"},       // no character
           {"\xF4\x90\x80\x80", "????"},  // beyond all
           {"\xF8\x88\x80\x80\x80", "?????"}})
    EXPECT_EQ(xml_escaped(text), escaped) << text;
}

}  // namespace
}  // namespace sandstroke
