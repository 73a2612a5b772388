// Sand that relaxes until it rests, against exact shapes.
#include <spdlog/fmt/fmt.h>

#include <cmath>
#include <memory>

#include "sand/initial_surface.h"
#include "validation/study/error_checks.h"
#include "validation/study/problem.h"
#include "validation/study/shape_score.h"

namespace sandstroke {
namespace {

const double talus_angle = RelaxationSettings{}.talus_angle;  // deg
constexpr double pile_bed_width = 2.0;                        // m
constexpr int band_rows = 64;                                 // for shapes that do not change along y

/// Relaxes a bed and returns how that went.
using Relaxing = std::function<RelaxationOutcome(HeightField&)>;

struct Pile {
  std::function<HeightField(int cells)> start;
  Shape shape;
  SurfaceSettings surface;  // the rule that made `start`; kind file: no rule
};

Trial collapse(const Pile& pile, int cells, const Relaxing& relax) {
  return relaxed_trial(pile.start(cells), pile.shape, relax);
}

/// over_cells: its points differ in the cell size alone, so they show an order of convergence.
enum class PileCurve { over_cells, other };

/// The contenders of one pile.
class PileField {
 public:
  PileField(Problem& problem, Pile pile, const ProblemOptions& options)
      : problem_(problem), pile_(std::make_shared<const Pile>(std::move(pile))), options_(options) {}

  void add(const std::string& series, const std::string& label, int cells, const RelaxationSettings& settings,
           int threads, PileCurve curve) {
    const HeightField bed = pile_->start(cells);
    Contender contender{series, label, settings_of(settings, bed, threads),
                        curve == PileCurve::over_cells ? bed.cell_size() : not_applicable, nullptr};
    contender.run = [pile = pile_, cells, settings] {
      return collapse(*pile, cells, [&](HeightField& sand) {
        return make_relaxer(settings, sand.cell_size())->relax(sand);
      });
    };
    problem_.contenders.push_back(std::move(contender));
  }

  /// Adds a curve over the cell size. (The bench leaves out runs that take too long.)
  void add_sizes(const std::string& series, const RelaxationSettings& settings) {
    for (int cells = 64; cells <= most_cells(); cells *= 2)
      add(series, fmt::format("{} cells", cells), cells, settings, options_.threads, PileCurve::over_cells);
  }

  void add_peers() {
    for (const Peer& peer : options_.peers)
      for (int cells = 64; cells <= most_cells(); cells *= 2) {
        Contender contender{peer.name, fmt::format("{} cells", cells), {}, pile_bed_width / cells, nullptr};
        contender.settings.method = "peer";
        contender.external = true;
        contender.settings.cells = cells;
        contender.settings.cell_size = pile_bed_width / cells;
        contender.run = [pile = pile_, cells, relax = peer.relax] {
          return collapse(*pile, cells, [&](HeightField& sand) { return relax(sand, talus_angle); });
        };
        problem_.contenders.push_back(std::move(contender));
      }
  }

  /// Adds the curves that all piles have.
  void add_laws_and_methods() {
    const RelaxationSettings super{.law = RelaxationLaw::isotropic, .method = RelaxationMethod::rkl};
    add_sizes("isotropic rkl", super);
    RelaxationSettings close = super;
    close.tolerance = 1e-4;
    add_sizes("isotropic rkl, tolerance 1e-4", close);
    add_sizes("isotropic passes", {.law = RelaxationLaw::isotropic, .method = RelaxationMethod::passes});
    add_sizes("isotropic plain", {.law = RelaxationLaw::isotropic, .method = RelaxationMethod::plain});
    add_sizes("paper passes", {.law = RelaxationLaw::paper, .method = RelaxationMethod::passes});
    add_sizes("paper rkl", {.law = RelaxationLaw::paper, .method = RelaxationMethod::rkl});
    add_peers();
    add_error_checks();
  }

  /// Adds runs that estimate their own error.
  void add_error_checks() {
    Scene scene;
    scene.preset = ModelPreset::accurate;
    apply_model_preset(scene);
    scene.bed.cols = options_.quick ? 128 : 256;
    const HeightField start = pile_->start(scene.bed.cols);
    scene.bed.rows = start.rows();
    scene.bed.width = pile_bed_width;
    scene.bed.depth = start.rows() * start.cell_size();
    scene.bed.surface = pile_->surface;
    problem_.check_errors = [=, pile = pile_] {
      return check_errors(
          fmt::format("{} cells", scene.bed.cols), scene, start, {},
          [&](const HeightField& surface, const auto&) {
            return TrueError{.height_share = surface_error(surface, start, pile->shape.exact).l1};
          });
    };
  }

