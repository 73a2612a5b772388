#include "cli/run_film.h"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <string>

#include "cli/run_surface.h"
#include "core/interrupt.h"
#include "core/progress.h"
#include "io/film_file.h"

namespace sandstroke {

int draw_frames(const RunFile& run, const FrameLook& look,
                const std::function<bool(std::size_t, const Image&)>& take) {
  const std::vector<double> times = frame_times(run);
  const bool tool = look.tool.value_or(run.has_trace());
  RunPainter painter(run, look.view, look.contour_interval);
  RunFrames frames(run);
  Progress progress("render");
  for (std::size_t k = 0; k < times.size(); ++k) {
    const auto frame = static_cast<int>(k);
    const Image image = painter.draw(frames.surface(frame), tool ? std::optional(times[k]) : std::nullopt,
                                     run.load_surface(frame));
    if (!take(k, image) || interrupted()) return 128 + interrupted();
    progress.update(static_cast<double>(k + 1) / static_cast<double>(times.size()));
  }
  return 0;
}

int draw_film(const RunFile& run, const FrameLook& look, std::optional<double> given_rate,
              const std::filesystem::path& path) {
  const Scene scene = run.scene();
  const double own_rate = std::min(scene.output.frames, scene.device.servo_rate);
  const double rate = given_rate.value_or(own_rate);
  const std::size_t count = frame_times(run).size();
  FilmWriter film(path, look.view.width, look.view.height, rate);
  spdlog::info("{} frames, {:g} per second: {}", count, rate,
               rate == own_rate ? "as fast as the stroke"
                                : fmt::format("{:g} times as fast as the stroke", rate / own_rate));
  const int exit_code =
      draw_frames(run, look, [&](std::size_t, const Image& image) { return film.add(image); });
  if (exit_code != 0) return exit_code;
  return film.finish() ? 0 : 128 + interrupted();
}

}  // namespace sandstroke
