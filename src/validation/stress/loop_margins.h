#pragma once

#include <string>

#include "validation/stress/device_loop.h"

namespace sandstroke {

/// The latest force that is judged [ticks]: the eigenvalues of 100 numbers take some milliseconds.
inline constexpr int latest_judged = 100;

/// How far a loop is from its boundary of stability, setting by setting, by its eigenvalue. Exact encoders,
/// no dropped ticks.
LoopMargins margins_of(const std::string& name, const LoopSettings& loop);

/// The settings in words.
std::string in_words(const LoopSettings& settings);

/// A loop whose place maps show.
struct MarkedLoop {
  std::string name;
  LoopSettings loop;
};

/// Loops that people ask about: the default device in the paper's sand, which is the default too, and in
/// force.law = "rft", both pressed with 3 N, the largest force in the paper.
std::vector<MarkedLoop> known_loops();

/// The place of each loop in the map whose cell at (x, y) is loop(x, y), if the loop has both settings.
std::vector<MapMark> marks_in(const MapAxis& x, const MapAxis& y,
                              const std::function<LoopSettings(double x, double y)>& loop,
                              const std::vector<MarkedLoop>& marked);

}  // namespace sandstroke
