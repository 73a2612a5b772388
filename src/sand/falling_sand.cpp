#include "sand/falling_sand.h"

#include <algorithm>

#include "core/compensated_sum.h"

namespace sandstroke {

void FallingSand::drop(int row, int col, double volume, double lands) {
  in_air_.push_back({lands, packets_++, volume, row, col});
  std::push_heap(in_air_.begin(), in_air_.end(), later);
}

bool FallingSand::land(HeightField& bed, double until) {
  bool any = false;
  while (!in_air_.empty() && in_air_.front().lands < until) {
    std::pop_heap(in_air_.begin(), in_air_.end(), later);
    const Packet& packet = in_air_.back();
    bed.set(packet.row, packet.col, bed(packet.row, packet.col) + packet.volume / bed.cell_area());
    in_air_.pop_back();
    any = true;
  }
  return any;
}

double FallingSand::volume() const {
  CompensatedSum sum;
  for (const Packet& packet : in_air_) sum.add(packet.volume);
  return sum.value();
}

void FallingSand::visit_state(StateVisitor& state) {
  state.list("falling.in_air", in_air_);
  state.value("falling.packets", packets_);
}

}  // namespace sandstroke
