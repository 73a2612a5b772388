#pragma once

#include <Eigen/Core>
#include <optional>

namespace sandstroke {

/// When sand is to slip by the way that a tool has gone through it: as it touches down, each time it is some
/// way [m] along the bed, or up or down, from where sand slipped last, and as it leaves. So a stroke's
/// outcome depends neither on its speed nor on how often it is sampled. A tool that trembles within that way
/// asks for nothing.
class SlipSchedule {
 public:
  /// by_way: false = never.
  explicit SlipSchedule(bool by_way) : by_way_(by_way) {}

  /// With the tip here [m], in contact or not.
  bool is_due(const Eigen::Vector3d& tip, bool contact) const;
  /// Which share of a straight step of the tip, below 1, leads to where the next slip is due, by its way
  /// along the bed; none where none is. (Straight down there is nothing to wait for on the way.)
  std::optional<double> way_to_next(const Eigen::Vector3d& from, const Eigen::Vector3d& step) const;
  /// Sand slips with the tip here [m]; again when it has gone `next` [m].
  void slips(const Eigen::Vector3d& tip, bool contact, double next) {
    slipped_at_ = contact ? std::optional(tip) : std::nullopt;
    next_ = next;
  }

 private:
  bool by_way_;
  double next_ = 0.0;                          // m
  std::optional<Eigen::Vector3d> slipped_at_;  // none: the tool was not in contact
};

}  // namespace sandstroke
