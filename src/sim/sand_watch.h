#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "sand/height_field.h"

namespace sandstroke {

/// Sees that laws which are not this library's neither make sand nor lose it.
class SandWatch {
 public:
  /// Of a bed before such a law touches it.
  explicit SandWatch(const HeightField& bed);
  /// After `law` (in words) changed it; looks at the tiles whose revision is another one than last time.
  /// Error: unstable, naming the law: where a height is not a number, or there is more or less sand than at
  /// first, by more than 1e-9 of what lies above and below z = 0.
  void check(const HeightField& bed, const std::string& law);

 private:
  struct TileSum {
    int tile = -1;
    std::uint64_t revision = 0;
    double gained = 0.0, sand = 0.0;  // m, sums of h - what the rule says, and of |h|
  };
  /// What tiles have more than the rule says [m], in sums_.
  double gained(const HeightField& bed);

  HeightField untouched_;      // keeps the rule
  std::vector<TileSum> sums_;  // by slot
  bool replaced_ = false;
  double at_first_;  // m, gained()
};

}  // namespace sandstroke
