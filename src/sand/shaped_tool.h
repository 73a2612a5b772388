#pragma once

#include <optional>

#include "sand/footprint_kernels.h"
#include "sand/tool.h"
#include "tool/tool_envelope.h"

namespace sandstroke {

/// Any tool but the sphere, by its envelope. It deposits outward only. Its level is the height, at the axis,
/// of the plane around it. It may touch a heap beside that level. It covers cells only from its lowest point
/// up to twice its depth, or up to its highest contact if that is higher. A high overhang covers none. One
/// that carries sand lifts what lies above its upper side.
class ShapedTool : public Tool {
 public:
  explicit ShapedTool(const ToolSettings& settings);
  std::unique_ptr<Tool> copy() const override { return std::make_unique<ShapedTool>(*this); }

  double lowest() const override { return envelope_ ? envelope_->lowest() : 0.0; }
  /// Distance of the farthest point from the tip [m].
  double farthest() const { return farthest_; }
  bool would_turn(const Eigen::Matrix3d& rotation) const override;
  void turn(const Eigen::Matrix3d& rotation) override;
  void place(const HeightField& bed, double x, double y) override;
  void visit_state(StateVisitor& state, const HeightField& bed, const Eigen::Vector3d& tip) override;
  bool may_touch_heaps() const override { return true; }
  bool touches() const override { return touches_; }
  void stand(double tip_height) override;
  const UpperSide* upper_side() const override { return upper_ ? &*upper_ : nullptr; }
  /// Computes all ways out of the tool as it is turned and placed.
  void prepare(double distance) override;

 private:
  double displace_in_footprint(const HeightField& bed, double tip_height, const Eigen::Vector3d& motion,
                               const DisplacementSettings& settings) override;
  void carve_only(double tip_height) override { carve(tip_height); }
  /// Over the window, which is the tool's bounding rectangle.
  double floor_above(double height) const override;
  void cover() override;
  /// Returns the sum of heights taken out [m].
  double carve(double tip_height);
  /// Leaves to lifted() what was carved above the upper side; returns the rest of the sum [m].
  double lift(double tip_height);

  /// Finds the sample at the window's first cell (row, column), counted from the envelope's first, and the
  /// remaining distance to it.
  void find_first_sample();
  EnvelopeWindow envelope_window() const;
  /// The ways of the sand from the covered cells, to (distance - 1) inradii beyond the edge.
  WayOutWindow way_out(double distance);
  double covered_height(double tip_height, double touched) const;

  TriangleMesh surface_;
  Eigen::Matrix3d own_rotation_, rotation_;
  double farthest_ = 0.0;  // m
  std::optional<ToolEnvelope> envelope_;
  bool carries_;
  std::optional<UpperSide> upper_;
  int sample_row_ = 0, sample_col_ = 0;
  double sample_y_ = 0.0, sample_x_ = 0.0;
  bool touches_ = false;
  double covered_ = 0.0;  // m above the tip: parts of the tool up to here cover cells
};

}  // namespace sandstroke
