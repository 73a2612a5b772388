#include "core/hash.h"

#include <gtest/gtest.h>

namespace sandstroke {
namespace {

TEST(ContentHash, IsFnv1a64) {  // test vectors published with the algorithm (Fowler, Noll, Vo)
  EXPECT_EQ(content_hash(""), "cbf29ce484222325");
  EXPECT_EQ(content_hash("a"), "af63dc4c8601ec8c");
  EXPECT_EQ(content_hash("foobar"), "85944171f73967e8");
  EXPECT_EQ(content_hash("aa"), "089c4307b54596b7");  // by the algorithm's definition: 16 digits, always
}

TEST(UnitHash, IsSplitMix64) {  // the first three numbers of the generator for the seed 0, as published
  constexpr std::uint64_t gamma = 0x9e3779b97f4a7c15ULL;
  EXPECT_EQ(unit_hash(gamma), 0x1p-53 * static_cast<double>(0xe220a8397b1dcdafULL >> 11));
  EXPECT_EQ(unit_hash(2 * gamma), 0x1p-53 * static_cast<double>(0x6e789e6aa1b965f4ULL >> 11));
  EXPECT_EQ(unit_hash(3 * gamma), 0x1p-53 * static_cast<double>(0x06c45d188009454fULL >> 11));
}

}  // namespace
}  // namespace sandstroke
