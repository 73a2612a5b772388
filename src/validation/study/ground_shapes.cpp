// Sand that relaxes on stones, and sand of two kinds, against closed forms.
#include <spdlog/fmt/fmt.h>

#include <cmath>
#include <memory>
#include <utility>

#include "core/angle.h"
#include "sand/initial_surface.h"
#include "sand/make_ground.h"
#include "validation/study/shape_score.h"

namespace sandstroke {
namespace {

using enum RelaxationLaw;
using enum RelaxationMethod;

constexpr double gentle = 25.0, steep = 35.0, on_stone = 30.0;  // deg, talus angles

/// One size of a problem: its bed on a ground, and how the sand should lie in the end.
struct Laid {
  HeightField start;
  Shape shape;
};

/// The sizes [cells along x] of a problem's curves, the coarse ones first. Passes grow with their square.
struct Sizes {
  std::vector<int> all;
  int most_of_passes, most_if_quick;
};

/// Adds a curve over the sizes.
void add_curve(Problem& problem, const ProblemOptions& options, RelaxationLaw law, RelaxationMethod method,
               double tolerance, const Sizes& sizes, const std::function<Laid(int cells)>& lay) {
  for (const int cells : sizes.all) {
    if (cells > (options.quick ? sizes.most_if_quick : method == passes ? sizes.most_of_passes : cells))
      continue;
    RelaxationSettings settings{.law = law, .method = method};
    settings.tolerance = tolerance;
    const auto laid = std::make_shared<const Laid>(lay(cells));
    problem.contenders.push_back({fmt::format("{} {}", relaxation_law_names[static_cast<int>(law)],
                                              relaxation_method_names[static_cast<int>(method)]),
                                  fmt::format("{} cells", cells),
                                  settings_of(settings, laid->start, options.threads),
                                  laid->start.cell_size(), [laid, settings] {
                                    return relaxed_trial(laid->start, laid->shape, [&](HeightField& bed) {
                                      return make_relaxer(settings, bed.cell_size())->relax(bed);
                                    });
                                  }});
  }
}

/// Adds the curves of the laws whose rest is a cone. (The paper's is none: up to 32 degrees between the
/// axes.)
void add_round_curves(Problem& problem, const ProblemOptions& options, const Sizes& sizes,
                      const std::function<Laid(int cells)>& lay) {
  for (const RelaxationLaw law : {isotropic, faces})
    for (const RelaxationMethod method : {passes, rkl})
      add_curve(problem, options, law, method, 1e-4, sizes, lay);
}

/// A slope of 45 degrees along x, over a seam in a third of it: inside a cell at each size.
Laid lay_slope(int cells) {
  constexpr double length = 0.2, seam = -length / 6.0;  // m
  HeightField bed(1, cells, length / cells);
  GroundSettings ground;
  SandRegion& behind = ground.regions.emplace_back();
  behind.size = {length, length};
  behind.centre.x() = seam + 0.5 * length;
  behind.talus_angle = steep;
  bed.lie_on(make_ground(bed, ground, talus_slope(gentle)));
  const ExactSeam exact{talus_slope(gentle), talus_slope(steep), seam};
  const double width = bed.cell_size();
  double lift = 0.0;  // of the lines, so that the volume is the same
  for (int col = 0; col < cells; ++col) {
    bed.set(0, col, -bed.x_of(col));
    lift += (bed(0, col) - exact.mean(bed.x_of(col), width)) / cells;
  }
  return {std::move(bed),
          {[=](double x, double) { return exact.mean(x, width) + lift; }, length * exact.behind, {}}};
}

constexpr double seam_turn = 22.5;  // deg

/// A steep cone over a seam through its axis.
Laid lay_ridge(int cells) {
  constexpr double width = 0.2;
  SurfaceSettings cone;
  cone.kind = SurfaceKind::cone;
  cone.radius = 0.05;
  cone.height = 0.07;
  HeightField bed = make_surface(cone, cells, cells, width / cells);
  GroundSettings ground;
  SandRegion& behind = ground.regions.emplace_back();
  behind.shape = RegionShape::polygon;
  const Eigen::Vector2d across(std::cos(to_radians(seam_turn)), std::sin(to_radians(seam_turn))),
      along(-across.y(), across.x());
  behind.points = {-width * along, width * (across - along), width * (across + along), width * along};
  behind.talus_angle = steep;
  bed.lie_on(make_ground(bed, ground, talus_slope(gentle)));
  constexpr double low = 0.006, high = 0.02;  // m: not the foot, which is a cell wide, nor the blunt tip
  Shape shape;
  shape.flanks = {{seam_turn, steep, low, high}, {seam_turn + 180.0, gentle, low, high}};
  return {std::move(bed), shape};
}

/// Sand that is heaped too high on a round plinth.
Laid lay_on_disc(int cells) {
  constexpr double width = 0.12, radius = 0.05, plinth = 0.2;  // m
  const ExactCone cone{talus_slope(on_stone), 0.0, radius};
  HeightField bed(cells, cells, width / cells);
  const auto ground = std::make_shared<Ground>(bed, 0.0, cone.slope);
  for (int row = 0; row < cells; ++row)
    for (int col = 0; col < cells; ++col) {
      if (std::hypot(bed.x_of(col), bed.y_of(row)) >= radius) continue;
      ground->floor.set(row, col, plinth);
      bed.set(row, col, plinth + 1.1 * cone.top());
    }
  bed.lie_on(ground);
  return {std::move(bed),
          {.exact = [=](double x, double y) { return plinth + cone(x, y); },
           .height = cone.top(),
           .kept = KeptSand{radius, cone.volume()}}};
}

/// Sand that is heaped too high on top of a sphere.
Laid lay_on_sphere(int cells) {
  constexpr double width = 0.2, radius = 0.08, thickness = 0.02, height = 0.3;  // m
  const ExactCap cap{talus_slope(on_stone), radius};
  HeightField bed(cells, cells, width / cells);
  GroundSettings settings;
  settings.floor = 0.0;
  StoneSettings& stone = settings.stones.emplace_back();
  stone.radius = radius;
  stone.centre.z() = height;
  const std::shared_ptr<const Ground> ground = make_ground(bed, settings, cap.slope);
  for (int row = 0; row < cells; ++row)
    for (int col = 0; col < cells; ++col)
      if (std::hypot(bed.x_of(col), bed.y_of(row)) < cap.foot())
        bed.set(row, col, ground->floor(row, col) + thickness);
  bed.lie_on(ground);
  const auto exact = [=](double x, double y) {
    return height + std::sqrt(radius * radius - x * x - y * y) + cap(x, y);
  };
  return {std::move(bed),
          {.exact = exact, .height = cap.top() - radius, .kept = KeptSand{radius, cap.volume()}}};
}

Problem stone_problem(const char* name, const char* title, const char* text) {
  return {name, title, text, "volume_error", "sand that stays on the stone, relative error", "", {}};
}

}  // namespace

Problem seam_problem(const ProblemOptions& options) {
  Problem problem = shape_problem(
      "seam", "Slope over a seam",
      "A slope of 45 degrees relaxes over a seam of two sands, 25 and 35 degrees, that lies inside a cell; "
      "the truth is a straight line on each side, with the same volume.");
  for (const auto& [law, method] :
       {std::pair(paper, passes), std::pair(isotropic, passes), std::pair(faces, passes),
        std::pair(isotropic, rkl), std::pair(faces, rkl)})
    add_curve(problem, options, law, method, 1e-7, {{20, 40, 80, 160}, 160, 80}, lay_slope);
  return problem;
}

Problem ridge_problem(const ProblemOptions& options) {
  Problem problem{
      "ridge",
      "Heap over a turned seam",
      "A heap relaxes over a seam of two sands, 25 and 35 degrees, that is turned by 22.5 degrees; "
      "the truth is the slope of each flank, along the seam's normal.",
      "slope_error_largest",
      "slope error of the worse flank",
      "deg",
      {}};
  add_round_curves(problem, options, {{48, 64, 96, 128, 192}, 128, 96}, lay_ridge);
  return problem;
}

Problem disc_problem(const ProblemOptions& options) {
  Problem problem = stone_problem(
      "disc", "Sand on a disc",
      "Sand that is heaped too high on a round plinth runs over its rim; the truth is the volume "
      "of the talus cone on it, pi a^3 tan(talus) / 3.");
  add_round_curves(problem, options, {{24, 32, 48, 64, 96}, 64, 48}, lay_on_disc);
  return problem;
}

Problem cap_problem(const ProblemOptions& options) {
  Problem problem =
      stone_problem("cap", "Sand on a sphere",
                    "Sand runs off a sphere; the truth is the volume of what stays: a cone that touches the "
                    "sphere where it is as steep as the talus.");
  add_round_curves(problem, options, {{48, 64, 96, 128, 192}, 128, 96}, lay_on_sphere);
  return problem;
}

}  // namespace sandstroke
