#include "core/warning.h"

#include <gtest/gtest.h>

#include <regex>
#include <set>
#include <string>

namespace sandstroke {
namespace {

TEST(Warnings, EachHasAWordOfItsOwnThatScriptsCanTake) {
  std::set<std::string> words;
  for (const WarningKind& kind : warning_kinds) {
    EXPECT_TRUE(words.insert(kind.word).second) << kind.word;
    EXPECT_TRUE(std::regex_match(kind.word, std::regex("[a-z]+(-[a-z]+)*"))) << kind.word;
    EXPECT_NE(std::string(kind.meaning), "") << kind.word;
  }
  EXPECT_EQ(std::string(Warning{WarningCode::not_at_rest, ""}.kind().word), "not-at-rest");
  EXPECT_EQ(std::string(Warning{WarningCode::stroke_import, ""}.kind().word), "stroke-import");
  EXPECT_EQ((Warning{WarningCode::not_at_rest, "It moves"}.line()), "It moves [relaxation: not-at-rest]");
}

TEST(Warnings, ListsKeepThoseThatAreGivenWhileTheyLive) {
  warn({WarningCode::stroke_deep, "before"});
  const WarningList outer;
  {
    const WarningList inner;
    warn({WarningCode::stroke_gaps, "in both"});
    warn_if_any(WarningCode::stroke_gaps, "");
    ASSERT_EQ(inner.warnings().size(), 1u);
  }
  warn_if_any(WarningCode::tool_mesh, "in one");
  ASSERT_EQ(outer.warnings().size(), 2u);
  EXPECT_EQ(outer.warnings()[0].text, "in both");
  EXPECT_EQ(outer.warnings()[1].code, WarningCode::tool_mesh);
}

}  // namespace
}  // namespace sandstroke
