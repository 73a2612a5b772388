// Whole scenes at random: grounds, sources, tools, devices and strokes, each with values from the ends of
// their ranges.
#include <spdlog/fmt/fmt.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <random>

#include "core/angle.h"
#include "haptics/passivity.h"
#include "validation/stress/hostile_grounds.h"
#include "validation/stress/judged_run.h"
#include "validation/stress/stress.h"

namespace sandstroke {
namespace {

/// A scene with a ground, and the stroke that is played on it, if any. The same for the same seed.
class AnyScene {
 public:
  explicit AnyScene(unsigned seed) : random_(seed) {
    draw_bed();
    draw_ground();
    if (chance(0.7)) draw_stroke();
    if (chance(0.5) || (!stroke && chance(0.5))) draw_sources();
    if (chance(0.3)) draw_moisture();
  }

  Scene scene;
  std::optional<Stroke> stroke;

  std::string words() const {
    return fmt::format(
        "{}{} by {}, {}", scene.moisture ? "moist, " : "",
        relaxation_law_names[static_cast<int>(scene.relaxation.law)],
        relaxation_method_names[static_cast<int>(scene.relaxation.method)],
        stroke ? scene.device.model == DeviceModel::dynamic ? "dynamic device" : "kinematic device"
               : "no stroke");
  }

 private:
  void draw_bed() {
    scene.preset = one_of({ModelPreset::paper, ModelPreset::accurate});
    apply_model_preset(scene);
    BedSettings& bed = scene.bed;
    bed.cols = whole(20, 140);
    bed.rows = whole(20, 80);
    bed.shape = chance(0.2) ? BedShape::round : BedShape::rectangle;
    bed.width = bed.cols * size_;
    bed.depth = bed.rows * size_;
    SurfaceSettings& surface = bed.surface;
    surface.kind = one_of({SurfaceKind::flat, SurfaceKind::flat, SurfaceKind::noise, SurfaceKind::cliff,
                           SurfaceKind::cylinder, SurfaceKind::cone, SurfaceKind::ripples});
    surface.height = real(-10.0, 10.0) * size_;
    surface.radius = real(0.1, 20.0) * size_;
    surface.amplitude = real(0.0, 5.0) * size_;
    surface.wavelength = surface.kind == SurfaceKind::ripples ? real(5.0, 60.0) * size_ : 0.0;
    surface.seed = static_cast<std::uint32_t>(random_());
    RelaxationSettings& relaxation = scene.relaxation;
    relaxation.law = one_of({RelaxationLaw::paper, RelaxationLaw::isotropic, RelaxationLaw::faces});
    relaxation.method =
        one_of({RelaxationMethod::passes, RelaxationMethod::rkl, RelaxationMethod::multilevel});
    if (relaxation.law == RelaxationLaw::paper) relaxation.method = RelaxationMethod::passes;
    relaxation.talus_angle = one_of({1.0, 30.0, 30.0, 45.0, 89.0});
    relaxation.max_passes = one_of({0, 1, 10, 500, 500, 500});
    relaxation.rate = one_of({0.0, 0.0, 60.0, 60.0, 1000.0});
    relaxation.way = one_of({0.0, 0.4});
    relaxation.tolerance = one_of({1e-3, 1e-6, 0.5});
  }

  void draw_ground() {
    GroundSettings& ground = scene.ground;
    if (chance(0.6)) ground.floor = one_of({-1000.0, -0.02, -size_, 0.0, 1e-9, 0.01, 1000.0});
    for (int i = whole(0, 4); i > 0; --i) {
      StoneSettings stone =
          stone_of(one_of({StoneShape::sphere, StoneShape::ellipsoid, StoneShape::box}), place(),
                   {length(), length(), length()}, one_of({0.0, 0.0, 1.0, 45.0, 89.9}), real(-180.0, 180.0));
      if (chance(0.3)) stone.turn = one_of({0.0, 90.0, 45.0});
      if (!ground.floor || chance(0.02) || top_of(stone) > *ground.floor) ground.stones.push_back(stone);
    }
    for (int i = whole(0, 3); i > 0; --i) {
      SandRegion region = rectangle_of(place().head<2>(), {length(), length()},
                                       one_of({1.0, 20.0, 45.0, 89.0}), one_of({0.0, 0.0, 1e-9, 0.01, 1.0}));
      region.shape = one_of({RegionShape::rectangle, RegionShape::circle, RegionShape::polygon});
      region.radius = length();
      for (int k = 0; k < 3; ++k) region.points.push_back(anywhere().head<2>());
      ground.regions.push_back(region);
    }
  }

  void draw_stroke() {
    ToolSettings& tool = scene.tool;
    const bool any_shape = scene.displacement.deposit == Deposit::outward && chance(0.5);
    if (any_shape)
      tool.shape = one_of({ToolShape::cylinder, ToolShape::cone, ToolShape::box, ToolShape::plate});
    tool.radius = real(4.0, 9.0) * size_;
    tool.size = {real(4.0, 12.0) * size_, real(4.0, 12.0) * size_, 0.02};
    tool.width = real(5.0, 14.0) * size_;
    tool.thickness = real(4.0, 6.0) * size_;
    if (chance(0.3)) tool.solid = !tool.solid;
    tool.orientation.z() = any_shape ? real(-180.0, 180.0) : 0.0;
    scene.force.law = one_of({ForceLaw::paper, ForceLaw::rft, ForceLaw::archimedes});
    DeviceSettings& device = scene.device;
    device.model = one_of({DeviceModel::kinematic, DeviceModel::dynamic});
    device.max_force = one_of({0.0, 12.0, 1e-6});
    device.delay = device.model == DeviceModel::dynamic ? one_of({0, 0, 1, 5}) : 0;
    // Up to the bound of passivity.
    const double most = passivity_margin(0.0, 0.0, device) * device.servo_rate / (0.5 + device.delay);
    scene.ground.stiffness = one_of({0.0, 1e-9, 0.5, 0.999, 1.001}) * most;
    scene.stroke.emplace().file = "in memory";
    scene.output.trace = false;
    stroke.emplace();
    Eigen::Vector3d at = inner_place();
    double time = 0.0;
    for (int i = whole(2, 8); i > 0; --i) {
      stroke->time.push_back(time);
      stroke->position.push_back(at);
      time += one_of({0.001, 0.01, 0.05});
      if (chance(0.8)) at = inner_place();
    }
    stroke->gap_threshold = 1.0;
    if (any_shape && chance(0.4)) draw_load();
  }

