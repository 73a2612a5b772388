// Coarser beds within a relaxation (`multilevel`): their time, and how far the sand comes to rest from where
// `rkl` alone brings it.
#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include "bench/end_to_end.h"
#include "core/stopwatch.h"
#include "sand/relaxation.h"

namespace sandstroke {
namespace {

/// A height over [0, 1]^2, in sides of the bed.
using Shape = double (*)(double x, double y);

double cylinder(double x, double y, double centre_x, double centre_y, double radius, double height) {
  return std::hypot(x - centre_x, y - centre_y) < radius ? height : 0.0;
}
double pile(double x, double y) { return cylinder(x, y, 0.5, 0.5, 60.0 / 512, 80.0 / 512); }
double two_cylinders(double x, double y) {
  return cylinder(x, y, 0.36, 0.45, 45.0 / 512, 70.0 / 512) +
         cylinder(x, y, 0.62, 0.58, 30.0 / 512, 90.0 / 512);
}
double l_block(double x, double y) {
  const bool upright = x > 0.3 && x < 0.45 && y > 0.3 && y < 0.7;
  const bool foot = x > 0.3 && x < 0.7 && y > 0.3 && y < 0.42;
  return upright || foot ? 60.0 / 512 : 0.0;
}
double wavy_slope(double x, double y) {
  return 0.4 * (0.8 * x + 0.6 * y) + 6.0 / 512 * std::sin(25.6 * x) * std::sin(18.9 * y) +
         cylinder(x, y, 0.55, 0.5, 50.0 / 512, 70.0 / 512);
}
/// Waves of 30 to 230 of 512 cells, with slopes of up to three times the talus slope.
double hills(double x, double y) {
  struct Wave {
    double kx, ky, phase, height;
  };
  static const std::vector<Wave> waves = [] {
    std::vector<Wave> all;
    std::mt19937 random(777);
    const auto unit = [&] { return static_cast<double>(random()) / 0x1p32; };
    for (int i = 0; i < 24; ++i) {
      const double length = (30.0 + 200.0 * unit()) / 512.0, angle = 2.0 * std::numbers::pi * unit();
      const double k = 2.0 * std::numbers::pi / length;
      all.push_back(
          {k * std::cos(angle), k * std::sin(angle), 2.0 * std::numbers::pi * unit(), 0.05 * length});
    }
    return all;
  }();
  double height = 0.0;
  for (const Wave& wave : waves) height += wave.height * std::sin(wave.kx * x + wave.ky * y + wave.phase);
  return height;
}

/// Means over 4 x 4 points of each cell.
HeightField bed_of(Shape shape, int n) {
  HeightGrid heights(n, n);
  for (int row = 0; row < n; ++row)
    for (int col = 0; col < n; ++col) {
      double sum = 0.0;
      for (int i = 0; i < 16; ++i) sum += shape((col + (i % 4 + 0.5) / 4) / n, (row + (i / 4 + 0.5) / 4) / n);
      heights(row, col) = n * sum / 16;
    }
  return HeightField(heights, 1.0);
}

struct Relaxed {
  HeightField bed;
  RelaxationOutcome outcome;
  double cpu;
};
Relaxed relax(const HeightField& start, RelaxationLaw law, RelaxationMethod method) {
  RelaxationSettings settings;
  settings.law = law;
  settings.method = method;
  Relaxed relaxed{start, {}, 0.0};
  const double begin = processor_seconds();
  relaxed.outcome = make_relaxer(settings, 1.0)->relax(relaxed.bed);
  relaxed.cpu = processor_seconds() - begin;
  return relaxed;
}

}  // namespace

nlohmann::json measure_levels(const BenchOptions& options) {
  struct Problem {
    const char* name;
    Shape shape;
    int cells;
  };
  const int n = options.quick ? 256 : 512;
  std::vector<Problem> problems = {{"two cylinders", two_cylinders, n},
                                   {"L-block", l_block, n},
                                   {"wavy slope", wavy_slope, n},
                                   {"hills", hills, n}};
  for (const int cells : options.quick ? std::vector{256} : std::vector{512, 1024, 2048, 4096})
    problems.push_back({"pile", pile, cells});
  nlohmann::json rows = nlohmann::json::array();
  for (const Problem& problem : problems)
    for (const RelaxationLaw law : {RelaxationLaw::isotropic, RelaxationLaw::faces}) {
      if (problem.cells > 2048 && law == RelaxationLaw::faces) continue;  // minutes
      const HeightField start = bed_of(problem.shape, problem.cells);
      const Relaxed rkl = relax(start, law, RelaxationMethod::rkl),
                    levels = relax(start, law, RelaxationMethod::multilevel);
      const HeightGrid end = rkl.bed.grid();
      rows.push_back(
          {{"bed", problem.name},
           {"cells", problem.cells},
           {"law", relaxation_law_names[static_cast<int>(law)]},
           {"rkl", {{"passes", rkl.outcome.passes}, {"cpu_seconds", rkl.cpu}}},
           {"multilevel", {{"passes", levels.outcome.passes}, {"cpu_seconds", levels.cpu}}},
           {"rkl_over_multilevel", rkl.cpu / levels.cpu},
           {"l1_to_rkl_over_moved", (levels.bed.grid() - end).abs().sum() / (end - start.grid()).abs().sum()},
           {"volume_drift", std::abs(levels.bed.volume() - start.volume()) / levels.outcome.moved_volume}});
    }
  return {{"rows", rows}};
}

}  // namespace sandstroke
