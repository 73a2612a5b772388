#include "record/sample_writer.h"

#include <chrono>
#include <vector>

#include "record/stoppable_sleep.h"

namespace sandstroke {
namespace {

constexpr std::chrono::milliseconds turn(50);
constexpr int turns_per_sync = 10;
constexpr std::size_t block_samples = 1024;

}  // namespace

SampleWriter::SampleWriter(SpscRing<RecordedSample>& ring, JournalWriter& journal, ServoLoop& loop)
    : ring_(ring),
      journal_(journal),
      loop_(loop),
      thread_([this](const std::stop_token& stop) { run(stop); }) {}

void SampleWriter::run(const std::stop_token& stop) noexcept {
  try {
    for (int turns = 1; sleep_unless_stopped(stop, turn); ++turns) {
      empty_ring();
      if (turns % turns_per_sync == 0) journal_.sync();
    }
    empty_ring();
  } catch (...) {
    failure_ = std::current_exception();
    loop_.stop(StopReason::disk);
  }
}

void SampleWriter::empty_ring() {
  std::vector<RecordedSample> block;
  do {
    block.clear();
    for (RecordedSample sample; block.size() < block_samples && ring_.pop(sample);) block.push_back(sample);
    journal_.append(block);
  } while (block.size() == block_samples);
}

void SampleWriter::finish() {
  thread_.request_stop();
  if (thread_.joinable()) thread_.join();
  if (failure_) std::rethrow_exception(failure_);
}

}  // namespace sandstroke
