#pragma once

#include <filesystem>
#include <functional>
#include <optional>

#include "cli/run_picture.h"

namespace sandstroke {

/// How the frames of a run are drawn.
struct FrameLook {
  ViewSettings view = {};
  std::optional<bool> tool = {};  ///< drawn; unset: where the run has a trace
  double contour_interval = 0.0;  ///< m; 0 = a round one
};

/// Draws all frames, one after the other, and gives them to take(k, image) until that returns false or the
/// program is interrupted. The exit code. Error: input, where the run has no frames.
int draw_frames(const RunFile& run, const FrameLook& look,
                const std::function<bool(std::size_t, const Image&)>& take);

/// Writes them as a film and says how fast it is: as the stroke, or as `rate` [Hz] says. The exit code.
/// Error: as FilmWriter's (io/film_file.h).
int draw_film(const RunFile& run, const FrameLook& look, std::optional<double> rate,
              const std::filesystem::path& path);

}  // namespace sandstroke
