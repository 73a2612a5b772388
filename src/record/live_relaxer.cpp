#include "record/live_relaxer.h"

#include <algorithm>
#include <chrono>
#include <limits>

#include "core/interrupt.h"

namespace sandstroke {
namespace {

using namespace std::chrono_literals;

constexpr std::chrono::duration<double> longest_wait(1.0 / 60.0);  // s, to take displaced sand, show or stop
constexpr std::chrono::duration<double> longest_look(1e-3);        // s, to see where the tool is
// Sand with far to go is felt, and can be stopped, on its way: some 50 ms of a million moving cells.
constexpr std::int64_t most_passes = 50;
// The same of a copy for one picture: some 5 ms, so that the felt sand need not wait. Sand with farther to go
// is shown on its way.
constexpr std::int64_t most_visits = 2'000'000, passes_of_copy = 5;

RelaxationSettings in_turns_of(std::int64_t passes, RelaxationSettings settings) {
  settings.max_passes = std::min(settings.max_passes, passes);
  return settings;
}

/// Whether a tool holds the same sand in both poses, as far as one sees. A hand that rests still trembles.
bool look_alike(const ToolPose& a, const ToolPose& b, double cell_size) {
  return a.contact == b.contact && (a.tip - b.tip).norm() < 0.01 * cell_size &&
         a.rotation.has_value() == b.rotation.has_value() &&
         (!a.rotation || (*a.rotation - *b.rotation).norm() < 1e-3);
}

}  // namespace

LiveRelaxer::LiveRelaxer(const HeightField& bed, const ToolSettings& tool, const RelaxationSettings& settings,
                         SandRing& displaced, PoseRing& poses, SandRing& relaxed,
                         std::unique_ptr<Relaxer> relaxer)
    : replica_(bed),
      settings_(settings),
      by_way_(settings.way > 0.0),
      solid_(tool.solid),
      tool_(tool, {}, settings),
      relaxer_(relaxer ? std::move(relaxer)
                       : make_relaxer(in_turns_of(most_passes, settings), bed.cell_size())),
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
  bool displaced = false;
  for (; displaced_.pop(change); displaced = true) replica_.take_displaced(change);
  is_news_ = is_news_ || displaced;
}

void LiveRelaxer::turn_tool() {
  if (!solid_ || !pose_.rotation) return;
  tool_.turn(*pose_.rotation);
  tool_.put(replica_.bed(), pose_.tip, pose_.contact);
}

bool LiveRelaxer::relaxation_is_due() const {
  return by_way_ && (!report_.converged || tool_.relaxation_is_due());
}

void LiveRelaxer::turn() {
  exchange();
  relax();
}

void LiveRelaxer::relax() {
  if (settings_.rate <= 0.0 && !by_way_) return;
  turn_tool();  // not in exchange(), because it takes long
  tool_.make_walls(replica_.bed());
  const RelaxationOutcome outcome = relaxer_->relax(replica_.bed());
  tool_.relaxed(replica_.bed());
  report_.relaxations += 1;
  report_.passes += outcome.passes;
  report_.converged = outcome.converged;
  is_news_ = is_news_ || outcome.passes > 0;
  replica_.tell_changed([this](const SandChange& relaxed) { give(relaxed); });
  report_.most_waiting = std::max(report_.most_waiting, relaxed_.size());
}

void LiveRelaxer::show_to(std::function<void(const HeightField&)> onlooker) {
  onlooker_ = std::move(onlooker);
  shown_.emplace(replica_.bed(),
                 make_relaxer(in_turns_of(passes_of_copy, settings_), replica_.bed().cell_size()));
}

void LiveRelaxer::show() {
  if (!onlooker_ || interrupted()) return;  // relaxers stop then, and would show walls
  if (is_news_ || !look_alike(pose_, shown_pose_, replica_.bed().cell_size())) {
    HeightField& shown = shown_->follow(replica_.bed());
    turn_tool();
    tool_.make_walls(shown);
    is_news_ = false;
    shown_pose_ = pose_;
  } else if (shown_rests_) {
    return;
  }
  shown_rests_ = report_.relaxations == 0;  // sand that never relaxes is shown as it is
  for (std::int64_t visits = 0; !shown_rests_ && visits < most_visits;) {
    const RelaxationOutcome outcome = shown_->relax();
    shown_rests_ = outcome.converged || outcome.passes == 0;
    visits += outcome.cells_visited;
  }
  onlooker_(shown_->copy());
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
  const double rate = settings_.rate;
  const Seconds period(rate > 0.0 ? 1.0 / rate : std::numeric_limits<double>::infinity());
  for (Seconds due = now(), look = due; !stopping_;) {
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
    if (now() >= look) {
      show();
      look = now() + longest_wait;
    }
    const Seconds wait = std::min(due, look) - now();
    std::this_thread::sleep_for(by_way_ ? std::min(wait, longest_look) : wait);
  }
}

void LiveRelaxer::stop() {
  stopping_ = true;
  if (thread_.joinable()) thread_.join();
}

}  // namespace sandstroke
