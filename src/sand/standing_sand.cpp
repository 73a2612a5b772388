#include "sand/standing_sand.h"

#include <utility>

#include "core/copied.h"
#include "core/interrupt.h"
#include "sand/ground.h"

namespace sandstroke {
namespace {

/// Lays a bed on another ground for a while.
class OnGround {
 public:
  OnGround(HeightField& bed, std::shared_ptr<const Ground> ground) : bed_(bed), other_(std::move(ground)) {
    bed_.exchange_ground(other_);
  }
  ~OnGround() { bed_.exchange_ground(other_); }
  OnGround(const OnGround&) = delete;
  OnGround& operator=(const OnGround&) = delete;
  const std::shared_ptr<const Ground>& own() const { return other_; }

 private:
  HeightField& bed_;
  std::shared_ptr<const Ground> other_;
};

class StandingRelaxer : public Relaxer {
 public:
  StandingRelaxer(std::unique_ptr<Relaxer> flow, const HeightField& bed, const StandingSand& sand)
      : flow_(std::move(flow)), sand_(sand), cuts_(bed, sand.factor) {}

  std::unique_ptr<Relaxer> copy() const override { return std::make_unique<StandingRelaxer>(*this); }
  void visit_state(StateVisitor& state) override {
    cuts_.visit_state(state);
    state.value("standing.dried_now", sand_.cohesion.dried);
    flow_->visit_state(state);
  }
  void set_time(double time) override { sand_.cohesion.dried = sand_.dries * time; }
  void take_over(const Relaxer& other, const HeightField& bed) override {
    const auto& standing = dynamic_cast<const StandingRelaxer&>(other);
    sand_ = standing.sand_;
    cuts_.take_over(standing.cuts_, bed);
  }

  RelaxationOutcome relax(HeightField& bed, const PassWatcher& after_pass) override {
    RelaxationOutcome outcome;
    cuts_.cut(bed, sand_.cohesion);
    for (bool has_failed = false;; has_failed = true) {
      const RelaxationOutcome flowed = flow(bed, outcome.passes, after_pass);
      outcome.add(flowed);
      // What fails at a slope at which loose sand may lie stays there.
      if (!flowed.converged || interrupted() || (has_failed && flowed.passes == 0)) break;
      // Sand that has bonded makes new faces: they are looked at, too, so that what stands is left alone.
      if (sand_.heals) cuts_.heal(bed, sand_.cohesion);
      const StandingCuts::Look look = cuts_.look(bed, sand_.cohesion);
      outcome.failed_volume += look.volume;
      if (look.failed == 0) break;
    }
    return outcome;
  }

 private:
  /// Relaxes what is loose. Those who look on see the bed on its own ground.
  RelaxationOutcome flow(HeightField& bed, std::int64_t passes_before, const PassWatcher& after_pass) {
    const std::shared_ptr<const Ground>& own = bed.shared_ground();
    OnGround intact(
        bed, std::make_shared<const Ground>(
                 cuts_.level(), own ? own->talus_slopes : Ground(bed, sand_.talus_slope).talus_slopes));
    PassWatcher told;
    if (after_pass)
      told = [&](std::int64_t passes, const BedNow& bed_now) {
        const OnGround as_always(bed, intact.own());
        after_pass(passes_before + passes, bed_now);
      };
    return flow_->relax(bed, told);
  }

  Copied<Relaxer> flow_;
  StandingSand sand_;
  StandingCuts cuts_;
};

}  // namespace

std::unique_ptr<Relaxer> make_standing_relaxer(std::unique_ptr<Relaxer> flow, const HeightField& bed,
                                               const StandingSand& sand) {
  return std::make_unique<StandingRelaxer>(std::move(flow), bed, sand);
}

}  // namespace sandstroke
