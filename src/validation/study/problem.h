#pragma once

#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "sim/run_result.h"
#include "sim/scene.h"

namespace sandstroke {

/// The value in columns that do not apply to a run.
inline constexpr double not_applicable = std::numeric_limits<double>::quiet_NaN();

/// The settings of one run.
struct RunSettings {
  std::string law, method;
  double cells = not_applicable;            ///< along x
  double cell_size = not_applicable;        ///< m
  double tolerance = not_applicable;        ///< of relaxation
  double step_tolerance = not_applicable;   ///< of super steps
  double share = not_applicable;            ///< c, fraction of the excess that a pass moves
  double servo_rate = not_applicable;       ///< Hz
  double relaxation_rate = not_applicable;  ///< Hz
  double threads = 1;
  std::string tool = {}, force_law = {};  ///< set where a problem compares them
};

/// The work of one run, and how far it is from the truth.
struct Score {
  double passes = not_applicable;
  double cells_visited = not_applicable;
  double l1 = not_applicable;              ///< surface_error.h
  double rms_height = not_applicable;      ///< m
  double largest_height = not_applicable;  ///< m
  double rms_relative = not_applicable;    ///< fraction of the exact shape's height
  double largest_relative = not_applicable;
  double slope_error = not_applicable;       ///< deg, the largest of all directions
  double volume_error = not_applicable;      ///< relative, of the sand that stays
  double cut_error = not_applicable;         ///< relative, of the height at which a cut fails
  double work_error = not_applicable;        ///< relative
  double force_error = not_applicable;       ///< rms over the largest force
  double position_error = not_applicable;    ///< m, rms
  double volume_drift = not_applicable;      ///< fraction of the moved volume
  double displaced_volume = not_applicable;  ///< m^3, by the tool; counts the same sand each time
  double furrow_depth = not_applicable;      ///< m, the median (measure/furrow.h)
  double timed_ticks = not_applicable;       ///< how many ticks the run's time covers
  bool converged = true;
  std::vector<double> slope_errors = {};  ///< deg, by flank_directions(); may be empty
};

struct Trial {
  double seconds = 0.0;  ///< time of the work itself, without setting up and judging
  Score score;
};

/// One way to solve a problem: a point on a curve.
struct Contender {
  std::string series;  ///< the curve
  std::string label;   ///< the position on the curve, in words
  RunSettings settings;
  double step = not_applicable;  ///< what the series refines (cell size [m] or time step [s]), for its order
  std::function<Trial()> run;    ///< gives the same score each time
  bool external = false;         ///< from outside this library: if it fails, the others go on
};

/// A run's estimate of its own error (measure/error_estimate.h), beside its true error.
struct ErrorCheck {
  std::string problem, label;
  std::string quantity;  ///< "height" (fraction of the changed sand) or "force" (rms, N)
  double estimate, truth;
};

/// A chart of a problem: curves over x.
struct Plot {
  enum class Look { line, dashed, points };
  struct Curve {
    std::string name;  ///< curves of one name have one colour
    Look look;
    std::vector<double> x, y;
  };
  std::string title, note;
  std::string x_title, x_unit, y_title;
  std::vector<Curve> curves;
  std::vector<std::pair<Look, std::string>> looks;  ///< the meaning of each look
};

/// A published measurement, beside the value by the program's law.
struct MeasuredFigure {
  std::string medium, what;
  double measured, model;
  std::string source;
};

/// A problem with a known answer.
struct Problem {
  std::string name, title;
  std::string text;         ///< one sentence: the problem, and how the truth is known
  std::string error;        ///< the column that counts as its error
  std::string error_title;  ///< what the column means here
  std::string error_unit;
  std::string subject = {};  ///< what users compute; its problems judge a setting together (advice.h)
  std::vector<Contender> contenders = {};  ///< within a series, the cheap ones first
  /// Makes runs that estimate their own error. Empty if `sandstroke run` cannot run the problem.
  std::function<std::vector<ErrorCheck>()> check_errors = {};
  double converged_to = not_applicable;  ///< distance of a computed reference from a coarser one, as `error`
  /// Errors below that of the reference say nothing; 0: it is exact.
  double least_error() const { return std::isnan(converged_to) ? 0.0 : converged_to; }
  /// Measures the time of a tick, beside that of the paper's law, and no error: no front, no order.
  bool times_ticks = false;
  std::vector<Plot> plots = {};
  std::string measured_text = {};
  std::vector<MeasuredFigure> measured = {};
};

/// A rule for relaxing sand from outside this library, to compare with.
struct Peer {
  std::string name;
  std::function<RelaxationOutcome(HeightField& bed, double talus_angle)> relax;  ///< talus angle in deg
};

struct ProblemOptions {
  bool quick = false;  ///< coarser grids, shorter strokes
  int threads = 1;
  std::vector<Peer> peers;
  /// A plugin's laws of displacement and force, each in its own settings. Their strokes and plunges are
  /// compared with the same in finer steps.
  std::vector<PluginLawSettings> plugin_laws;
};

/// Makes one problem, and computes its truth if no closed form gives it.
struct ProblemMaker {
  const char* name;
  Problem (*make)(const ProblemOptions& options);
};
/// All problems, in the order of the report.
const std::vector<ProblemMaker>& problem_makers();

// Sand that relaxes, against exact shapes (piles.cpp).
Problem cylinder_problem(const ProblemOptions& options);
Problem truncated_problem(const ProblemOptions& options);
Problem cone_problem(const ProblemOptions& options);
Problem cliff_problem(const ProblemOptions& options);
Problem trench_problem(const ProblemOptions& options);
// Sand that drains (crater.cpp).
Problem crater_problem(const ProblemOptions& options);
// Sand that is poured (pouring.cpp).
Problem poured_problem(const ProblemOptions& options);
// Sand on stones and of two kinds, against closed forms (ground_shapes.cpp).
Problem seam_problem(const ProblemOptions& options);
Problem ridge_problem(const ProblemOptions& options);
Problem disc_problem(const ProblemOptions& options);
Problem cap_problem(const ProblemOptions& options);
Problem cut_problem(const ProblemOptions& options);
Problem wall_problem(const ProblemOptions& options);
// Sand that a tool lifts, against closed forms (lifted_sand.cpp).
Problem lift_problem(const ProblemOptions& options);
// The device's work, against closed forms (contact.cpp).
Problem plunge_problem(const ProblemOptions& options);
Problem drag_problem(const ProblemOptions& options);
// Tools of any shape, against closed forms and the sphere (tool_shapes.cpp).
Problem blade_problem(const ProblemOptions& options);
Problem wedge_problem(const ProblemOptions& options);
Problem mesh_problem(const ProblemOptions& options);
// The contact force, against closed forms and the theory itself (contact_forces.cpp).
Problem plate_force_problem(const ProblemOptions& options);
Problem sphere_force_problem(const ProblemOptions& options);
// The sand that a tool feels, against the theory and Coulomb's wedge (felt_sand.cpp).
Problem leaning_problem(const ProblemOptions& options);
Problem pulled_problem(const ProblemOptions& options);
Problem heap_force_problem(const ProblemOptions& options);
// The time of a tick under each force law (tick_time.cpp).
Problem tick_problem(const ProblemOptions& options);
// The dynamic device against an almost continuous servo loop, and whole strokes against the same in finer
// steps (strokes.cpp).
Problem dynamic_problem(const ProblemOptions& options);
Problem accurate_stroke_problem(const ProblemOptions& options);
Problem deep_stroke_problem(const ProblemOptions& options);
Problem reworked_stroke_problem(const ProblemOptions& options);
Problem hands_problem(const ProblemOptions& options);
Problem paper_stroke_problem(const ProblemOptions& options);
// The presets against simulated grains (grains.cpp).
Problem grains_problem(const ProblemOptions& options);

RunSettings settings_of(const RelaxationSettings& relaxation, const BedGeometry& bed, int threads);
/// The same, and the rates of a stroke.
RunSettings settings_of(const Scene& scene, int threads);

/// Fills in the work of a stroke's run. The errors stay not_applicable.
Score score_of(const RunResult& result);

}  // namespace sandstroke
