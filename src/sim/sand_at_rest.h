#pragma once

#include <memory>
#include <vector>

#include "core/copied.h"
#include "sand/relaxation.h"

namespace sandstroke {

/// Shows a bed as it would lie if it came to rest now. Between two relaxations of a run the sand that a tool
/// pushed out stands beside it as walls, a cell thick: no sand stands so. A copy relaxes, so the run goes on
/// as if nobody had looked. Each look costs what was pushed since the last one, and its relaxation.
class SandAtRest {
 public:
  SandAtRest(const HeightField& bed, std::unique_ptr<Relaxer> relaxer);

  /// The copy, which takes over what differs in `bed`, the same bed as always. Then it may get the tool's
  /// walls, and relax().
  HeightField& follow(const HeightField& bed);
  /// Relaxes the copy, as its relaxer does in one turn.
  RelaxationOutcome relax() { return relaxer_->relax(copy_); }
  /// The same, with what the bed's relaxer remembers of the sand.
  RelaxationOutcome relax(const Relaxer& of_the_bed) {
    relaxer_->take_over(of_the_bed, copy_);
    return relax();
  }
  const HeightField& copy() const { return copy_; }
  void visit_state(StateVisitor& state) {
    copy_.visit_state(state);
    relaxer_->visit_state(state);
    state.list("at_rest.same", same_);
  }

 private:
  /// Revisions of a tile when the copy had the bed's heights.
  struct Revisions {
    std::uint64_t bed, copy;
    bool operator==(const Revisions&) const = default;
    template <class State>
    void visit_state(State& state) {
      state.value("bed", bed);
      state.value("copy", copy);
    }
  };
  Revisions revisions(const HeightField& bed, int tile) const {
    return {bed.tile_revision(tile), copy_.tile_revision(tile)};
  }
  void take_tile(const HeightField& bed, int slot);

  HeightField copy_;
  Copied<Relaxer> relaxer_;
  std::vector<Revisions> same_;  // by the copy's slots
};

}  // namespace sandstroke
