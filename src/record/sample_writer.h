#pragma once

#include <exception>
#include <thread>

#include "record/journal.h"
#include "record/servo_loop.h"

namespace sandstroke {

/// Carries samples from the ring to the journal in a thread of its own, about 20 times a second, and puts
/// them on the disk twice a second. Where the disk takes no more, it stops the loop (reason `disk`) and
/// carries no more.
class SampleWriter {
 public:
  /// Construct it in a thread of normal priority: its own thread gets the same.
  SampleWriter(SpscRing<RecordedSample>& ring, JournalWriter& journal, ServoLoop& loop);
  SampleWriter(const SampleWriter&) = delete;
  /// Writes what is left, after the loop has ended. Error: io, as the journal threw it.
  void finish();

 private:
  void run(const std::stop_token& stop) noexcept;
  void empty_ring();

  SpscRing<RecordedSample>& ring_;
  JournalWriter& journal_;
  ServoLoop& loop_;
  std::exception_ptr failure_;  // only the thread uses it while it runs
  std::jthread thread_;
};

}  // namespace sandstroke
