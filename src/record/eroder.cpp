#include "record/eroder.h"

#include <algorithm>
#include <chrono>
#include <limits>

namespace sandstroke {
namespace {

using namespace std::chrono_literals;

constexpr std::chrono::duration<double> longest_wait(1.0 / 60.0);  // s, with what was dug, and to be stopped
// Where sand has far to go it is felt, and stopped, on its way: some 50 ms of a million moving cells.
constexpr std::int64_t most_passes = 50;

RelaxationSettings in_short_turns(RelaxationSettings settings) {
  settings.max_passes = std::min(settings.max_passes, most_passes);
  return settings;
}

}  // namespace

Eroder::Eroder(const HeightField& bed, const RelaxationSettings& settings, SandRing& dug, SandRing& slipped,
               std::unique_ptr<Relaxer> relaxer)
    : replica_(bed),
      rate_(settings.rate),
      relaxer_(relaxer ? std::move(relaxer) : make_relaxer(in_short_turns(settings), bed.cell_size())),
      dug_(dug),
      slipped_(slipped) {}

void Eroder::give(const SandChange& change) {
  while (!slipped_.push(change)) {
    if (stopping_) {
      held_.push_back(change);
      return;
    }
    std::this_thread::sleep_for(1ms);
  }
}

void Eroder::exchange() {
  std::vector<SandChange> before;
  before.swap(held_);
  for (const SandChange& change : before) give(change);
  SandChange change;
  while (dug_.pop(change)) replica_.take(change, true);
}

void Eroder::turn() {
  exchange();
  if (rate_ <= 0.0) return;
  const RelaxationOutcome outcome = relaxer_->relax(replica_.bed());
  report_.relaxations += 1;
  report_.passes += outcome.passes;
  report_.converged = outcome.converged;
  replica_.tell_changed([this](const SandChange& slipped) { give(slipped); });
  report_.most_waiting = std::max(report_.most_waiting, slipped_.size());
}

void Eroder::start() {
  stopping_ = false;
  thread_ = std::thread([this] {
    try {
      run();
    } catch (...) {  // the hand goes on feeling: a program that ended here would not release the device
      failure_ = std::current_exception();
    }
  });
}

void Eroder::run() {
  using Seconds = std::chrono::duration<double>;
  const auto now = [] { return Seconds(std::chrono::steady_clock::now().time_since_epoch()); };
  const Seconds period(rate_ > 0.0 ? 1.0 / rate_ : std::numeric_limits<double>::infinity());
  for (Seconds due = now(); !stopping_;) {
    if (now() >= due) {
      turn();
      due = std::max(due + period, now());
    } else {
      exchange();
    }
    std::this_thread::sleep_for(std::min(due - now(), longest_wait));
  }
}

void Eroder::stop() {
  stopping_ = true;
  if (thread_.joinable()) thread_.join();
}

}  // namespace sandstroke
