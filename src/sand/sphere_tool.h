#pragma once

#include "sand/footprint_kernels.h"
#include "sand/tool.h"

namespace sandstroke {

/// The paper's tool: a sphere, or its sine profile, whose bowl and ring are the filters of rules/filter.h.
class SphereTool : public Tool {
 public:
  explicit SphereTool(const ToolSettings& settings);
  std::unique_ptr<Tool> copy() const override { return std::make_unique<SphereTool>(*this); }

  /// Sets sand_level() to the mean height of the sand under the footprint. Cells with u <= u1 count in full;
  /// the weight fades out within a cell around them, so that the level changes continuously as the tool
  /// moves. Displacement moves sand only where the weight is 1, so it does not change the level.
  void place(const HeightField& bed, double x, double y) override;
  /// Looks at the cells within one cell outside the rim; -infinity if there are none.
  double sand_above_rim(const HeightField& bed, double tip_height) override;

 private:
  double displace_in_footprint(const HeightField& bed, double tip_height, const Eigen::Vector3d& motion,
                               const DisplacementSettings& settings) override;
  void carve_only(double tip_height) override;
  double floor_above(double height) const override;
  void cover() override;

  SphereShape shape_;
};

}  // namespace sandstroke
