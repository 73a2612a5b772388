#include "core/hash.h"

#include <gtest/gtest.h>

namespace sandstroke {
namespace {

TEST(ContentHash, IsFnv1a64) {  // test vectors published with the algorithm (Fowler, Noll, Vo)
  EXPECT_EQ(content_hash(""), "cbf29ce484222325");
  EXPECT_EQ(content_hash("a"), "af63dc4c8601ec8c");
  EXPECT_EQ(content_hash("foobar"), "85944171f73967e8");
}

}  // namespace
}  // namespace sandstroke
