#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "sand/height_field.h"

namespace sandstroke {

/// Checks that plugin laws neither make nor lose sand.
class SandWatch {
 public:
  /// bed: before such a law touches it.
  explicit SandWatch(const HeightField& bed);
  /// Call this after `law` (in words) changed the bed. given: sand that the bed has got otherwise since the
  /// constructor [m^3]. Looks at the tiles whose revision has changed. Error: unstable, naming the law: if a
  /// height is not a number, or if there is more or less sand than at first and given, by more than 1e-9 of
  /// what lies above and below z = 0 and was given.
  void check(const HeightField& bed, const std::string& law, double given = 0.0);

 private:
  struct TileSum {
    int tile = -1;
    std::uint64_t revision = 0;
    double gained = 0.0, sand = 0.0;  // m, sums of h less the rule's height, and of |h|
  };
  /// The sum of heights that the tiles have beyond the rule's [m]; updates sums_.
  double gained(const HeightField& bed);

  HeightField untouched_;      // keeps the rule
  std::vector<TileSum> sums_;  // by slot
  bool replaced_ = false;
  double at_first_;  // m, gained()
};

}  // namespace sandstroke
