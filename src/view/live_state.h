#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <limits>
#include <memory>
#include <mutex>
#include <string>

#include "tool/triangle_mesh.h"

namespace sandstroke {

/// The state that a page shows beside the sand.
struct ViewState {
  double time = 0.0;                                                ///< s
  Eigen::Vector3d tip = Eigen::Vector3d::Zero();                    ///< m, in the bed
  Eigen::Vector3d force = Eigen::Vector3d::Zero();                  ///< N, on the bed's axes
  Eigen::Quaterniond orientation = Eigen::Quaterniond::Identity();  ///< relative to tool.orientation
  double depth = std::numeric_limits<double>::quiet_NaN();          ///< m, of the tip in the sand; NaN: none
  double rate = 0.0;                                                ///< Hz, reached
  double lateness = 0.0, max_lateness = 0.0;                        ///< s
  bool tip_known = false;
  bool force_withheld = false;  ///< until the tool has been above the sand
  /// The sand on the tool, on the bed's axes with the tip at the origin; null: none. Another mesh where it
  /// has changed.
  std::shared_ptr<const TriangleMesh> load = nullptr;
};

/// The newest state, from the one who knows it to those who show it. It locks, so the servo loop must not use
/// it.
class LiveState {
 public:
  void publish(const ViewState& state) {
    const std::lock_guard lock(mutex_);
    state_ = state;
    ++version_;
  }
  /// A sentence for people; empty: nothing to say.
  void say(std::string status) {
    const std::lock_guard lock(mutex_);
    status_ = std::move(status);
  }
  /// Gives the state and its version. False: it is not newer than `version`.
  bool take_newer(std::uint64_t& version, ViewState& state) const {
    const std::lock_guard lock(mutex_);
    const bool newer = version != version_;
    version = version_;
    state = state_;
    return newer;
  }
  std::string status() const {
    const std::lock_guard lock(mutex_);
    return status_;
  }

 private:
  mutable std::mutex mutex_;
  ViewState state_;
  std::uint64_t version_ = 1;
  std::string status_;
};

}  // namespace sandstroke
