#include "sim/sand_side.h"

#include <algorithm>
#include <cmath>

#include "core/elementary.h"
#include "core/error.h"
#include "core/interrupt.h"
#include "sand/tool_path.h"

namespace sandstroke {
namespace {

/// The longest step, as a fraction of the radius. With it a drag at 2 radii a tick leaves the mean furrow
/// depth of 20 times as many ticks within 2.5 %; with steps of a whole radius within 9 %, without any 49 %
/// short (4 and 10 mm deep).
constexpr double longest_step = 0.5;
/// The least way between relaxations [cells]: sand that relaxes more often has hardly moved. A plate of two
/// cells would ask for that.
constexpr double least_way = 0.25;
/// Height of sand above the rim [radii] from which the way is the short one. Where the tip is R deep, sand
/// stands higher. With 0.5 a scribble R/2 deep over its own ground leaves 6.6 % of its sand elsewhere, 5.5 %
/// with 0.2, 5.2 % with 0.1; a sand table takes 0.35, 0.46 and 0.84 s with 0.5, 0.2 and 0.
constexpr double deep_at_rim = 0.2;

/// Whoever does not ask for the sand on a tool must not lose it there.
ToolSettings without_load(ToolSettings tool) {
  tool.carries = false;
  return tool;
}

}  // namespace

SandSide::SandSide(const ToolSettings& tool, const DisplacementSettings& displacement,
                   const RelaxationSettings& relaxation, std::unique_ptr<Displacer> plugin_law)
    : tool_(make_tool(without_load(tool))),
      displacement_(displacement),
      plugin_law_(std::move(plugin_law)),
      solid_(tool.solid),
      relaxation_(relaxation),
      way_(relaxation.way),
      way_at_rim_(relaxation.way_at_rim),
      by_way_(relaxation.way > 0.0) {}

void SandSide::carry(const ToolSettings& tool, double density) {
  tool_ = Copied<Tool>(make_tool(tool));
  density_ = density;
}

Interaction SandSide::look(const HeightField& bed, const Eigen::Vector3d& read_tip) {
  tool_->place(bed, read_tip.x(), read_tip.y());
  if (density_ > 0.0 && !load_ && tool_->upper_side())
    load_.emplace(relaxation_, density_, *tool_->upper_side());
  if (load_) load_->go_with(*tool_->upper_side());
  Interaction interaction;
  interaction.level = tool_->sand_level();
  const double depth = tool_->depth(read_tip.z());
  interaction.contact = depth > 0.0;
  if (!std::isnan(depth)) interaction.depth = depth;
  return interaction;
}

Interaction SandSide::meet(const HeightField& bed, const Eigen::Vector3d& read_tip) {
  const Interaction interaction = look(bed, read_tip);
  tool_->meet(bed, read_tip.z());
  return interaction;
}

double SandSide::displace_sand(HeightField& bed, const Eigen::Vector3d& tip, const Eigen::Vector3d& motion) {
  if (!plugin_law_) return tool_->displace(bed, tip.z(), motion, displacement_);
  if (tool_->footprint().cells().empty()) return 0.0;
  tool_->meet(bed, tip.z());
  return plugin_law_->displace(bed, *tool_, tip.z(), motion);
}

Interaction SandSide::displace_at(HeightField& bed, const Eigen::Vector3d& tip,
                                  const Eigen::Vector3d& motion) {
  Interaction interaction = look(bed, tip);
  // Beside a floor that is higher than the tip, the sand's mean level says little.
  const bool on_floor = tool_->footprint().highest_floor() > tip.z() + tool_->lowest();
  if (interaction.contact || tool_->may_touch_heaps() || on_floor)
    interaction.displaced_volume = displace_sand(bed, tip, motion);
  if (load_) load_->take(*tool_);
  interaction.contact |= tool_->touches() || (on_floor && interaction.displaced_volume > 0.0);
  tip_ = tip;
  contact_ = interaction.contact;
  return interaction;
}

std::optional<LoadSurface> SandSide::load_surface() const {
  if (!load_ || load_->carried().empty()) return {};
  return load_->carried().surface(*tool_->upper_side());
}

double SandSide::top_at(const Eigen::Vector2d& place) const {
  constexpr double beside = -std::numeric_limits<double>::infinity();
  if (!load_) return beside;
  const UpperSide& upper = *tool_->upper_side();
  const Eigen::Vector2d in_grid = upper.in_grid(place - tip_.head<2>());
  const double row = std::round(upper.grid().row_at(in_grid.y())),
               col = std::round(upper.grid().col_at(in_grid.x()));
  if (!(row >= 0.0 && row < upper.grid().rows() && col >= 0.0 && col < upper.grid().cols())) return beside;
  const auto r = static_cast<int>(row), c = static_cast<int>(col);
  return upper.covers(r, c) ? tip_.z() + upper.top()(r, c) + load_->carried().thickness()(r, c) : beside;
}

void SandSide::catch_sand(const Eigen::Vector2d& place, double height) {
  load_->take(*tool_->upper_side(), {place - tip_.head<2>(), height});
}

LoadOnTool SandSide::load_on_tool() const {
  if (!load_) return {};
  const double level = tool_->sand_level();
  return load_->on_tool(*tool_->upper_side(), contact_ && !std::isnan(level)
                                                  ? level - tip_.z()
                                                  : -std::numeric_limits<double>::infinity());
}

void SandSide::put(const HeightField& bed, const Eigen::Vector3d& read_tip, bool contact) {
  tool_->place(bed, read_tip.x(), read_tip.y());
  tool_->stand(read_tip.z());
  tip_ = read_tip;
  contact_ = contact;
}

Interaction SandSide::move(HeightField& bed, const Eigen::Vector3d& read_tip, const Eigen::Vector3d& true_tip,
                           const std::function<void()>& relax, std::optional<double> highest) {
  const Eigen::Vector3d motion = last_tip_ ? Eigen::Vector3d(true_tip - *last_tip_) : Eigen::Vector3d::Zero();
  TipSteps steps{read_tip - motion, motion, 1};
  const double longest = longest_step * tool_->radius();
  if (elementary::hypot(motion.x(), motion.y()) > longest)
    steps = steps_between(bed, tool_->reach(), steps.begin, read_tip, longest,
                          highest ? *highest : bed.highest());
  double on_the_way = 0.0;
  for (std::int64_t i = 1; i <= steps.count; ++i) {
    Eigen::Vector3d from = steps.at(i - 1);
    while (const std::optional<double> fraction = by_way_.way_to_next(from, steps.at(i) - from)) {
      if (interrupted()) break;
      from += *fraction * (steps.at(i) - from);
      on_the_way += displace_at(bed, from, steps.way).displaced_volume;
      relax();
    }
    if (i == steps.count) break;
    on_the_way += displace_at(bed, steps.at(i), steps.way).displaced_volume;
    if (relaxation_is_due()) relax();
  }
  Interaction interaction = displace_at(bed, read_tip, motion);
  if (relaxation_is_due()) relax();
  interaction.displaced_volume += on_the_way;
  last_tip_ = true_tip;
  return interaction;
}

double SandSide::buried(const HeightField& bed) {
  // Once sand stands at a sphere's rim, the sand displaced outward and the sand that falls in behind the
  // sphere run from one crest. At the sides of any other tool that is always so. (A plough that goes 0.4
  // inradii leaves 25 % of its sand elsewhere than one that goes 0.05; 0.1: 7 %.)
  return std::clamp(tool_->sand_above_rim(bed, tip_.z()) / (deep_at_rim * tool_->radius()), 0.0, 1.0);
}

double SandSide::way_to_next_relaxation(const HeightField& bed) {
  double way = way_;
  if (0.0 < way_at_rim_ && way_at_rim_ < way_) way *= elementary::pow(way_at_rim_ / way_, buried(bed));
  return std::max(way * tool_->radius(), least_way * bed.cell_size());
}

void SandSide::make_walls(HeightField& bed) {
  if (!solid_) return;
  if (contact_)
    tool_->make_walls(bed);
  else
    bed.set_tool_walls({});
}

void SandSide::relaxed(const HeightField& bed) {
  by_way_.relaxed(tip_, contact_, contact_ ? way_to_next_relaxation(bed) : 0.0);
}

void SandSide::visit_state(StateVisitor& state, const HeightField& bed) {
  if (plugin_law_)
    throw_input_error("the state of a plugin's displacement law is not known; it cannot be kept");
  state.value("tool.by_way", by_way_);
  state.value("tool.last_tip", last_tip_);
  state.value("tool.tip", tip_);
  state.value("tool.contact", contact_);
  tool_->visit_state(state, bed, tip_);
  bool loaded = load_.has_value();
  state.value("tool.loaded", loaded);
  if (state.restores()) {
    load_.reset();
    if (loaded) load_.emplace(relaxation_, density_, *tool_->upper_side());
  }
  if (!load_) return;
  load_->visit_state(state);
  if (state.restores()) load_->go_on(*tool_->upper_side());
}

}  // namespace sandstroke
