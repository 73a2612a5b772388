#pragma once

#include <vector>

#include "sand/height_field.h"
#include "sand/relaxation.h"

namespace sandstroke {

/// The settings of a bed's coarse bed. Its law is isotropic, which needs the least work.
RelaxationSettings on_coarse_bed(const RelaxationSettings& settings);

/// A bed in cells of twice the size, on which sand that must move far gets there in fewer passes: one level
/// of a full approximation scheme (Brandt, Math. Comp. 31, 1977). Its heights are means of 2 x 2 cells. Its
/// cells have a talus slope each, by which it rests exactly where the fine bed would: tan(talus) and what the
/// coarse slope says otherwise than the mean of the fine ones. What changes on it is brought back.
///
/// The fine bed must have no walls. Odd last rows and columns take no part.
class CoarseSand {
 public:
  /// settings: of the fine bed. awake: slots of its tiles whose sand moves; all other sand rests.
  /// fine_factors: talus slopes of its cells over the settings', or null. first: nothing was brought back
  /// yet. The sand is then far from rest, where slopes of two grids tell nothing. All may be steeper by a
  /// tenth instead, so that the coarse bed does not overshoot.
  CoarseSand(const HeightField& fine, const RelaxationSettings& settings, const std::vector<int>& awake,
             const HeightField* fine_factors, bool first);

  /// Its disturbed cells are those that may move at first.
  HeightField& bed() { return bed_; }
  /// The talus slope of each coarse cell over the law's.
  HeightField& talus_factors() { return talus_factors_; }
  /// Whether any coarse cell is steeper than it may be, by more than the law's tolerance.
  bool flows() const { return flows_; }

  /// Adds to the fine heights what changed on the coarse bed since construction, and marks them as disturbed.
  /// Changes are interpolated between coarse cells that changed, so that volume is kept, and a toe gets no
  /// slivers before it. `fine` is the constructor's, as it was.
  void bring_back(HeightField& fine) const;

 private:
  void take_tiles(const HeightField& fine, const std::vector<int>& awake);
  void allow_slopes(const HeightField& fine, const RelaxationSettings& settings,
                    const HeightField* fine_factors, bool first);

  HeightField bed_, talus_factors_;
  int known_tiles_ = 0;  // the first ones of bed_: their talus slopes are known
  bool flows_ = false;
};

}  // namespace sandstroke
