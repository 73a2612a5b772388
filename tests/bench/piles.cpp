// Sand left to itself: how long it takes to rest, and how near it comes to the exact shape.
#include <cmath>

#include "bench/end_to_end.h"
#include "core/stopwatch.h"
#include "sand/initial_surface.h"
#include "sand/relaxation.h"
#include "validation/study/exact_shapes.h"

namespace sandstroke {
namespace {

struct Method {
  const char* name;
  RelaxationMethod method;
  double share = 0.0;  // 0: the law's own
  RelaxationLaw law = RelaxationLaw::isotropic;
};
constexpr Method passes{"passes", RelaxationMethod::passes};
constexpr Method rkl{"rkl", RelaxationMethod::rkl};

/// The reference for both: the same law in small steps.
Method small_steps(double share) { return {"small steps", RelaxationMethod::passes, share}; }

Method with_law(Method method, RelaxationLaw law) {
  method.law = law;
  return method;
}

/// Relaxes a bed and tells what that took.
nlohmann::json relax(HeightField& bed, const Method& method) {
  RelaxationSettings settings;
  settings.law = method.law;
  settings.method = method.method;
  settings.share = method.share;
  const auto relaxer = make_relaxer(settings, bed.cell_size());
  const double volume = bed.volume();
  const Stopwatch watch;
  const double cpu_begin = processor_seconds();
  const RelaxationOutcome outcome = relaxer->relax(bed);
  const double cpu = processor_seconds() - cpu_begin;
  const double seconds = watch.seconds();
  return {{"method", method.name},
          {"cells", bed.rows()},
          {"passes", outcome.passes},
          {"super_steps", outcome.super_steps},
          {"rejected_stages", outcome.rejected_stages},
          {"seconds", seconds},
          {"cpu_seconds", cpu},
          {"ns_per_cell_and_pass", 1e9 * cpu / static_cast<double>(outcome.cells_visited)},
          {"residual", outcome.residual},
          {"converged", outcome.converged},
          {"volume_drift", std::abs(bed.volume() - volume) / outcome.moved_volume}};
}

/// The peers' pile: a cylinder of R = 60 and H = 80 cells on 512 x 512, or the same with other cells. What it
/// becomes is a cone of the same volume; errors are over its apex.
struct Cone {
  nlohmann::json row;
  HeightField bed;
};
Cone cone(const Method& method, int n) {
  SurfaceSettings cylinder;
  cylinder.kind = SurfaceKind::cylinder;
  cylinder.radius = 60.0 / 512.0 * n;
  cylinder.height = 80.0 / 512.0 * n;
  HeightField bed = make_surface(cylinder, n, n, 1.0);
  nlohmann::json row = relax(bed, method);

  const ExactCone exact =
      collapsed_cylinder(cylinder.radius, cylinder.height, RelaxationSettings{}.talus_angle);
  const double apex = exact.top();
  double squares = 0.0, largest = 0.0;
  int cells_under_cone = 0;
  for (int r = 0; r < n; ++r)
    for (int c = 0; c < n; ++c) {
      const double height = exact(bed.x_of(c), bed.y_of(r)), error = std::abs(bed(r, c) - height);
      squares += error * error;
      largest = std::max(largest, error);
      cells_under_cone += height > 0.0;
    }
  row["rms_over_apex"] = std::sqrt(squares / n / n) / apex;  // of the whole bed
  row["rms_under_cone_over_apex"] = std::sqrt(squares / cells_under_cone) / apex;
  row["max_over_apex"] = largest / apex;
  row["apex"] = apex;
  return {row, bed};
}

}  // namespace

nlohmann::json measure_cones(const BenchOptions& options) {
  const int n = options.quick ? 128 : 512;
  nlohmann::json rows = nlohmann::json::array();
  const Cone plain = cone(passes, n), super = cone(rkl, n), limit = cone(small_steps(0.1), n);
  for (const Cone* one : {&plain, &super, &limit}) {
    rows.push_back(one->row);
    rows.back()["rms_to_small_steps_over_apex"] =
        std::sqrt((one->bed.grid() - limit.bed.grid()).square().mean()) / one->row["apex"].get<double>();
  }
  for (const int larger : {2 * n, 4 * n}) rows.push_back(cone(rkl, larger).row);
  const auto ratio = [&](const char* key) {
    return plain.row[key].get<double>() / super.row[key].get<double>();
  };
  return {{"rows", rows},
          {"passes_over_rkl", {{"passes", ratio("passes")}, {"cpu_seconds", ratio("cpu_seconds")}}}};
}

namespace {

/// Both methods on one bed: what they take, and how far each ends from the small steps of the same law, over
/// what these moved.
struct Comparison {
  nlohmann::json rows;
  double rkl_error, passes_ratio, cpu_ratio;
};
Comparison compare_methods(const HeightField& start, RelaxationLaw law) {
  HeightField plain = start, super = start, limit = start;
  nlohmann::json of_plain = relax(plain, with_law(passes, law)), of_super = relax(super, with_law(rkl, law));
  relax(limit, with_law(small_steps(0.02), law));
  const HeightGrid begin = start.grid(), end = limit.grid();
  const auto error = [&](const HeightField& bed) {
    return (bed.grid() - end).abs().sum() / (end - begin).abs().sum();
  };
  of_plain["l1_to_small_steps_over_moved"] = error(plain);
  of_super["l1_to_small_steps_over_moved"] = error(super);
  const auto ratio = [&](const char* key) {
    return of_plain[key].get<double>() / of_super[key].get<double>();
  };
  return {{of_plain, of_super}, error(super), ratio("passes"), ratio("cpu_seconds")};
}

HeightField rough_bed(int n, std::uint32_t seed) {
  SurfaceSettings noise;
  noise.kind = SurfaceKind::noise;
  noise.amplitude = 20.0;  // cells
  noise.wavelength = 0.0;
  noise.seed = seed;
  return make_surface(noise, n, n, 1.0);
}

}  // namespace

nlohmann::json measure_rough_beds(const BenchOptions& options) {
  nlohmann::json rows = nlohmann::json::array();
  double worst_error = 0.0, least_ratio = 1e300;
  std::vector<double> cpu_ratios;
  for (std::uint32_t seed = 1; seed <= 10; ++seed) {
    const Comparison one =
        compare_methods(rough_bed(options.quick ? 64 : 256, seed), RelaxationLaw::isotropic);
    rows.push_back({{"seed", seed}, {"rows", one.rows}});
    worst_error = std::max(worst_error, one.rkl_error);
    least_ratio = std::min(least_ratio, one.passes_ratio);
    cpu_ratios.push_back(one.cpu_ratio);
  }
  return {{"beds", rows},
          {"worst_rkl_error", worst_error},
          {"passes_over_rkl", {{"passes_least", least_ratio}, {"cpu_seconds_median", median(cpu_ratios)}}}};
}

/// Super steps were made for the isotropic law, a gradient flow. The paper's is none; here is what they do
/// for it.
nlohmann::json measure_paper_law(const BenchOptions& options) {
  const int n = options.quick ? 64 : 256;
  SurfaceSettings cylinder;
  cylinder.kind = SurfaceKind::cylinder;
  cylinder.radius = 60.0 / 512.0 * n;
  cylinder.height = 80.0 / 512.0 * n;
  const auto as_json = [](const Comparison& one) {
    return nlohmann::json{
        {"rows", one.rows},
        {"passes_over_rkl", {{"passes", one.passes_ratio}, {"cpu_seconds", one.cpu_ratio}}}};
  };
  return {{"cylinder", as_json(compare_methods(make_surface(cylinder, n, n, 1.0), RelaxationLaw::paper))},
          {"rough_bed", as_json(compare_methods(rough_bed(n, 1), RelaxationLaw::paper))}};
}

}  // namespace sandstroke
