#include "report/page.h"

#include <gtest/gtest.h>

namespace sandstroke {
namespace {

TEST(Page, HoldsAllItNeedsAndNothingFromAnywhereElse) {
  const std::string page = html_page("Sand & stress", {}, {{"key", "value"}});
  EXPECT_EQ(page.find("<script src"), std::string::npos);
  EXPECT_EQ(page.find("<link"), std::string::npos);
  EXPECT_NE(page.find("<title>Sand &amp; stress</title>"), std::string::npos);
}

TEST(Page, HoldsTheLicenceAndTheNoticeOfTheChartLibraryInAComment) {
  const std::string page = html_page("t", {}, {});
  const std::size_t begin = page.find("<!--"), end = page.find("-->", begin);
  ASSERT_NE(end, std::string::npos);
  const std::string comment = page.substr(begin, end - begin);
  EXPECT_NE(comment.find("Apache License\n"), std::string::npos);
  EXPECT_NE(comment.find("END OF TERMS AND CONDITIONS"), std::string::npos);
  EXPECT_NE(comment.find("This product includes software developed at"), std::string::npos);
}

TEST(Page, DataCannotEndItsScriptElement) {
  const std::string page = html_page("t", {}, {{"name", "</script><script>alert(1)</script>"}});
  EXPECT_EQ(page.find("<script>alert(1)"), std::string::npos);
  EXPECT_NE(page.find("\\u003c/script>"), std::string::npos);
}

}  // namespace
}  // namespace sandstroke
