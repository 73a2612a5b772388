#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "core/state_visitor.h"
#include "rules/force.h"

namespace sandstroke {

/// The time that sand falls from one height to another [m, s]; 0 where that is no fall, or a height is no
/// number.
inline double fall_time(double from, double to) {
  return from > to ? std::sqrt(2.0 * (from - to) / gravity) : 0.0;
}

/// Sand on its way down, in packets. They land in the order of their times; of two at one time, the one that
/// was dropped first.
template <class Packet>
class FallingSand {
 public:
  /// Memory [bytes] of a packet in the air.
  static constexpr double bytes_per_packet() { return sizeof(Fall); }

  /// A packet that lands at this time [s].
  void drop(double lands, const Packet& packet) {
    in_air_.push_back({lands, dropped_++, packet});
    std::push_heap(in_air_.begin(), in_air_.end(), later);
  }
  /// Takes the next packet that lands before this time [s] out of the air; none: there is none.
  std::optional<Packet> land(double until) {
    if (in_air_.empty() || !(in_air_.front().lands < until)) return {};
    std::pop_heap(in_air_.begin(), in_air_.end(), later);
    const Packet packet = in_air_.back().packet;
    in_air_.pop_back();
    return packet;
  }
  bool empty() const { return in_air_.empty(); }
  template <class Visit>
  void visit_packets(const Visit& visit) const {
    for (const Fall& fall : in_air_) visit(fall.packet);
  }
  void visit_state(StateVisitor& state) {
    state.list("falling.in_air", in_air_);
    state.value("falling.dropped", dropped_);
  }

 private:
  struct Fall {
    double lands;         // s
    std::uint64_t count;  // of those before it: which one of two comes first
    Packet packet;

    template <class State>
    void visit_state(State& state) {
      state.value("lands", lands);
      state.value("count", count);
      packet.visit_state(state);
    }
  };
  static bool later(const Fall& one, const Fall& other) {
    return one.lands != other.lands ? one.lands > other.lands : one.count > other.count;
  }

  std::vector<Fall> in_air_;   // a heap: the first to land is in front
  std::uint64_t dropped_ = 0;  // so far
};

}  // namespace sandstroke
