#include "core/disjoint_sets.h"

#include <gtest/gtest.h>

namespace sandstroke {
namespace {

TEST(DisjointSets, NumbersThatAreJoinedHaveOneRoot) {
  DisjointSets sets(6);
  sets.add();
  sets.join(0, 2);
  sets.join(4, 2);
  sets.join(1, 6);
  const std::size_t set_of[] = {0, 1, 0, 3, 0, 5, 1};
  for (std::size_t i = 0; i < 7; ++i)
    for (std::size_t k = 0; k < 7; ++k) EXPECT_EQ(sets.root(i) == sets.root(k), set_of[i] == set_of[k]);
}

}  // namespace
}  // namespace sandstroke
