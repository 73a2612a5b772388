#pragma once

#include <filesystem>
#include <functional>
#include <optional>

#include "cli/run_picture.h"

namespace sandstroke {

/// Settings for drawing the frames of a run.
struct FrameLook {
  ViewSettings view = {};
  std::optional<bool> tool = {};  ///< draw it; unset: if the run has a trace
  double contour_interval = 0.0;  ///< m; 0: a round number is chosen
};

/// Draws all frames, one after the other, and calls take(k, image) until it returns false or the program is
/// interrupted. Returns the exit code. Error: input, if the run has no frames.
int draw_frames(const RunFile& run, const FrameLook& look,
                const std::function<bool(std::size_t, const Image&)>& take);

/// Writes the frames as a film and prints its speed: that of the stroke, or `rate` frames a second. Returns
/// the exit code. Errors as in FilmWriter (io/film_file.h).
int draw_film(const RunFile& run, const FrameLook& look, std::optional<double> rate,
              const std::filesystem::path& path);

}  // namespace sandstroke
