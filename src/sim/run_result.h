#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <limits>
#include <optional>
#include <string_view>
#include <type_traits>
#include <vector>

#include "core/warning.h"
#include "haptics/stroke_coverage.h"
#include "haptics/stroke_sampler.h"
#include "sand/relaxation.h"
#include "sand/resistive_force.h"
#include "sim/source_settings.h"
#include "sim/tool_load.h"

namespace sandstroke {

/// Everything recorded about one servo tick (a row of /trace in a run file).
struct TickRecord {
  double time = 0.0;  ///< s
  Hand hand, next;    ///< where the hand wants to be at the tick's start and end, device frame
  Eigen::Vector3d device_position = Eigen::Vector3d::Zero();  ///< m, as read from the encoders, device frame
  Eigen::Vector3d device_force = Eigen::Vector3d::Zero();     ///< N, on the device, saturated
  Eigen::Vector3d repulse_force = Eigen::Vector3d::Zero();    ///< N
  Eigen::Vector3d drag_force = Eigen::Vector3d::Zero();       ///< N
  /// N, the force on the hand that was recorded with the stroke (haptics/recorded_force.h); NaN: not known.
  Eigen::Vector3d recorded_force = Eigen::Vector3d::Constant(std::numeric_limits<double>::quiet_NaN());
  /// N, of the bed's floor and its stones (sim/floor_force.h).
  Eigen::Vector3d floor_force = Eigen::Vector3d::Zero();
  double floor_depth = 0.0;  ///< m, of the tool in the floor: the least way that frees it
  double carried = 0.0;      ///< kg of sand on the tool
  double load = 0.0;         ///< N, the weight of it that the tool feels
  double load_given = 0.0;  ///< N, of that, what the device gives; gravity keeps energy, so no law returns it
  double load_stiffness = 0.0;  ///< N/m, by which it grows as the tool rises
  Wrench wrench = {};           ///< by any law but the paper's: force and torque on the bed's axes
  double level = std::numeric_limits<double>::quiet_NaN();  ///< m, sand level under the tool; NaN: lifted
  double depth = 0.0;             ///< m, of the tip below the level; negative = above
  double displaced_volume = 0.0;  ///< m^3, displaced in this tick
  double passivity_margin = 0.0;  ///< N s/m, Colgate & Schenkel
  bool contact = false;           ///< the tool touches sand (depth > 0) or the floor
  bool saturated = false;         ///< the device's maximum force cut the force
  bool dropped = false;           ///< the loop was late: the force of the tick before is given out again
  bool lifts = false;             ///< the hand is lifted before the tick ends
  /// Depth below the sand that the hand asks for [m]; NaN: it is lifted, or does not follow the sand.
  double asked_depth = std::numeric_limits<double>::quiet_NaN();

