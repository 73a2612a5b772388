#pragma once

#include "sand/relaxation.h"

namespace sandstroke {

/// Relaxes by passes over all cells of a bed, until no cell gives or the flow that is left is below rounding.
/// A law of your own derives from it and says what one pass does.
class WholeBedRelaxer : public Relaxer {
 public:
  explicit WholeBedRelaxer(std::int64_t max_passes) : max_passes_(max_passes) {}

  RelaxationOutcome relax(HeightField& bed, const PassWatcher& after_pass) override;

 protected:
  /// One pass from the old heights [m] to the new. Adds the heights that cells give to `moved`. Walls neither
  /// give nor take.
  virtual TalusPass pass(const HeightGrid& heights, const WallGrid& walls, CompensatedSum& moved) const = 0;

 private:
  std::int64_t max_passes_;
};

}  // namespace sandstroke
