#include "cli/run_surface.h"

#include <limits>

#include "cli/parse_number.h"
#include "core/error.h"

namespace sandstroke {

RunSurface surface_named(const RunFile& run, const std::string& name, const char* choices) {
  if (name == "final") return {run.final_bed(), std::numeric_limits<double>::infinity(), "", false};
  if (name == "initial") return {run.initial_bed(), 0.0, "_initial", false};
  int k = 0;
  if (!parse_number(name, k)) throw_input_error("--frame {} is not a frame; take {}", name, choices);
  const std::vector<double> times = frame_times(run);
  if (k < 0 || k >= static_cast<int>(times.size()))
    throw_input_error("{}: has no frame {}; take 0 to {}", run.name(), k, times.size() - 1);
  const auto at = static_cast<std::size_t>(k);
  return {RunFrames(run).surface(k), times[at], "_" + frame_name(at), true, run.load_surface(k)};
}

std::vector<double> frame_times(const RunFile& run) {
  std::vector<double> times = run.frame_times();
  if (times.empty()) throw_input_error("{}: has no frames; run the scene again with --frames HZ", run.name());
  return times;
}

std::string frame_name(std::size_t k) { return fmt::format("frame_{:04}", k); }

}  // namespace sandstroke