  template <class State>
  void visit_state(State& state) {
    state.value("time", time);
    state.value("hand", hand);
    state.value("next", next);
    state.value("device_position", device_position);
    state.value("device_force", device_force);
    state.value("repulse_force", repulse_force);
    state.value("drag_force", drag_force);
    state.value("recorded_force", recorded_force);
    state.value("floor_force", floor_force);
    state.value("floor_depth", floor_depth);
    state.value("carried", carried);
    state.value("load", load);
    state.value("load_given", load_given);
    state.value("load_stiffness", load_stiffness);
    state.value("wrench", wrench);
    state.value("level", level);
    state.value("depth", depth);
    state.value("displaced_volume", displaced_volume);
    state.value("passivity_margin", passivity_margin);
    state.value("contact", contact);
    state.value("saturated", saturated);
    state.value("dropped", dropped);
    state.value("lifts", lifts);
    state.value("asked_depth", asked_depth);
  }
};

/// The fields that only the traces of some runs hold.
struct TraceContent {
  bool recorded_force = false;  ///< the stroke was recorded with forces
  bool dropped_ticks = false;   ///< the device has dropped ticks
  bool asked_depth = false;     ///< the stroke follows the sand
  bool torque = false;          ///< the law of force is not the paper's
  bool orientation = false;     ///< the stroke turns the tool
  bool floor = false;           ///< the bed has a floor
  bool carried = false;         ///< the tool carries sand
};

/// A field of a record, described for readers of a file.
struct FieldText {
  const char *name, *units, *meaning;       // units: empty if it has none, "1" for a count or ratio
  bool TraceContent::*only_with = nullptr;  // without it the field is missing, and keeps its default
};

/// The names of the components of a field, a letter each; empty: the field is one number.
template <class Field>
constexpr std::string_view components_of() {
  if constexpr (std::is_same_v<Field, Eigen::Vector3d>)
    return "xyz";
  else if constexpr (std::is_same_v<Field, Eigen::Vector4d>)
    return "xyzw";
  else
    return "";
}

/// Calls visit(FieldText, of) for the columns of /trace; of(tick) is the field. Writers and readers of a run
/// file go through this list.
template <class Visit>
void visit_tick_fields(const Visit& visit) {
  using Text = FieldText;
  visit(
      Text{"time", "s", "start of the tick"}, [](auto& tick) -> auto& { return tick.time; });
  visit(
      Text{"hand_position", "m",
           "where the hand wants the tip at the start of the tick, in the device's frame; it moves straight "
           "and uniformly until the next tick"},
      [](auto& tick) -> auto& { return tick.hand.position; });
  visit(
      Text{"orientation", "",
           "the hand's orientation as a unit quaternion; it turns the tool, starting from tool.orientation",
           &TraceContent::orientation},
      [](auto& tick) -> auto& { return tick.hand.orientation.coeffs(); });
  visit(
      Text{"device_position", "m",
           "position of the tip that the device read, rounded to its encoders' resolution, in its frame (on "
           "the bed: device.scale x this + device.offset)"},
      [](auto& tick) -> auto& { return tick.device_position; });
  visit(
      Text{"device_force", "N",
           "force that acts on the device in the tick: limited to its largest, delayed by device.delay and "
           "dropped ticks, faded in after a gap"},
      [](auto& tick) -> auto& { return tick.device_force; });
  visit(
      Text{"repulse_force", "N", "repulse force of the sand on the tool there, without delay or limit"},
      [](auto& tick) -> auto& { return tick.repulse_force; });
  visit(
      Text{"drag_force", "N", "drag force of the sand on the tool there, without delay or limit"},
      [](auto& tick) -> auto& { return tick.drag_force; });
  visit(
      Text{"floor_force", "N", "force of the floor and its stones on the tool there, without delay or limit",
           &TraceContent::floor},
      [](auto& tick) -> auto& { return tick.floor_force; });
  visit(
      Text{"floor_depth", "m", "depth of the tool in the floor: the least way that frees it; 0 beside it",
           &TraceContent::floor},
      [](auto& tick) -> auto& { return tick.floor_depth; });
  visit(
      Text{"carried", "kg", "sand on the tool", &TraceContent::carried},
      [](auto& tick) -> auto& { return tick.carried; });
  visit(
      Text{"load", "N",
           "weight of the sand on the tool that the tool feels: of what stands above the sand around it",
           &TraceContent::carried},
      [](auto& tick) -> auto& { return tick.load; });
  visit(
      Text{"torque", "N m", "torque of the sand on the tool about its tip", &TraceContent::torque},
      [](auto& tick) -> auto& { return tick.wrench.torque; });
  visit(
      Text{"recorded_force", "N",
           "force on the hand, recorded with the stroke, in the device's frame; not a number where it is "
           "unknown or the recorder altered it",
           &TraceContent::recorded_force},
      [](auto& tick) -> auto& { return tick.recorded_force; });
  visit(
      Text{"level", "m", "height of the sand under the tool; not a number where the tool is lifted"},
      [](auto& tick) -> auto& { return tick.level; });
  visit(
      Text{"depth", "m", "depth of the tip, as read, below that level; negative above it"},
      [](auto& tick) -> auto& { return tick.depth; });
  visit(
      Text{"asked_depth", "m",
           "depth below the sand that the stroke asks for; negative above it, not a number where the tool is "
           "lifted",
           &TraceContent::asked_depth},
      [](auto& tick) -> auto& { return tick.asked_depth; });
  visit(
      Text{"displaced_volume", "m^3", "sand pushed aside in the tick"},
      [](auto& tick) -> auto& { return tick.displaced_volume; });
  visit(
      Text{"passivity_margin", "N s/m", "passivity margin (Colgate and Schenkel); negative: may be active"},
      [](auto& tick) -> auto& { return tick.passivity_margin; });
  visit(
      Text{"contact", "", "whether the tool touches sand or the floor"},
      [](auto& tick) -> auto& { return tick.contact; });
  visit(
      Text{"saturated", "", "whether the force was limited to the device's largest"},
      [](auto& tick) -> auto& { return tick.saturated; });
  visit(
      Text{"dropped", "", "whether the loop was late and repeated the force of the tick before",
           &TraceContent::dropped_ticks},
      [](auto& tick) -> auto& { return tick.dropped; });
}

/// One call of the relaxation (a row of /relaxation).
struct RelaxationRecord {
  double time = 0.0;  ///< s
  RelaxationOutcome outcome;
};

/// The columns of /relaxation, as visit_tick_fields().
template <class Visit>
void visit_relaxation_fields(const Visit& visit) {
  using Text = FieldText;
  visit(
      Text{"time", "s", "when the sand relaxed"}, [](auto& record) -> auto& { return record.time; });
  visit(
      Text{"passes", "1", "passes over the active sand"},
      [](auto& record) -> auto& { return record.outcome.passes; });
  visit(
      Text{"residual", "1", "largest remaining excess of a slope over the talus slope"},
      [](auto& record) -> auto& { return record.outcome.residual; });
  visit(
      Text{"moved_volume", "m^3", "sand that flowed"},
      [](auto& record) -> auto& { return record.outcome.moved_volume; });
}

/// The columns of /sources, as visit_tick_fields().
template <class Visit>
void visit_source_fields(const Visit& visit) {
  using Text = FieldText;
  visit(
      Text{"poured", "kg", "sand that left the nozzle"}, [](auto& source) -> auto& { return source.poured; });
  visit(
      Text{"landed", "kg", "of that, sand that came down on the bed"},
      [](auto& source) -> auto& { return source.landed; });
  visit(
      Text{"in_air", "kg", "of that, sand that still falls"},
      [](auto& source) -> auto& { return source.in_air; });
  visit(
      Text{"asked", "kg", "sand that a sink would have taken if it had been in its reach"},
      [](auto& source) -> auto& { return source.asked; });
  visit(
      Text{"taken", "kg", "of that, sand that it got"}, [](auto& source) -> auto& { return source.taken; });
}

/// The sand on a tool (LoadLedger), as visit_tick_fields().
template <class Visit>
void visit_load_fields(const Visit& visit) {
  using Text = FieldText;
  visit(
      Text{"lifted", "m^3", "sand that the tool took out of the bed"},
      [](auto& load) -> auto& { return load.lifted; });
  visit(
      Text{"ran_on", "m^3", "sand that ran onto it from the bed beside it"},
      [](auto& load) -> auto& { return load.ran_on; });
  visit(
      Text{"caught", "m^3", "sand from sources that came down on it"},
      [](auto& load) -> auto& { return load.caught; });
  visit(
      Text{"spilled", "m^3", "sand that ran over its rim"}, [](auto& load) -> auto& { return load.spilled; });
  visit(
      Text{"in_air", "m^3", "of that, sand that still falls"},
      [](auto& load) -> auto& { return load.in_air; });
  visit(
      Text{"carried", "m^3", "sand on it at the end"}, [](auto& load) -> auto& { return load.carried; });
  visit(
      Text{"most", "m^3", "the most that it carried"}, [](auto& load) -> auto& { return load.most; });
}

/// How well the forces of a run and those that were recorded agree (measure/force_agreement.h).
struct ForceAgreement {
  std::int64_t ticks = 0;                                              ///< ticks that have both
  double rms = 0.0, max = 0.0;                                         ///< N, of the difference's magnitude
  double correlation = std::numeric_limits<double>::quiet_NaN();       ///< -1 to 1; NaN: one never changes
  double best_correlation = std::numeric_limits<double>::quiet_NaN();  ///< with the run's moved by -lag
  double lag = 0.0;  ///< s; the run's force comes later by this
};

/// The distance of a run from the limit of ever smaller steps (cells, ticks, times between relaxations,
/// tolerances).
struct ErrorEstimate {
  double height_share = 0.0;  ///< sand that lies elsewhere, as a fraction of sand that is not where it was
  double height_rms = 0.0;    ///< m, over the cells that changed
  double height_max = 0.0;    ///< m
  double force_rms = 0.0;     ///< N, over the ticks with a force
  double force_max = 0.0;     ///< N
  bool at_rest = true;        ///< both solutions came to rest; otherwise the estimate says little
  double wall_seconds = 0.0;  ///< time that the estimate took
};

/// Like visit_tick_fields(), for an error estimate: the numbers of the outcome, not of the clock.
template <class Visit>
void visit_error_fields(const Visit& visit) {
  using Text = FieldText;
  visit(
      Text{"height_share", "1", "sand in the wrong place, as a fraction of the sand that changed place"},
      [](auto& error) -> auto& { return error.height_share; });
  visit(
      Text{"height_rms", "m", "error of heights, rms over the cells that changed"},
      [](auto& error) -> auto& { return error.height_rms; });
  visit(
      Text{"height_max", "m", "error of heights, largest"},
      [](auto& error) -> auto& { return error.height_max; });
  visit(
      Text{"force_rms", "N", "error of the force, rms over the ticks with a force"},
      [](auto& error) -> auto& { return error.force_rms; });
  visit(
      Text{"force_max", "N", "error of the force, largest"},
      [](auto& error) -> auto& { return error.force_max; });
  visit(
      Text{"at_rest", "", "whether both solutions came to rest"},
      [](auto& error) -> auto& { return error.at_rest; });
}

/// The furrow that a stroke left, measured in cross-sections of the change of height (final - initial), so
/// that the bed's earlier shape does not count (measure/furrow.h). NaN: nothing to measure.
struct FurrowMeasures {
  /// Depth of the lowest point below the initial surface [m], within a tool radius of the path; 0 if there is
  /// no furrow.
  double depth = std::numeric_limits<double>::quiet_NaN();
  /// Distance [m] between the points left and right of the lowest one where the change comes back to zero.
  double width = std::numeric_limits<double>::quiet_NaN();
  /// Highest point [m], on either side, of the first raised sand outwards from there (and what joins it).
  double rampart = std::numeric_limits<double>::quiet_NaN();
  /// Depth below the initial surface at which the hand wanted the tip [m].
  double asked_depth = std::numeric_limits<double>::quiet_NaN();
  double length = 0.0;  ///< m, of the way in contact
};

/// Forces and energy of the device in a run.
struct DeviceResult {
  std::int64_t saturated_ticks = 0;
  double max_force = 0.0;        ///< N
  double mean_force = 0.0;       ///< N, its magnitude over contact ticks
  double absorbed_energy = 0.0;  ///< J, net energy that the device gave to the sand
  double least_absorbed_energy =
      0.0;  ///< J, its minimum over time; negative = sand returned more than it took
  double least_passivity_margin = 0.0;  ///< N s/m, over contact ticks
  double max_drag_force = 0.0;          ///< N, before delay and limit
  /// Ticks in which implicit drag was limited to what stops the device, and the sand's largest drag in them
  /// [N s/m].
  std::int64_t limited_drag_ticks = 0;
  double limited_drag = 0.0;
  std::optional<double> swings_from =
      {};                         ///< s, from when a dynamic device was found to swing by itself (SwingWatch)
  double most_floor_depth = 0.0;  ///< m, of the tool in the floor
  std::optional<double> in_floor_from = {};  ///< s, when the tool was first in the floor

