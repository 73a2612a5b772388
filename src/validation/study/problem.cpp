#include "validation/study/problem.h"

namespace sandstroke {

const std::vector<ProblemMaker>& problem_makers() {
  static const std::vector<ProblemMaker> makers = {
      {"cylinder", cylinder_problem},
      {"truncated", truncated_problem},
      {"cone", cone_problem},
      {"cliff", cliff_problem},
      {"trench", trench_problem},
      {"octagon", crater_problem},
      {"poured", poured_problem},
      {"seam", seam_problem},
      {"ridge", ridge_problem},
      {"disc", disc_problem},
      {"cap", cap_problem},
      {"cut", cut_problem},
      {"wall", wall_problem},
      {"lift", lift_problem},
      {"plunge", plunge_problem},
      {"drag", drag_problem},
      {"blade", blade_problem},
      {"wedge", wedge_problem},
      {"mesh", mesh_problem},
      {"force-plate", plate_force_problem},
      {"force-sphere", sphere_force_problem},
      {"leaning", leaning_problem},
      {"pulled", pulled_problem},
      {"heap", heap_force_problem},
      {"ticks", tick_problem},
      {"dynamic", dynamic_problem},
      {"stroke-accurate", accurate_stroke_problem},
      {"stroke-deep", deep_stroke_problem},
      {"stroke-reworked", reworked_stroke_problem},
      {"hands", hands_problem},
      {"stroke-paper", paper_stroke_problem},
      {"grains", grains_problem},
  };
  return makers;
}

RunSettings settings_of(const RelaxationSettings& relaxation, const BedGeometry& bed, int threads) {
  RunSettings settings;
  settings.law = relaxation_law_names[static_cast<int>(relaxation.law)];
  settings.method = relaxation_method_names[static_cast<int>(relaxation.method)];
  settings.cells = bed.cols();
  settings.cell_size = bed.cell_size();
  settings.tolerance = relaxation.tolerance;
  if (takes_super_steps(relaxation.method)) settings.step_tolerance = relaxation.step_tolerance;
  settings.share = flow_share(relaxation);
  settings.threads = threads;
  return settings;
}

RunSettings settings_of(const Scene& scene, int threads) {
  RunSettings settings = settings_of(
      scene.relaxation, BedGeometry(scene.bed.rows, scene.bed.cols, scene.bed.cell_size()), threads);
  settings.servo_rate = scene.device.servo_rate;
  settings.relaxation_rate = scene.relaxation.rate;
  return settings;
}

Score score_of(const RunResult& result) {
  Score score;
  score.passes = static_cast<double>(result.relaxation.passes);
  score.cells_visited = static_cast<double>(result.relaxation.cells_visited);
  score.volume_drift = result.volume_drift;
  score.converged = result.relaxation.converged;
  return score;
}

}  // namespace sandstroke
