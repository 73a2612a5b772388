#include "record/sample_writer.h"

#include <chrono>
#include <vector>

namespace sandstroke {
namespace {

constexpr std::chrono::milliseconds turn(50);
constexpr int turns_per_sync = 10;
constexpr std::size_t block_samples = 1024;

}  // namespace

SampleWriter::SampleWriter(SpscRing<RecordedSample>& ring, JournalWriter& journal, ServoLoop& loop)
    : ring_(ring), journal_(journal), loop_(loop), thread_([this] { run(); }) {}

void SampleWriter::run() noexcept {
  try {
    for (int turns = 1; wait(); ++turns) {
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

bool SampleWriter::wait() {
  std::unique_lock lock(mutex_);
  return !ending_.wait_for(lock, turn, [this] { return ended_; });
}

void SampleWriter::end() {
  if (!thread_.joinable()) return;
  {
    const std::lock_guard lock(mutex_);
    ended_ = true;
  }
  ending_.notify_one();
  thread_.join();
}

void SampleWriter::finish() {
  end();
  if (failure_) std::rethrow_exception(failure_);
}

}  // namespace sandstroke
