#pragma once

#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "sim/run_result.h"
#include "sim/scene.h"

namespace sandstroke {

/// Stands where a column says nothing about a run.
inline constexpr double not_applicable = std::numeric_limits<double>::quiet_NaN();

/// The knobs of one run.
struct RunSettings {
  std::string law, method;
  double cells = not_applicable;            ///< along x
  double cell_size = not_applicable;        ///< m
  double tolerance = not_applicable;        ///< of the relaxation
  double step_tolerance = not_applicable;   ///< of super steps
  double share = not_applicable;            ///< c of a pass
  double servo_rate = not_applicable;       ///< Hz
  double relaxation_rate = not_applicable;  ///< Hz
  double threads = 1;
  std::string tool = {}, force_law = {};  ///< where a problem compares them
};

/// What one run took besides time, and how far it is from the truth.
struct Score {
  double passes = not_applicable;
  double cells_visited = not_applicable;
  double l1 = not_applicable;              ///< surface_error.h
  double rms_height = not_applicable;      ///< m
  double largest_height = not_applicable;  ///< m
  double rms_relative = not_applicable;    ///< of the exact shape's height
  double largest_relative = not_applicable;
  double slope_error = not_applicable;       ///< deg, the largest of all directions
  double work_error = not_applicable;        ///< relative
  double force_error = not_applicable;       ///< rms over the largest force
  double position_error = not_applicable;    ///< m, rms
  double volume_drift = not_applicable;      ///< of the moved volume
  double displaced_volume = not_applicable;  ///< m^3, pushed by the tool, the same sand again and again
  double furrow_depth = not_applicable;      ///< m, the median (sim/furrow.h)
  double timed_ticks = not_applicable;       ///< how many the run's time is that of
  bool converged = true;
  std::vector<double> slope_errors = {};  ///< deg, by flank_directions(); may be empty
};

struct Trial {
  double seconds = 0.0;  ///< of the work itself: neither setting up nor judging it
  Score score;
};

/// One way of solving a problem: a point on a curve.
struct Contender {
  std::string series;  ///< the curve
  std::string label;   ///< where on it, in words
  RunSettings settings;
  double step = not_applicable;  ///< what the series refines (cell size [m] or time step [s]), for its order
  std::function<Trial()> run;    ///< gives the same score each time
  bool foreign = false;          ///< not this library's: where it fails, the others go on
};

/// An error that a run states of itself (sim/error_estimate.h), beside its true one.
struct ErrorCheck {
  std::string problem, label;
  std::string quantity;  ///< "height" (share of the changed sand) or "force" (rms, N)
  double estimate, truth;
};

/// A chart that comes with a problem, of curves over x.
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
  std::vector<std::pair<Look, std::string>> looks;  ///< what they mean
};

/// What somebody measured, beside what the program's law says of it.
struct MeasuredFigure {
  std::string medium, what;
  double measured, model;
  std::string source;
};

/// A problem with a known answer.
struct Problem {
  std::string name, title;
  std::string text;         ///< one sentence: what, and how the truth is known
  std::string error;        ///< the column that counts as its error
  std::string error_title;  ///< what that is here
  std::string error_unit;
  std::vector<Contender> contenders;  ///< within a series, the cheap ones first
  /// What runs of it say of their own error; none where `sandstroke run` cannot run it.
  std::function<std::vector<ErrorCheck>()> check_errors = {};
  double converged_to = not_applicable;  ///< how far a computed reference is from a coarser one, as `error`
  /// What counts is no error but the time of a tick, beside that of the paper's law: no front, no order.
  bool times_ticks = false;
  std::vector<Plot> plots = {};
  std::string measured_text = {};
  std::vector<MeasuredFigure> measured = {};
};

/// A rule for relaxing sand that is not this library's, to stand beside it.
struct Peer {
  std::string name;
  std::function<RelaxationOutcome(HeightField& bed, double talus_angle)> relax;  ///< talus angle in deg
};

struct ProblemOptions {
  bool quick = false;  ///< coarser grids, shorter strokes
  int threads = 1;
  std::vector<Peer> peers;
  /// Rules of displacement and laws of force of a plugin, each in settings of its own: strokes and plunges
  /// with them are held against the same, finer.
  std::vector<OwnLawSettings> own;
};

/// Makes one problem; where the truth has to be computed, that happens here.
struct ProblemMaker {
  const char* name;
  Problem (*make)(const ProblemOptions& options);
};
/// All problems, in the order of the report.
const std::vector<ProblemMaker>& problem_makers();

// Sand left to itself, against exact shapes (piles.cpp).
Problem cylinder_problem(const ProblemOptions& options);
Problem truncated_problem(const ProblemOptions& options);
Problem cone_problem(const ProblemOptions& options);
Problem cliff_problem(const ProblemOptions& options);
Problem trench_problem(const ProblemOptions& options);
// Sand that drains (crater.cpp).
Problem crater_problem(const ProblemOptions& options);
// The device's work, against closed forms (contact.cpp).
Problem plunge_problem(const ProblemOptions& options);
Problem drag_problem(const ProblemOptions& options);
// Tools of any shape, against closed forms and the sphere (tool_shapes.cpp).
Problem blade_problem(const ProblemOptions& options);
Problem wedge_problem(const ProblemOptions& options);
Problem mesh_problem(const ProblemOptions& options);
// The force of the contact, against closed forms and the theory itself (contact_forces.cpp).
Problem plate_force_problem(const ProblemOptions& options);
Problem sphere_force_problem(const ProblemOptions& options);
// What laws of the force take (tick_time.cpp).
Problem tick_problem(const ProblemOptions& options);
// The dynamic device against a servo loop that is all but continuous; whole strokes against themselves, finer
// (strokes.cpp).
Problem dynamic_problem(const ProblemOptions& options);
Problem accurate_stroke_problem(const ProblemOptions& options);
Problem deep_stroke_problem(const ProblemOptions& options);
Problem reworked_stroke_problem(const ProblemOptions& options);
Problem hands_problem(const ProblemOptions& options);
Problem paper_stroke_problem(const ProblemOptions& options);
// The presets against simulated grains (grains.cpp).
Problem grains_problem(const ProblemOptions& options);

RunSettings settings_of(const RelaxationSettings& relaxation, const BedGeometry& bed, int threads);
/// The same with the rates of a stroke.
RunSettings settings_of(const Scene& scene, int threads);

/// What a run of a stroke took; of its errors nothing yet.
Score score_of(const RunResult& result);

}  // namespace sandstroke
