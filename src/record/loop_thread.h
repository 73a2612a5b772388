#pragma once

#include <functional>
#include <future>
#include <optional>
#include <thread>

#include "record/servo_loop.h"

namespace sandstroke {

/// Called over and over in the thread that records, which is not the loop's. It shows how far the loop is,
/// and says whether to stop.
using RecordingWatcher = std::function<std::optional<StopReason>(const ServoProgress&)>;

/// A loop in a real-time thread of its own. The thread is joined, never cancelled. After that the loop is
/// over (where it still ran, for the reason `error`), and has commanded zero force.
class LoopThread {
 public:
  /// Returns when the thread has asked for real time (ask_for_real_time). The loop waits for start().
  LoopThread(ServoLoop& loop, int priority, bool lock_memory);
  ~LoopThread();

  const Scheduling& scheduling() const { return scheduling_; }
  /// After an interrupt the loop ends before its first tick.
  void start();
  /// Waits until the loop is over, or the watcher throws. Calls the watcher every `interval` [s], and once at
  /// the end. Interrupts (core/interrupt.h) stop the loop.
  void watch(const RecordingWatcher& watcher, double interval = 0.1);
  /// Waits for the loop's end. Call it once.
  RecordingFooter footer() { return footer_.get(); }

 private:
  ServoLoop& loop_;
  std::promise<void> go_;
  bool started_ = false;
  std::future<RecordingFooter> footer_;
  Scheduling scheduling_;
  std::thread thread_;
};

}  // namespace sandstroke