  /// Adds curves over the other settings, one at a time.
  void add_knobs() {
    const int cells = options_.quick ? 128 : 512;
    const RelaxationSettings super{.law = RelaxationLaw::isotropic, .method = RelaxationMethod::rkl};
    for (const double step_tolerance : {10.0, 3.0, 1.0, 0.3, 0.1, 0.03, 0.01, 0.003}) {
      RelaxationSettings settings = super;
      settings.step_tolerance = step_tolerance;
      add("step tolerance", fmt::format("step tolerance {}, {} cells", step_tolerance, cells), cells,
          settings, options_.threads, PileCurve::other);
    }
    for (const double tolerance : {1e-2, 3e-3, 1e-3, 3e-4, 1e-4, 1e-5}) {
      RelaxationSettings settings = super;
      settings.tolerance = tolerance;
      add("tolerance", fmt::format("tolerance {}, {} cells", tolerance, cells), cells, settings,
          options_.threads, PileCurve::other);
    }
    for (const double share : {0.25, 0.2, 0.1, 0.05}) {
      RelaxationSettings settings{.law = RelaxationLaw::isotropic, .method = RelaxationMethod::passes};
      settings.share = share;
      add("share of a pass", fmt::format("share {}, 128 cells", share), 128, settings, options_.threads,
          PileCurve::other);
    }
    for (const int threads : {1, 2})
      add("threads", fmt::format("{} thread{}, {} cells", threads, threads == 1 ? "" : "s", most_cells()),
          most_cells(), super, threads, PileCurve::other);
  }

 private:
  int most_cells() const { return options_.quick ? 256 : 1024; }

  Problem& problem_;
  std::shared_ptr<const Pile> pile_;
  const ProblemOptions& options_;
};

/// What users ask of relaxation: round heaps, against cones. (Along an axis all laws are exact.)
Problem heap_problem(const char* name, const char* title, const char* text) {
  Problem problem = shape_problem(name, title, text);
  problem.subject = "Heaps";
  return problem;
}

Pile heap(SurfaceKind kind, double radius, double height, const ExactCone& cone) {
  SurfaceSettings surface;
  surface.kind = kind;
  surface.radius = radius;
  surface.height = height;
  return {[surface](int cells) { return make_surface(surface, cells, cells, pile_bed_width / cells); },
          {cone, cone.top(), Flank{cone.slope, cone.plateau, cone.foot}},
          surface};
}

}  // namespace

Problem cylinder_problem(const ProblemOptions& options) {
  // The pile that peers are measured with (R = 60, H = 80 cells on 512 x 512).
  const double radius = 60.0 / 512.0 * pile_bed_width, height = 80.0 / 512.0 * pile_bed_width;
  Problem problem = heap_problem("cylinder", "Cylinder to cone",
                                 "A cylinder collapses on a flat bed; the truth is the talus cone of its "
                                 "volume.");
  PileField field(
      problem, heap(SurfaceKind::cylinder, radius, height, collapsed_cylinder(radius, height, talus_angle)),
      options);
  field.add_laws_and_methods();
  field.add_knobs();
  return problem;
}

Problem truncated_problem(const ProblemOptions& options) {
  const double radius = 0.5, height = 0.2;
  Problem problem = heap_problem("truncated", "Low cylinder to truncated cone",
                                 "A low cylinder loses its edge; the truth is the truncated talus cone of "
                                 "its volume, whose plateau is untouched.");
  PileField(problem,
            heap(SurfaceKind::cylinder, radius, height, collapsed_cylinder(radius, height, talus_angle)),
            options)
      .add_laws_and_methods();
  return problem;
}

Problem cone_problem(const ProblemOptions& options) {
  const double radius = 0.5, height = 0.6;
  Problem problem = heap_problem("cone", "Steep cone to talus cone",
                                 "A cone of 50 degrees relaxes; the truth is the talus cone of its volume.");
  PileField(problem, heap(SurfaceKind::cone, radius, height, collapsed_cone(radius, height, talus_angle)),
            options)
      .add_laws_and_methods();
  return problem;
}

Problem cliff_problem(const ProblemOptions& options) {
  SurfaceSettings cliff;
  cliff.kind = SurfaceKind::cliff;
  cliff.height = 0.4;
  Problem problem =
      shape_problem("cliff", "Cliff to ramp",
                    "A vertical cliff relaxes; the truth is a ramp of the talus angle centred on its edge. "
                    "Along an axis both laws are exact: only the tolerance is left.");
  Pile pile;
  pile.start = [cliff](int cells) { return make_surface(cliff, band_rows, cells, pile_bed_width / cells); };
  pile.shape.exact = collapsed_cliff(cliff.height, talus_angle);
  pile.shape.height = cliff.height;
  pile.surface = cliff;
  PileField(problem, pile, options).add_laws_and_methods();
  return problem;
}

Problem trench_problem(const ProblemOptions& options) {
  const double half_width = 0.125, depth = 0.3;  // m; whole cells from 64 on
  const ExactTrench exact = filled_slot(half_width, depth, talus_angle);
  Problem problem = shape_problem("trench", "Slot to V",
                                  "A slot with vertical walls fills from both sides; the truth is the V of "
                                  "its area. Both laws are exact along an axis: the tolerance is all that is "
                                  "left.");
  const auto start = [=](int cells) {
    HeightField bed(band_rows, cells, pile_bed_width / cells);
    for (int row = 0; row < band_rows; ++row)
      for (int col = 0; col < cells; ++col)
        if (std::abs(bed.x_of(col)) < half_width) bed.set(row, col, -depth);
    return bed;
  };
  SurfaceSettings cell_by_cell;
  cell_by_cell.kind = SurfaceKind::file;
  cell_by_cell.file = "in memory";
  PileField(problem, {start, {exact, exact.depth(), {}}, cell_by_cell}, options).add_laws_and_methods();
  return problem;
}

}  // namespace sandstroke
