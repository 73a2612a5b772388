#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>

#include "core/output_file.h"
#include "core/stopwatch.h"
#include "sim/simulation.h"

namespace sandstroke {

/// The state of a run in the middle of its stroke, and what it belongs to.
struct RunState {
  std::string commit;  ///< of the program
  std::string scene;   ///< TOML; of a sweep's simulation: those of its points
  std::string stroke_hash, surface_hash;
  bool estimates_error = false;
  std::string state = {};  ///< of the Simulation and its observers

  template <class State>
  void visit_state(State& visitor) {
    visitor.value("commit", commit);
    visitor.value("scene", scene);
    visitor.value("stroke_hash", stroke_hash);
    visitor.value("surface_hash", surface_hash);
    visitor.value("estimates_error", estimates_error);
    visitor.value("state", state);
  }
};

inline constexpr OutputKind run_state_output{"a run's state", "sandstroke run state 1\n"};

/// False for a scene that only relaxes, and for one with a plugin's law, whose state is not known.
bool keeps_state(const Scene& scene);

/// The file beside a run file that keeps the run's state until it is complete: PATH.state.
std::filesystem::path state_path(const std::filesystem::path& run_file);

/// Removes a run's state that is not needed any more; leaves a file that is none.
void remove_state(const std::filesystem::path& state_file);

/// Refuses to begin a run again that can go on. Error: input.
void check_no_state(const std::filesystem::path& run_file);

/// The file of a run's state, written again each `seconds`. A kill leaves the one before. Where it cannot be
/// written it warns once.
class StateFile {
 public:
  /// what: gives the run, without its state; called if a state is read or kept. seconds: 0: it keeps none.
  StateFile(std::filesystem::path path, std::function<RunState()> what, double seconds)
      : path_(std::move(path)), what_(std::move(what)), seconds_(seconds) {}
  /// The state that the file keeps; empty: there is no file. Error: input, naming what differs, if it is of
  /// another run; io.
  std::string kept();
  bool exists() const { return std::filesystem::exists(path_); }
  /// For a simulation that goes on from this state. They use this object.
  Checkpoints checkpoints(std::string from);
  /// Whether a state could not be written.
  bool failed() const { return failed_; }

 private:
  RunState& run();
  void keep(std::string state);

  std::filesystem::path path_;
  std::function<RunState()> what_;
  std::optional<RunState> run_;
  double seconds_;
  Stopwatch since_;  // the last one was kept
  bool failed_ = false;
};

/// The state of a run that goes with PATH.part. Empty: none was kept, so the run begins at its start. Error:
/// as StateFile::kept(); input, if PATH.part is missing, or of another scene.
std::string state_with_part(StateFile& file, const std::filesystem::path& run_file,
                            const std::string& scene_text);

}  // namespace sandstroke
