#include "io/run_state.h"

#include <spdlog/spdlog.h>

#include <limits>
#include <utility>

#include "core/error.h"
#include "core/input_file.h"
#include "io/run_file.h"
#include "io/state_file.h"

namespace sandstroke {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void refuse(const fs::path& path, const std::string& why) {
  throw_input_error(
      "{}: {}; give what the run began with, or leave --resume out and begin again with --overwrite",
      path.string(), why);
}

}  // namespace

bool keeps_state(const Scene& scene) {
  const PluginLawSettings& laws = scene.plugin_laws;
  return !scene.only_relaxes() && laws.relaxation.empty() && laws.displacement.empty() && laws.force.empty();
}

fs::path state_path(const fs::path& run_file) {
  fs::path path = run_file;
  path += ".state";
  return path;
}

void remove_state(const fs::path& state_file) {
  if (!fs::exists(state_file) || !begins_with(state_file, run_state_output.begin)) return;
  std::error_code ignored;  // it does no harm
  fs::remove(state_file, ignored);
}

void check_no_state(const fs::path& run_file) {
  const fs::path state = state_path(run_file);
  try {
    check_replaceable(state, irreplaceable(run_state_output));
  } catch (const Error&) {
    if (!fs::is_regular_file(fs::symlink_status(state)) || !begins_with(state, run_state_output.begin)) throw;
    throw_input_error(
        "{}: keeps the state of a run that was stopped; go on with --resume, or begin again with --overwrite",
        state.string());
  }
}

RunState& StateFile::run() {
  if (!run_) run_ = what_();
  return *run_;
}

std::string StateFile::kept() {
  if (!exists()) return "";
  const std::string bytes = read_text_file(path_, std::numeric_limits<std::size_t>::max());
  auto kept = read_state<RunState>(bytes, run_state_output, path_.string());
  if (kept.commit != run().commit)
    refuse(path_, fmt::format("was kept by the build {}, and this is {}, whose numbers may be others",
                              kept.commit, run().commit));
  if (const std::string difference = scene_difference(run().scene, kept.scene, "scene"); !difference.empty())
    refuse(path_, "is of another scene: " + difference);
  if (kept.stroke_hash != run().stroke_hash) refuse(path_, "was kept with another stroke");
  if (kept.surface_hash != run().surface_hash) refuse(path_, "was kept with another starting surface");
  if (kept.estimates_error != run().estimates_error)
    refuse(path_, fmt::format("was kept {} --estimate-error", kept.estimates_error ? "with" : "without"));
  return std::move(kept.state);
}

Checkpoints StateFile::checkpoints(std::string from) {
  Checkpoints checkpoints{std::move(from)};
  if (seconds_ == 0.0) return checkpoints;
  checkpoints.due = [this] { return since_.seconds() >= seconds_; };
  checkpoints.keep = [this](std::string state) { keep(std::move(state)); };
  return checkpoints;
}

void StateFile::keep(std::string state) {
  run().state = std::move(state);
  try {
    write_text_file(path_, state_bytes(run(), run_state_output), run_state_output);
  } catch (const Error& error) {
    if (!std::exchange(failed_, true))
      spdlog::warn("the run's state cannot be kept, and the run goes on: {}", error.what());
  }
  run().state.clear();
  since_ = {};
}

std::string state_with_part(StateFile& file, const fs::path& run_file, const std::string& scene_text) {
  std::string state = file.kept();
  const fs::path part = part_path(run_file);
  if (state.empty())
    spdlog::info("{}: no state was kept; the run begins at its start", run_file.string());
  else if (!fs::exists(part))
    refuse(state_path(run_file), fmt::format("goes with {}, which is not there", part.string()));
  else if (RunFile(part).scene_text() != scene_text)
    refuse(state_path(run_file), fmt::format("goes with {}, which is of another scene", part.string()));
  return state;
}

}  // namespace sandstroke
