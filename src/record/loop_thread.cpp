#include "record/loop_thread.h"

#include <chrono>
#include <utility>

#include "core/interrupt.h"
#include "record/real_time.h"

namespace sandstroke {

LoopThread::LoopThread(ServoLoop& loop, int priority, bool lock_memory) : loop_(loop) {
  std::promise<Scheduling> scheduling;
  std::promise<RecordingFooter> footer;
  std::future<Scheduling> asked = scheduling.get_future();
  footer_ = footer.get_future();
  thread_ = std::thread([&loop, priority, lock_memory, go = go_.get_future(),
                         scheduling = std::move(scheduling), footer = std::move(footer)]() mutable {
    scheduling.set_value(
        ask_for_real_time(priority, lock_memory ? MemoryLock::asked : MemoryLock::not_asked));
    go.wait();
    footer.set_value(loop.run());
  });
  scheduling_ = asked.get();
}

LoopThread::~LoopThread() {
  loop_.stop(StopReason::error);
  if (!started_) start();
  thread_.join();
}

void LoopThread::start() {
  if (interrupted()) loop_.stop(StopReason::signal);
  started_ = true;
  go_.set_value();
}

void LoopThread::watch(const RecordingWatcher& watcher, double interval) {
  while (footer_.wait_for(std::chrono::duration<double>(interval)) != std::future_status::ready) {
    if (interrupted()) loop_.stop(StopReason::signal);
    if (!watcher) continue;
    if (const std::optional<StopReason> reason = watcher(loop_.progress())) loop_.stop(*reason);
  }
  if (watcher) watcher(loop_.progress());
}

}  // namespace sandstroke
