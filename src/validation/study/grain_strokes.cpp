#include "validation/study/grain_strokes.h"

#include <algorithm>
#include <cmath>

#include "measure/solution.h"
#include "sim/simulation.h"
#include "validation/study/contact_scene.h"

namespace sandstroke {
namespace {

constexpr double tool_radius = 0.01;                    // m
constexpr double bed_length = 0.09, bed_width = 0.056;  // m
constexpr double drag_start = -0.03;                    // m, along x

// Values of the grains' beds (tests/accuracy/grains).
constexpr double talus = 23.2;           // deg
constexpr double bulk_density = 1540.0;  // kg/m^3
constexpr double tool_friction = 0.5;

bool is_drag(const GrainStroke& stroke) { return stroke.way > 0.0; }

/// The x at which the tool goes down [m].
double start_of(const GrainStroke& stroke) { return is_drag(stroke) ? drag_start : 0.0; }

/// True if `way` [m], counted along x from the start, lies in the measured part.
bool is_measured(double way) { return way > grain_way_from && way < grain_way_to; }

/// Computes the mean force on the tool in the last pass: over the measured part of a drag, or the last 0.4 mm
/// of a plunge.
class MeanForce : public SimulationObserver {
 public:
  explicit MeanForce(const GrainStroke& stroke) : stroke_(stroke) {}
  void on_tick(const TickRecord& tick) override {
    const Eigen::Vector3d &from = tick.hand.position, &to = tick.next.position;
    if (to.x() < from.x()) {  // back for another pass
      sum_.setZero();
      ticks_ = 0;
    }
    const bool counts = is_drag(stroke_) ? is_measured(to.x() - drag_start)
                                         : to.z() < from.z() && to.z() < 4e-4 - stroke_.depth;
    if (counts) {
      sum_ += tick.wrench.force;
      ++ticks_;
    }
  }
  Eigen::Vector3d mean() const { return sum_ / std::max(ticks_, 1); }

 private:
  const GrainStroke& stroke_;
  Eigen::Vector3d sum_ = Eigen::Vector3d::Zero();
  int ticks_ = 0;
};

std::vector<double> mean_changes(const HeightField& bed, const GrainStroke& stroke) {
  std::vector<double> sums(stroke.change.size()), cells(stroke.change.size());
  for (int row = 0; row < bed.rows(); ++row)
    for (int col = 0; col < bed.cols(); ++col) {
      const double x = bed.x_of(col) - start_of(stroke), y = bed.y_of(row);
      if (is_drag(stroke) && !is_measured(x)) continue;
      const double distance = is_drag(stroke) ? std::abs(y) : std::hypot(x, y);
      const auto bin = static_cast<std::size_t>(distance / grain_bin);
      if (bin < sums.size()) {
        sums[bin] += bed(row, col);
        cells[bin] += 1.0;
      }
    }
  for (std::size_t bin = 0; bin < sums.size(); ++bin) sums[bin] /= cells[bin];
  return sums;
}

}  // namespace

Scene grain_scene(const GrainStroke& stroke, ModelPreset preset, int cells_per_radius) {
  const double cell = tool_radius / cells_per_radius;
  Scene scene = contact_scene(bed_length, static_cast<int>(std::lround(bed_length / cell)), 1000.0);
  scene.bed.rows = static_cast<int>(std::lround(bed_width / cell));
  scene.bed.depth = scene.bed.rows * scene.bed.cell_size();
  scene.preset = preset;
  apply_model_preset(scene);
  scene.relaxation.talus_angle = talus;
  scene.tool.shape = stroke.shape;
  scene.tool.radius = tool_radius;
  scene.tool.width = 2.0 * tool_radius;
  scene.tool.thickness = 0.004;
  scene.tool.height = stroke.shape == ToolShape::cone ? tool_radius : 0.024;
  if (preset == ModelPreset::accurate) scene.force.law = ForceLaw::rft;
  scene.strength.friction_angle = talus;
  scene.strength.density = bulk_density;
  scene.strength.tool_friction = tool_friction;
  return scene;
}

Stroke hand_of(const GrainStroke& stroke) {
  constexpr double above = 0.0005, lifted = 0.005;     // m
  constexpr double down = 0.1, along = 0.2, up = 0.3;  // m/s
  constexpr double back = 0.05;                        // s
  const double from = start_of(stroke), to = from + stroke.way;
  std::vector<Eigen::Vector3d> positions;
  std::vector<double> seconds;
  const auto go = [&](double x, double z, double duration) {
    if (!positions.empty()) seconds.push_back(duration);
    positions.emplace_back(x, 0.0, z);
  };
  for (int pass = 0; pass < stroke.passes; ++pass) {
    go(from, above, back);
    go(from, -stroke.depth, (above + stroke.depth) / down);
    if (is_drag(stroke)) go(to, -stroke.depth, stroke.way / along);
    go(to, lifted, (lifted + stroke.depth) / up);
  }
  return straight(positions, seconds);
}

GrainReply reply_to(const GrainStroke& stroke, const Scene& scene) {
  MeanForce force(stroke);
  const Solution run = solve(scene, starting_bed(scene.bed), hand_of(stroke), {&force});
  return {run.result, mean_changes(run.surface, stroke), -force.mean().x(), force.mean().z()};
}

double section_error(const std::vector<double>& change, const GrainStroke& grains) {
  double difference = 0.0, moved = 0.0;
  for (std::size_t bin = 0; bin < grains.change.size(); ++bin) {
    const double area = is_drag(grains)
                            ? 1.0
                            : 2.0 * static_cast<double>(bin) + 1.0;  // relative: a strip, or a circular ring
    difference += area * std::abs(change[bin] - grains.change[bin]);
    moved += area * std::abs(grains.change[bin]);
  }
  return difference / moved;
}

double force_error(const GrainReply& reply, const GrainStroke& grains) {
  return std::hypot(reply.against - grains.against, reply.up - grains.up) /
         std::hypot(grains.against, grains.up);
}

Groove groove_of(const std::vector<double>& change) {
  const auto levee = std::max_element(change.begin(), change.end());
  Groove groove{0.0, *levee};
  for (auto height = change.begin(); height != levee; ++height)
    groove.area += 2.0 * grain_bin * std::max(0.0, -*height);
  return groove;
}

}  // namespace sandstroke
