#include "record/eroder.h"

#include <algorithm>
#include <chrono>
#include <limits>

namespace sandstroke {
namespace {

using namespace std::chrono_literals;

constexpr std::chrono::duration<double> longest_wait(1.0 / 60.0);  // s, with what was dug, and to be stopped
constexpr std::chrono::duration<double> longest_look(1e-3);        // s, for where the tool is
// Where sand has far to go it is felt, and stopped, on its way: some 50 ms of a million moving cells.
constexpr std::int64_t most_passes = 50;

RelaxationSettings in_short_turns(RelaxationSettings settings) {
  settings.max_passes = std::min(settings.max_passes, most_passes);
  return settings;
}

}  // namespace

Eroder::Eroder(const HeightField& bed, const ToolSettings& tool, const RelaxationSettings& settings,
               SandRing& dug, PlaceRing& places, SandRing& slipped, std::unique_ptr<Relaxer> relaxer)
    : replica_(bed),
      rate_(settings.rate),
      travel_(settings.travel * bed.cell_size()),
      solid_(tool.solid),
      footprint_(tool),
      slips_(travel_),
      relaxer_(relaxer ? std::move(relaxer) : make_relaxer(in_short_turns(settings), bed.cell_size())),
      dug_(dug),
      places_(places),
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
  while (places_.pop(place_)) continue;  // before what it dug there, which is told first
  SandChange change;
  while (dug_.pop(change)) replica_.take(change, true);
}

void Eroder::hold() {
  slips_.slipped(place_.tip, place_.contact);
  if (!solid_) return;
  if (place_.contact) {
    footprint_.place(replica_.bed(), place_.tip.x(), place_.tip.y());
    footprint_.hold_bowl(replica_.bed());
  } else {
    replica_.bed().hold({});
  }
}

bool Eroder::slip_is_due() const {
  return travel_ > 0.0 && (!report_.converged || slips_.is_due(place_.tip, place_.contact));
}

void Eroder::turn() {
  exchange();
  if (rate_ <= 0.0 && travel_ <= 0.0) return;
  hold();
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
    exchange();
    if (now() >= due) {
      turn();
      due = std::max(due + period, now());
    } else if (slip_is_due()) {
      turn();
    }
    std::this_thread::sleep_for(std::min(due - now(), travel_ > 0.0 ? longest_look : longest_wait));
  }
}

void Eroder::stop() {
  stopping_ = true;
  if (thread_.joinable()) thread_.join();
}

}  // namespace sandstroke
