#pragma once

#include <atomic>
#include <exception>
#include <thread>

#include "sand/tool_footprint.h"

namespace sandstroke {

/// The footprints of a tool that a hand turns. To make one takes 10 to 400 ms with cells of 1 to 2 mm, and
/// seconds with 0.5 mm (ToolEnvelope), so a thread of its own makes them, and the servo loop takes the
/// newest: what digs is turned as the hand was that long ago.
class ToolShaper {
 public:
  /// distance: DisplacementSettings::distance. The tool is no sphere.
  ToolShaper(const ToolSettings& tool, double distance, double cell_size);
  ~ToolShaper() { stop(); }

  void start();
  void stop();
  /// By that thread, or, where none runs, by the caller: makes what was asked for. False: it could not.
  bool work() noexcept;
  /// What kept it from that last, if it was no Error: memory, most likely. After stop().
  const std::exception_ptr& failure() const { return failure_; }

  /// In the servo loop: the hand holds the tool like this now. Takes neither time nor memory. True: a newer
  /// footprint is in `footprint`, turned by rotation(). What is too thin for the cells when it is turned like
  /// this stays as it was.
  bool follow(const Eigen::Matrix3d& rotation, ToolFootprint& footprint) noexcept;
  const Eigen::Matrix3d& rotation() const { return rotation_; }

 private:
  enum State { idle, asked, made };  // of spare_ and asked_: the loop's, the thread's, the loop's

  ToolSettings tool_;
  double distance_, cell_size_;
  ToolFootprint spare_;
  Eigen::Matrix3d rotation_, asked_;
  std::exception_ptr failure_;  // the thread's while it runs
  std::atomic<State> state_{idle};
  std::atomic<bool> stopping_{true};
  std::thread thread_;
};

}  // namespace sandstroke
