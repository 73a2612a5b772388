#pragma once

#include <string>

#include "sand/height_field.h"

namespace sandstroke {

/// Sees that laws which are not this library's neither make sand nor lose it.
class SandWatch {
 public:
  /// Of a bed before such a law touches it.
  explicit SandWatch(const HeightField& bed) : volume_(bed.volume()) {}
  /// After `law` (in words) changed it. Error: unstable, naming the law: where a height is not a number, or
  /// the volume is another one than at first, by more than 1e-9 of what lies above and below z = 0.
  void check(const HeightField& bed, const std::string& law) const;

 private:
  double volume_;  // m^3
};

}  // namespace sandstroke
