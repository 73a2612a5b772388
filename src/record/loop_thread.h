#pragma once

#include <functional>
#include <future>
#include <optional>
#include <thread>

#include "record/servo_loop.h"

namespace sandstroke {

/// Called over and over in the thread that records, which is not the loop's: to show where it is,
/// and to ask whether to stop.
using RecordingWatcher = std::function<std::optional<StopReason>(const ServoProgress&)>;

/// A loop in a real-time thread of its own, which is joined, never cancelled: by its end the loop is over
/// (where it was not, for the reason `error`), and has commanded zero force.
class LoopThread {
 public:
  /// The thread has asked for real time (ask_for_real_time) when this returns; the loop waits for start().
  LoopThread(ServoLoop& loop, int priority, bool lock_memory);
  ~LoopThread();

  const Scheduling& scheduling() const { return scheduling_; }
  /// After an interrupt the loop ends before its first tick.
  void start();
  /// Until the loop is over, or the watcher throws, which is called every `interval` [s], and once when all
  /// is over. Interrupts (core/interrupt.h) stop the loop.
  void watch(const RecordingWatcher& watcher, double interval = 0.1);
  /// Waits for the loop's end. Once.
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
