// Beds that no user would draw. Relaxation ends, keeps the volume and the range of heights, or is refused
// with an error sentence.
#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <random>

#include "validation/stress/judged_run.h"
#include "validation/stress/stress.h"

namespace sandstroke {
namespace {

enum class BedKind { checkerboard, spike, pit, step, wall, terraces, noise, ties };
constexpr BedKind bed_kinds[] = {BedKind::checkerboard, BedKind::spike,    BedKind::pit,   BedKind::step,
                                 BedKind::wall,         BedKind::terraces, BedKind::noise, BedKind::ties};

const char* name_of(BedKind kind) {
  constexpr const char* names[] = {"checkerboard", "spike",    "pit",   "step",
                                   "wall",         "terraces", "noise", "ties"};
  return names[static_cast<int>(kind)];
}

/// Counts of cells, and their size [m].
struct BedSize {
  int rows, cols;
  double dx;
};

HeightField make_bed(BedKind kind, const BedSize& size, double height, double talus_angle) {
  HeightGrid heights = HeightGrid::Zero(size.rows, size.cols);
  std::mt19937 random(7);
  const auto any = [&random] { return static_cast<double>(random()) / 2147483647.5 - 1.0; };
  const double rise = size.dx * talus_slope(talus_angle);
  for (int row = 0; row < size.rows; ++row)
    for (int col = 0; col < size.cols; ++col) {
      const bool centre = row == size.rows / 2 && col == size.cols / 2;
      double& h = heights(row, col);
      switch (kind) {
        case BedKind::checkerboard:
          h = (row + col) % 2 ? height : -height;
          break;
        case BedKind::spike:
          h = centre ? height : 0.0;
          break;
        case BedKind::pit:
          h = centre ? -height : 0.0;
          break;
        case BedKind::step:
          h = col < size.cols / 2 ? height : 0.0;
          break;
        case BedKind::wall:  // heaped along two walls of the bed
          h = row == 0 || col == size.cols - 1 ? height : 0.0;
          break;
        case BedKind::terraces:  // plateaus, 5 cells wide
          h = height * ((row / 5 * 3 + col / 5 * 7) % 4);
          break;
        case BedKind::noise:
          h = height * any();
          break;
        case BedKind::ties:  // every cell exactly at the talus angle, with a crest
          h = std::min(col, size.cols - col) * rise;
          break;
      }
    }
  return {heights, size.dx};
}

struct Method {
  std::string name;
  RelaxationLaw law;
  RelaxationMethod method;
  PluginLawSettings plugin_laws = {};
};

/// The program's methods of relaxation, or those of a plugin.
std::vector<Method> methods_of(const StressOptions& options) {
  if (options.plugin_laws.empty())
    return {{"paper, passes", RelaxationLaw::paper, RelaxationMethod::passes},
            {"paper, rkl", RelaxationLaw::paper, RelaxationMethod::rkl},
            {"isotropic, passes", RelaxationLaw::isotropic, RelaxationMethod::passes},
            {"isotropic, rkl", RelaxationLaw::isotropic, RelaxationMethod::rkl},
            {"faces, passes", RelaxationLaw::faces, RelaxationMethod::passes},
            {"faces, rkl", RelaxationLaw::faces, RelaxationMethod::rkl}};
  std::vector<Method> methods;
  for (const PluginLawSettings& plugin_laws : options.plugin_laws)
    if (!plugin_laws.relaxation.empty())
      methods.push_back(
          {"plugin: " + plugin_laws.relaxation, RelaxationLaw::paper, RelaxationMethod::passes, plugin_laws});
  return methods;
}

Scene scene_of(const BedSize& size, const Method& method) {
  Scene scene;
  scene.bed.cols = size.cols;
  scene.bed.rows = size.rows;
  scene.bed.width = size.cols * size.dx;
  scene.bed.depth = size.rows * size.dx;
  scene.relaxation.law = method.law;
  scene.relaxation.method = method.method;
  scene.plugin_laws = method.plugin_laws;
  return scene;
}

Variations variations(std::string name, std::string settings, std::vector<Verdict> expected) {
  return {"relaxation", std::move(name), std::move(settings), std::move(expected)};
}

/// Relaxes one kind of bed at one talus angle, in many sizes. Heights go up to `most` cells; towers() goes
/// beyond.
StressCase beds(const Method& method, BedKind kind, double talus_angle, bool quick) {
  using Values = std::vector<double>;
  const Values heights =
      quick ? Values{1e-310, 1e-12, 1e-4, 1e4} : Values{5e-324, 1e-310, 1e-12, 1e-6, 1e-3, 1.0, 1e3, 1e6};
  const Values cell_sizes = quick ? Values{1e-6, 1e3} : Values{1e-6, 1e-3, 1.0, 1e3};
  const double most = quick ? 100.0 : 1000.0;
  const bool few_cells =
      quick && !method.plugin_laws.relaxation.empty();  // a plugin law may visit all, slowly
  Variations all = variations(
      fmt::format("{}, {}, talus {}", method.name, name_of(kind), talus_angle),
      fmt::format("talus angle {} deg; cells of 1e-6 to 1e3 m; heights from {} m to {} cells; 1 x 1, "
                  "1 x 50, 33 x 31 and 66 x 66 cells",
                  talus_angle, heights.front(), most),
      {Verdict::stable});
  for (const double dx : cell_sizes)
    for (const double height : heights)
      for (const auto& [rows, cols] :
           {std::pair(1, 1), std::pair(1, 50), std::pair(33, 31), std::pair(66, 66)}) {
        if (height > most * dx || (rows == 66 && few_cells)) continue;
        const BedSize size{rows, cols, dx};
        Scene scene = scene_of(size, method);
        scene.relaxation.talus_angle = talus_angle;
        all.add(judged_run(scene, make_bed(kind, size, height, talus_angle)),
                fmt::format("cells of {} m, height {} m, {} x {}", dx, height, rows, cols));
      }
  return all.done();
}

/// Relaxes beds higher than the bed has room for, and so high that doubles no longer resolve a talus drop.
/// They end with the allowed passes, or when the flow falls below rounding.
StressCase towers(const Method& method, bool quick) {
  const int passes = quick ? 100 : 2000;
  Variations all = variations(fmt::format("{}, towers", method.name),
                              fmt::format("heights of 1e4 to 1e100 cells; at most {} passes", passes),
                              {Verdict::stable, Verdict::not_converged});
  for (const BedKind kind : bed_kinds)
    for (const double dx : {1e-6, 1.0})
      for (const double height : {1e4, 1e9, 1e100}) {
        const BedSize size{40, 50, dx};
        Scene scene = scene_of(size, method);
        scene.relaxation.max_passes = passes;
        all.add(judged_run(scene, make_bed(kind, size, height * dx, 30.0)),
                fmt::format("{}, cells of {} m, {} of them high", name_of(kind), dx, height));
      }
  return all.done();
}

/// Relaxes beds with one share of a pass. The laws `isotropic` and `faces` are monotone up to a share of 1/4,
/// and refused beyond (also with rkl, which takes c from the share). The paper's law is monotone at no share,
/// even its own 1/2: a pit takes sand from 8 sides. But a cell gives no more than its steepest excess, so
/// sand heaped too high falls back onto all 8 in the next pass. The bed comes to rest at any share up to 1,
/// in fewer passes (as in 360,000 runs on 60,000 random beds of up to 9 x 12 cells).
StressCase shares(const Method& method, double share, bool quick) {
  const double most = quick ? 50.0 : 500.0;
  const bool refused = method.law != RelaxationLaw::paper && share > 0.25;
  Variations all = variations(fmt::format("{}, share {}", method.name, share),
                              fmt::format("relaxation.share {}; heights of 10 and {} cells", share, most),
                              {refused ? Verdict::refused : Verdict::stable});
  for (const BedKind kind : bed_kinds)
    for (const double height : {10.0, most}) {
      const BedSize size{40, 50, 0.002};
      Scene scene = scene_of(size, method);
      scene.relaxation.share = share;
      all.add(judged_run(scene, make_bed(kind, size, height * size.dx, 30.0)),
              fmt::format("{}, {} cells high", name_of(kind), height));
    }
  return all.done();
}

/// Relaxes beds whose numbers no double can hold.
StressCase beyond_numbers(const Method& method) {
  Variations all = variations(fmt::format("{}, out of a double's range", method.name),
                              "cells of 1e-307, 1e-160 and 1e110 m; heights of 1e307 m; at most 100 passes",
                              {Verdict::refused});
  for (const auto& [dx, height] : {std::pair(1e-307, 1e-306), std::pair(1e-160, 1e-159),
                                   std::pair(1e110, 1e111), std::pair(1.0, 1e307)}) {
    const BedSize size{40, 50, dx};
    Scene scene = scene_of(size, method);
    scene.relaxation.max_passes = 100;
    all.add(judged_run(scene, make_bed(BedKind::step, size, height, 30.0)),
            fmt::format("cells of {} m, height {} m", dx, height));
  }
  return all.done();
}

}  // namespace

void stress_relaxation(StressReport& report, const StressOptions& options) {
  using Values = std::vector<double>;
  const Values talus_angles =
      options.quick ? Values{1.0, 30.0, 89.0} : Values{1.0, 5.0, 15.0, 30.0, 45.0, 60.0, 75.0, 85.0, 89.0};
  const Values shares_tried = options.quick ? Values{0.1, 0.25, 0.251, 0.6, 1.0}
                                            : Values{0.01, 0.1, 0.25, 0.251, 0.5, 0.6, 0.75, 0.9, 1.0};
  double done = 0.0;
  const auto add = [&](const StressCase& one) { report.cases.push_back(one); };
  const std::vector<Method> methods = methods_of(options);
  for (const Method& method : methods) {
    for (const double talus_angle : talus_angles) {
      for (const BedKind kind : bed_kinds) add(beds(method, kind, talus_angle, options.quick));
      options.progress(done += 0.8 / static_cast<double>(methods.size() * talus_angles.size()));
    }
    if (method.plugin_laws.relaxation.empty())
      for (const double share : shares_tried) add(shares(method, share, options.quick));
    add(towers(method, options.quick));
    add(beyond_numbers(method));
    options.progress(done += 0.2 / static_cast<double>(methods.size()));
  }
}

}  // namespace sandstroke
