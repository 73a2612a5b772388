#pragma once

#include <thread>

#include "record/journal.h"
#include "record/servo_loop.h"

namespace sandstroke {

/// Carries samples from the ring to the journal, in a thread of its own at normal priority: about 20 times a
/// second, and through to the disk twice a second. Where the disk takes no more it stops the loop (disk) and
/// keeps emptying nothing.
class SampleWriter {
 public:
  SampleWriter(SpscRing<RecordedSample>& ring, JournalWriter& journal, ServoLoop& loop);
  /// Writes what is left; the loop has ended. Error: io, as the journal had it.
  void finish();
  /// Samples that are in the journal; from any thread.
  std::int64_t written() const;
  ~SampleWriter();
};

}  // namespace sandstroke
