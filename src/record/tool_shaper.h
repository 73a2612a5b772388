#pragma once

#include <atomic>
#include <exception>
#include <memory>
#include <thread>

#include "sim/sand_side.h"

namespace sandstroke {

/// Makes the footprints of a tool that a hand turns. One takes 10 to 400 ms with cells of 1 to 2 mm, and
/// seconds with 0.5 mm (ToolEnvelope). So a thread of its own makes them, and the servo loop takes the
/// newest: the footprint is turned as the hand was that long ago.
class ToolShaper {
 public:
  /// distance: DisplacementSettings::distance. The tool must be no sphere.
  ToolShaper(const ToolSettings& tool, double distance, double cell_size);
  ~ToolShaper() { stop(); }

  void start();
  void stop();
  /// Makes the footprint that was asked for. Called by that thread, or, where none runs, by the caller.
  /// False: failed.
  bool work() noexcept;
  /// The last failure of work() that was no Error: memory, most likely. Call it after stop().
  const std::exception_ptr& failure() const { return failure_; }

  /// For the servo loop: the hand holds the tool like this now. Takes neither time nor memory. True:
  /// the sand has a newer tool, turned by rotation(). A tool that is too thin for the cells in this
  /// orientation keeps its footprint.
  bool follow(const Eigen::Matrix3d& rotation, SandSide& sand) noexcept;
  const Eigen::Matrix3d& rotation() const { return rotation_; }

 private:
  enum State { idle, asked, made };  // who uses spare_ and asked_: the loop, the thread, the loop

  ToolSettings settings_;
  double distance_, cell_size_;
  std::unique_ptr<Tool> spare_;
  Eigen::Matrix3d rotation_, asked_;
  std::exception_ptr failure_;  // only the thread uses it while it runs
  std::atomic<State> state_{idle};
  std::atomic<bool> stopping_{true};
  std::thread thread_;
};

}  // namespace sandstroke
