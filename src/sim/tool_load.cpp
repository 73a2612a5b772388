#include "sim/tool_load.h"

#include <algorithm>
#include <cmath>

#include "rules/force.h"

namespace sandstroke {

ToolLoad::ToolLoad(const RelaxationSettings& relaxation, double density, const UpperSide& upper)
    : carried_(relaxation, upper), density_(density) {}

void ToolLoad::take(const Tool& tool) {
  if (tool.lifted().empty()) return;
  const double cell_area = tool.upper_side()->grid().cell_area();
  for (const LiftedSand& one : tool.lifted()) lifted_.add(one.height * cell_area);
  carried_.take(*tool.upper_side(), tool.lifted());
  most_ = std::max(most_, carried_.volume());
}

void ToolLoad::take(const UpperSide& upper, const LiftedSand& caught) {
  caught_.add(caught.height * upper.grid().cell_area());
  carried_.take(upper, {caught});
  most_ = std::max(most_, carried_.volume());
}

void ToolLoad::relax(const Tool& tool, HeightField& bed, const Eigen::Vector3d& tip, double time) {
  const CarriedSand::Outcome outcome = carried_.relax(*tool.upper_side(), bed, tip);
  ran_on_.add(outcome.ran_on);
  spilled_.add(outcome.spilled);
  most_ = std::max(most_, carried_.volume());
  for (const CarriedSand::Spill& spill : outcome.spills) {
    const double fall = fall_time(spill.from, bed(spill.row, spill.col));
    falling_.drop(time + fall, {spill.volume, spill.row, spill.col});
  }
  has_landed_ = false;
  constexpr double rounding = 1e-15;  // m^3
  has_moved_ = outcome.ran_on + outcome.spilled > rounding;
}

void ToolLoad::land(HeightField& bed, double until) {
  while (const std::optional<Packet> packet = falling_.land(until)) {
    bed.set(packet->row, packet->col, bed(packet->row, packet->col) + packet->volume / bed.cell_area());
    has_landed_ = true;
  }
}

double ToolLoad::volume_in_air() const {
  CompensatedSum sum;
  falling_.visit_packets([&](const Packet& packet) { sum.add(packet.volume); });
  return sum.value();
}

void ToolLoad::pass(double tick) {
  const double missing = carried_.volume() - felt_volume_;
  const Eigen::Vector3d away = carried_.moment() - felt_moment_;
  constexpr double nothing = 1e-15;  // m^3, at a metre from the tip
  if (std::abs(missing) < nothing && away.cwiseAbs().maxCoeff() < nothing) {
    felt_volume_ = carried_.volume();
    felt_moment_ = carried_.moment();
    return;
  }
  const double fraction = std::min(1.0, tick / settling);
  felt_volume_ += fraction * missing;
  felt_moment_ += fraction * away;
}

LoadOnTool ToolLoad::on_tool(const UpperSide& upper, double level) const {
  LoadOnTool load;
  if (felt_volume_ == 0.0) return load;
  double part = 1.0, growth = 0.0;  // 1/m
  if (!carried_.empty() && level > -std::numeric_limits<double>::infinity()) {
    double above = 0.0, whole = 0.0;
    for (Eigen::Index i = 0; i < carried_.thickness().size(); ++i) {
      const double here = carried_.thickness().data()[i];
      if (here == 0.0) continue;
      const double stands = upper.top().data()[i] + here - level;
      above += std::clamp(stands, 0.0, here);
      whole += here;
      if (stands > 0.0 && stands < here) growth += 1.0;
    }
    part = above / whole;
    growth /= whole;
  }
  const double per_volume = part * density_ * gravity;
  const Eigen::Vector3d moment = upper.turned(felt_moment_);
  load.weight = per_volume * felt_volume_;
  load.stiffness = growth * density_ * gravity * std::min(felt_volume_, carried_.volume());
  load.torque = per_volume * Eigen::Vector3d(-moment.y(), moment.x(), 0.0);
  return load;
}

double ToolLoad::given_volume() const {
  return spilled_.value() - volume_in_air() - lifted_.value() - ran_on_.value() - caught_.value();
}

LoadLedger ToolLoad::ledger() const {
  return {lifted_.value(),
          ran_on_.value(),
          caught_.value(),
          spilled_.value(),
          volume_in_air(),
          carried_.volume(),
          most_};
}

void ToolLoad::visit_state(StateVisitor& state) {
  carried_.visit_state(state);
  falling_.visit_state(state);
  state.value("load.lifted", lifted_);
  state.value("load.ran_on", ran_on_);
  state.value("load.caught", caught_);
  state.value("load.spilled", spilled_);
  state.value("load.most", most_);
  state.value("load.felt_volume", felt_volume_);
  state.value("load.felt_moment", felt_moment_);
  state.value("load.has_moved", has_moved_);
  state.value("load.has_landed", has_landed_);
}

}  // namespace sandstroke
