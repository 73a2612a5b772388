#include "report/data_uri.h"

#include <gtest/gtest.h>

namespace sandstroke {
namespace {

TEST(Base64, GivesTheVectorsOfRfc4648) {
  const std::string text = "foobar";
  const std::vector<std::string> expected{"", "Zg==", "Zm8=", "Zm9v", "Zm9vYg==", "Zm9vYmE=", "Zm9vYmFy"};
  for (std::size_t size = 0; size < expected.size(); ++size)
    EXPECT_EQ(base64(text.substr(0, size)), expected[size]);
}

TEST(Base64, TakesAnyByte) {
  EXPECT_EQ(base64(std::string("\x00\xff\xfe", 3)), "AP/+");
  EXPECT_EQ(base64("\xfb\xff"), "+/8=");
}

TEST(DataUri, NamesItsType) { EXPECT_EQ(data_uri("image/png", "foo"), "data:image/png;base64,Zm9v"); }

}  // namespace
}  // namespace sandstroke
