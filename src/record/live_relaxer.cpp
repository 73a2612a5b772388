#include "record/live_relaxer.h"

#include <algorithm>
#include <chrono>
#include <limits>

namespace sandstroke {
namespace {

using namespace std::chrono_literals;

constexpr std::chrono::duration<double> longest_wait(1.0 / 60.0);  // s, to take displaced sand or to stop
constexpr std::chrono::duration<double> longest_look(1e-3);        // s, to see where the tool is
// Sand with far to go is felt, and can be stopped, on its way: some 50 ms of a million moving cells.
constexpr std::int64_t most_passes = 50;

RelaxationSettings in_short_turns(RelaxationSettings settings) {
  settings.max_passes = std::min(settings.max_passes, most_passes);
  return settings;
}

}  // namespace

LiveRelaxer::LiveRelaxer(const HeightField& bed, const ToolSettings& tool, const RelaxationSettings& settings,
                         SandRing& displaced, PoseRing& poses, SandRing& relaxed,
                         std::unique_ptr<Relaxer> relaxer)
    : replica_(bed),
      rate_(settings.rate),
      by_way_(settings.way > 0.0),
      solid_(tool.solid),
      tool_(tool, {}, settings),
      relaxer_(relaxer ? std::move(relaxer) : make_relaxer(in_short_turns(settings), bed.cell_size())),
      displaced_(displaced),
      poses_(poses),
      relaxed_(relaxed) {}

void LiveRelaxer::give(const SandChange& change) {
  while (!relaxed_.push(change)) {
    if (stopping_) {
      ungiven_.push_back(change);
      return;
    }
    std::this_thread::sleep_for(1ms);
  }
}

void LiveRelaxer::exchange() {
  std::vector<SandChange> before;
  before.swap(ungiven_);
  for (const SandChange& change : before) give(change);
  // Poses first: a pose is told after the sand displaced there, so the sand is never older than the tool.
  ToolPose pose;
  bool told = false;
  while (poses_.pop(pose)) told = true;
  if (told) {
    pose_ = pose;
    tool_.put(replica_.bed(), pose.tip, pose.contact);
  }
  begun_ = begun_ || told;
  SandChange change;
  while (displaced_.pop(change)) replica_.take_displaced(change);
}

bool LiveRelaxer::relaxation_is_due() const {
  return by_way_ && (!report_.converged || tool_.relaxation_is_due());
}

void LiveRelaxer::turn() {
  exchange();
  relax();
}

void LiveRelaxer::relax() {
  if (rate_ <= 0.0 && !by_way_) return;
  if (solid_ && pose_.rotation) {  // not in exchange(), because it takes long
    tool_.turn(*pose_.rotation);
    tool_.put(replica_.bed(), pose_.tip, pose_.contact);
  }
  tool_.make_walls(replica_.bed());
  const RelaxationOutcome outcome = relaxer_->relax(replica_.bed());
  tool_.relaxed(replica_.bed());
  report_.relaxations += 1;
  report_.passes += outcome.passes;
  report_.converged = outcome.converged;
  replica_.tell_changed([this](const SandChange& relaxed) { give(relaxed); });
  report_.most_waiting = std::max(report_.most_waiting, relaxed_.size());
}

void LiveRelaxer::start() {
  stopping_ = false;
  thread_ = std::thread([this] {
    try {
      run();
    } catch (...) {  // the hand goes on feeling: ending the program here would not release the device
      failure_ = std::current_exception();
    }
  });
}

void LiveRelaxer::run() {
  using Seconds = std::chrono::duration<double>;
  const auto now = [] { return Seconds(std::chrono::steady_clock::now().time_since_epoch()); };
  const Seconds period(rate_ > 0.0 ? 1.0 / rate_ : std::numeric_limits<double>::infinity());
  for (Seconds due = now(); !stopping_;) {
    exchange();
    if (!begun_) {
      std::this_thread::sleep_for(longest_look);
      due = now();
      continue;
    }
    if (now() >= due) {
      relax();
      due = std::max(due + period, now());
    } else if (relaxation_is_due()) {
      relax();
    }
    if (onlooker_) onlooker_(replica_.bed());
    std::this_thread::sleep_for(std::min(due - now(), by_way_ ? longest_look : longest_wait));
  }
}

void LiveRelaxer::stop() {
  stopping_ = true;
  if (thread_.joinable()) thread_.join();
}

}  // namespace sandstroke