  void draw_load() {
    ToolSettings& tool = scene.tool;
    tool.carries = true;
    tool.shape = one_of({tool.shape, ToolShape::shovel, ToolShape::bowl});
    tool.height = 0.02;
    tool.thickness = real(1.6, 3.5) * size_;
    const double most = one_of({0.0, 10.0, 40.0, 80.0});  // deg, of tilt
    for (std::size_t i = 0; i < stroke->time.size(); ++i) {
      const Eigen::Vector3d axis(real(-1.0, 1.0), real(-1.0, 1.0), 0.0);
      const Eigen::Quaterniond tilt(
          Eigen::AngleAxisd(to_radians(real(0.0, most)), (axis + Eigen::Vector3d(0.01, 0, 0)).normalized()));
      stroke->orientation.push_back(tilt.coeffs());
    }
  }

  void draw_sources() {
    for (int i = whole(1, 3); i > 0; --i) {
      SourceSettings& source = scene.sources.emplace_back();
      source.at = inner_place();
      source.at.z() = one_of({-1.0, -0.01, 0.0, 0.03, 0.1});
      source.rate = one_of({1e-300, 1e-6, 0.05, 0.5, 10.0}) * one_of({-1.0, 1.0, 1.0});
      source.radius = one_of({0.0, 1e-9, 0.003, 0.02, 10.0});
      source.start = one_of({0.0, 0.0, 0.05});
      source.stop = source.start + one_of({1e-9, 0.001, 0.1, 0.2});
    }
  }

  void draw_moisture() {
    MoistureSettings& moisture = scene.moisture.emplace();
    moisture.cohesion = one_of({0.0, 1e-6, 1.0, 20.0, 150.0, 600.0, 5000.0});
    moisture.friction_angle = one_of({0.0, 5.0, 33.0, 60.0});
    moisture.surface = one_of({SlipSurface::spiral, SlipSurface::plane});
    moisture.heals = chance(0.7);
    moisture.dries = scene.only_relaxes() ? 0.0 : one_of({0.0, 0.0, 100.0, 1e9});
    for (SandRegion& region : scene.ground.regions)
      if (chance(0.3)) region.cohesion = one_of({0.0, 150.0, 5000.0});
    if (scene.relaxation.law == RelaxationLaw::paper) scene.relaxation.law = RelaxationLaw::isotropic;
  }

  static double top_of(const StoneSettings& stone) {
    return stone.centre.z() + (stone.shape == StoneShape::sphere ? stone.radius : 0.5 * stone.size.z());
  }
  Eigen::Vector3d anywhere() {
    return {real(-0.5, 0.5) * scene.bed.width, real(-0.5, 0.5) * scene.bed.depth, real(-12.0, 6.0) * size_};
  }
  /// Anywhere, on the border of a cell, or in the middle; seldom beyond the bed.
  Eigen::Vector3d place() {
    const Eigen::Vector3d any = anywhere();
    if (chance(0.2)) return {0.0, 0.0, 0.0};
    if (chance(0.3)) return (any / size_).array().round().matrix() * size_;
    return chance(0.02) ? Eigen::Vector3d(10.0 * any) : any;
  }
  Eigen::Vector3d inner_place() { return {0.4 * anywhere().x(), 0.4 * anywhere().y(), real(-0.03, 0.01)}; }
  double length() { return one_of({1e-9, 0.3 * size_, size_, 3.0 * size_, 10.0 * size_, 30.0 * size_, 2.0}); }

  int whole(int low, int high) { return std::uniform_int_distribution<int>(low, high)(random_); }
  double real(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random_); }
  bool chance(double part) { return real(0.0, 1.0) < part; }
  template <class Value>
  Value one_of(std::initializer_list<Value> values) {
    return values.begin()[whole(0, static_cast<int>(values.size()) - 1)];
  }

  static constexpr double size_ = 0.002;  // m, of a cell
  std::mt19937 random_;
};

}  // namespace

void stress_any_ground(StressReport& report, const StressOptions& options) {
  const unsigned scenes = options.quick ? 20 : 400;
  Variations all("grounds", "any ground, sources, tool and device",
                 fmt::format("{} scenes at random, of up to 140 x 80 cells; at most 500 passes", scenes),
                 {Verdict::stable, Verdict::not_converged, Verdict::refused});
  for (unsigned seed = 1; seed <= scenes; ++seed) {
    const AnyScene any(seed);
    all.add(judged_on_threads(any.scene, starting_bed(any.scene.bed), any.stroke),
            fmt::format("seed {}, {}", seed, any.words()));
    options.progress(static_cast<double>(seed) / scenes);
  }
  report.cases.push_back(all.done());
}

}  // namespace sandstroke
