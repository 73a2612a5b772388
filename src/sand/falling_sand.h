#pragma once

#include <cstdint>
#include <vector>

#include "core/state_visitor.h"
#include "sand/height_field.h"

namespace sandstroke {

/// Sand on its way down to cells of a bed.
class FallingSand {
 public:
  /// A volume [m^3] that comes down on a cell at this time [s].
  void drop(int row, int col, double volume, double lands);
  /// Gives the bed all that comes down before this time, in that order. False: nothing does.
  bool land(HeightField& bed, double until);
  /// m^3, in the air.
  double volume() const;
  void visit_state(StateVisitor& state);

 private:
  struct Packet {
    double lands;         // s
    std::uint64_t count;  // of those before it: which one of two comes first
    double volume;        // m^3
    int row, col;

    template <class State>
    void visit_state(State& state) {
      state.value("lands", lands);
      state.value("count", count);
      state.value("volume", volume);
      state.value("row", row);
      state.value("col", col);
    }
  };
  static bool later(const Packet& one, const Packet& other) {
    return one.lands != other.lands ? one.lands > other.lands : one.count > other.count;
  }

  std::vector<Packet> in_air_;  // a heap: the first to land is in front
  std::uint64_t packets_ = 0;   // so far
};

}  // namespace sandstroke
