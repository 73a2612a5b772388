#pragma once

#include <cstddef>
#include <vector>

namespace sandstroke {

/// Numbers from 0 that are joined to sets (union-find with path halving).
class DisjointSets {
 public:
  explicit DisjointSets(std::size_t count = 0) {
    for (std::size_t i = 0; i < count; ++i) add();
  }
  /// Adds the next number, alone in its set.
  void add() { toward_root_.push_back(toward_root_.size()); }
  /// The number that stands for the set of i.
  std::size_t root(std::size_t i) {
    while (toward_root_[i] != i) i = toward_root_[i] = toward_root_[toward_root_[i]];
    return i;
  }
  /// Makes one set of those of i and k.
  void join(std::size_t i, std::size_t k) { toward_root_[root(i)] = root(k); }

 private:
  std::vector<std::size_t> toward_root_;
};

}  // namespace sandstroke