  template <class State>
  void visit_state(State& state) {
    state.value("saturated_ticks", saturated_ticks);
    state.value("max_force", max_force);
    state.value("mean_force", mean_force);
    state.value("absorbed_energy", absorbed_energy);
    state.value("least_absorbed_energy", least_absorbed_energy);
    state.value("least_passivity_margin", least_passivity_margin);
    state.value("max_drag_force", max_drag_force);
    state.value("limited_drag_ticks", limited_drag_ticks);
    state.value("limited_drag", limited_drag);
    state.value("swings_from", swings_from);
    state.value("most_floor_depth", most_floor_depth);
    state.value("in_floor_from", in_floor_from);
  }
};

/// The result of a stroke that follows the sand: means over the ticks in which it asked to be in the sand.
struct FollowedSand {
  std::int64_t ticks = 0;
  double asked_depth = 0.0, depth = 0.0;  ///< m
  double asked_force = 0.0, force = 0.0;  ///< N, repulse

  void add(double asked, double reached, double force_asked, double force_reached);

  template <class State>
  void visit_state(State& state) {
    state.value("ticks", ticks);
    state.value("asked_depth", asked_depth);
    state.value("depth", depth);
    state.value("asked_force", asked_force);
    state.value("force", force);
  }
};

/// The result of a whole run (`run --json`).
struct RunResult {
  double wall_seconds = 0.0;  ///< the simulation, without start-up and file writing
  std::int64_t ticks = 0;
  double simulated_seconds = 0.0;
  std::int64_t contact_ticks = 0;
  std::vector<SourceLedger> sources;  ///< in the scene's order
  PlayedPart stroke;                  ///< how much of it is played with the tool down, and the gaps
  std::int64_t relaxations = 0;
  /// The sum of all relaxations; residual and converged are the last one's.
  RelaxationOutcome relaxation{.converged = true};
  DeviceResult device;
  double volume_initial = 0.0;    ///< m^3
  double volume_final = 0.0;      ///< m^3
  double displaced_volume = 0.0;  ///< m^3, by the tool
  double given_volume = 0.0;      ///< m^3, landed from sources, less what sinks have taken
  /// How hard the tool moved under a load at most: its acceleration along the bed over that at which sand
  /// slides on it, tan(talus) (g + its acceleration upwards).
  double most_slide = 0.0;
  double slides_at = 0.0;          ///< s
  std::optional<LoadLedger> load;  ///< if the tool carries sand
  double moved_volume = 0.0;       ///< m^3, by tool, relaxation and sources
  /// |final - initial - given| / moved volume; 0 where nothing moved
  double volume_drift = 0.0;
  double max_depth = 0.0;          ///< m
  double max_contact_speed = 0.0;  ///< m/s, of the tool in the bed
  /// The largest depth of a tool that is down, touching or not [m]; -infinity: it is never down over the bed.
  double nearest = -std::numeric_limits<double>::infinity();
  double nearest_time = 0.0;  ///< s
  /// The least distance beyond the bed's edge of a tool that is down beside the bed [m]; infinity: it never
  /// is.
  double least_beside = std::numeric_limits<double>::infinity();
  int threads = 1;
  bool interrupted = false;
  bool already_complete = false;  ///< the run was to go on, but its file is complete: nothing else is known
  std::optional<FurrowMeasures> furrow;          ///< if the stroke touched sand
  std::optional<FollowedSand> followed;          ///< if the stroke follows the sand
  std::optional<ErrorEstimate> error;            ///< if it was asked for
  std::optional<ForceAgreement> recorded_force;  ///< if the stroke was recorded with forces
  std::vector<Warning> warnings;                 ///< what makes the result doubtful

  /// What a run adds up as it goes; the rest is known at its end.
  template <class State>
  void visit_state(State& state) {
    state.value("ticks", ticks);
    state.value("contact_ticks", contact_ticks);
    state.value("relaxations", relaxations);
    state.value("relaxation", relaxation);
    state.value("volume_initial", volume_initial);
    state.value("displaced_volume", displaced_volume);
    state.value("max_depth", max_depth);
    state.value("max_contact_speed", max_contact_speed);
    state.value("nearest", nearest);
    state.value("nearest_time", nearest_time);
    state.value("least_beside", least_beside);
    state.value("most_slide", most_slide);
    state.value("slides_at", slides_at);
    state.value("followed", followed);
  }
};

}  // namespace sandstroke
