#include "validation/study/hand_strokes.h"

#include <cmath>
#include <random>

#include "haptics/stroke_sampler.h"
#include "haptics/stroke_script.h"

namespace sandstroke {
namespace {

/// Samples `stroke` at 1 kHz, and moves each sample up by raise(sample, way along the bed [m]).
template <class Raise>
Stroke recorded(const Stroke& stroke, const Raise& raise) {
  StrokeSampler hand(stroke);
  const double begin = hand.start_time();
  const auto samples = static_cast<std::int64_t>(std::floor((hand.end_time() - begin) * 1000.0));
  Stroke recording;
  recording.gap_threshold = stroke.gap_threshold;
  double way = 0.0;
  for (std::int64_t k = 0; k <= samples; ++k) {
    const double time = begin + static_cast<double>(k) / 1000.0;
    Eigen::Vector3d position = hand.at(time).position;
    if (k > 0) way += (position - recording.position.back()).head<2>().norm();
    position.z() += raise(position, way);
    recording.time.push_back(time);
    recording.position.push_back(position);
  }
  return recording;
}

}  // namespace

Stroke s_curve(double depth, double speed, bool cut) {
  StrokeScript script;
  script.start = {-0.08, -0.02};
  script.clearance = 0.005;
  script.segments.push_back(
      {ScriptSpline{{{-0.08, -0.02}, {-0.03, 0.06}, {0.0, 0.0}, {0.03, -0.06}, {0.08, 0.02}}},
       {PressProfile::Kind::depth, {depth}},
       speed});
  if (cut) script.segments[0].shape = ScriptSpline{{{-0.08, -0.02}, {-0.03, 0.03}, {0.02, -0.02}}};
  return trace_script(script, {});
}

Stroke scribble(double depth, double speed, bool cut) {
  const double size = cut ? 0.5 : 1.0;
  const Eigen::Vector2d half(0.03 * size, 0.02 * size);
  constexpr double apart = 0.005;
  StrokeScript script;
  script.start = -half;
  script.clearance = 0.005;
  Eigen::Vector2d at = script.start;
  const auto lines = [&](int across, int along) {
    for (int i = 0; i <= std::lround(2.0 * half[across] / apart); ++i) {
      Eigen::Vector2d from, to;
      from[across] = to[across] = i * apart - half[across];
      from[along] = i % 2 ? half[along] : -half[along];
      to[along] = -from[along];
      for (const Eigen::Vector2d& point : {from, to}) {
        if (point == at) continue;
        script.segments.push_back({ScriptLine{{}, point}, {PressProfile::Kind::depth, {depth}}, speed});
        at = point;
      }
    }
  };
  lines(1, 0);
  lines(0, 1);
  return trace_script(script, {});
}

Stroke with_noise(const Stroke& stroke, double rms) {
  std::mt19937 random(5);
  // std::normal_distribution depends on the library.
  std::uniform_real_distribution<double> uniform(-0.5, 0.5);
  return recorded(stroke, [&](const Eigen::Vector3d&, double) {
    double sum = 0.0;  // the sum of twelve has variance 1
    for (int i = 0; i < 12; ++i) sum += uniform(random);
    return rms * sum;
  });
}

Stroke with_slopes(const Stroke& stroke, double slope) {
  constexpr double amplitude = 0.5e-3;  // m
  return recorded(stroke, [&](const Eigen::Vector3d& position, double way) {
    if (position.z() >= 0.0) return 0.0;
    const double phase = way * slope / amplitude;  // each side of the triangle wave is 2 long
    return amplitude * (1.0 - std::abs(std::fmod(phase, 4.0) - 2.0));
  });
}

Scene hand_scene(ModelPreset preset) {
  Scene scene;
  scene.preset = preset;
  apply_model_preset(scene);
  scene.bed.width = scene.bed.depth = 0.24;
  scene.bed.cols = scene.bed.rows = 120;
  return scene;
}

}  // namespace sandstroke
