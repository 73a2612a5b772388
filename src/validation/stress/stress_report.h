#pragma once

#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "sim/scene.h"

namespace sandstroke {

/// How a case ended. stable: to rest, or bounded as it should be. limit_cycle: bounded, but it never comes to
/// rest. diverged: beyond all bounds. refused: an Error told the user why, before or while it ran.
/// not_converged: still moving when the allowed passes were used up. broken: sand lost, out of range, not a
/// number, or no end: never expected.
enum class Verdict { stable, limit_cycle, diverged, refused, not_converged, broken };
const char* name_of(Verdict verdict);
bool is_among(Verdict verdict, const std::vector<Verdict>& expected);

/// One case and what was expected of it. `expected` may allow several: the theory then decides no further.
struct StressCase {
  std::string group, name;
  std::string settings;  ///< for a person: what was set, with units
  std::vector<Verdict> expected;
  Verdict verdict = Verdict::broken;
  std::string detail;  ///< what was measured, or the sentence of a refusal
  bool surprise() const;
};

struct MapAxis {
  std::string name, unit;
  bool logarithmic = false;
  std::vector<double> values;
};

/// A line in a map: where theory says the boundary is, or where it was measured.
struct MapCurve {
  std::string name;
  std::vector<std::pair<double, double>> points;  ///< x, y
};

/// Verdicts over two settings, row = y index, col = x index. A cell may expect several verdicts.
struct StabilityMap {
  std::string name, title, text;
  MapAxis x, y;
  std::vector<std::vector<Verdict>> verdict;
  std::vector<std::vector<bool>> surprise;
  std::vector<MapCurve> curves;
};

/// A stability boundary: measured by bisection, and where an eigenvalue of the exact one-tick map leaves the
/// unit circle.
struct Boundary {
  std::string settings;
  double measured = 0.0, exact = 0.0;  ///< N/m
  double passive = 0.0;                ///< N/m, up to which Colgate & Schenkel's condition holds
};

/// Values over time, to look at.
struct StressTrace {
  std::string name, title, text, y_name;
  std::vector<double> time;                                         ///< s
  std::vector<std::pair<std::string, std::vector<double>>> series;  ///< name, one value per time
};

struct StressReport {
  std::vector<StressCase> cases;
  std::vector<StabilityMap> maps;
  std::vector<Boundary> boundaries;
  std::vector<StressTrace> traces;

  int surprises() const;  ///< in cases and maps
};

struct StressOptions {
  bool quick = false;  ///< coarser maps, fewer and shorter cases: under a minute
  /// Laws of a plugin, each in settings of its own: then they are tested, and not the program's.
  std::vector<OwnLawSettings> own;
  std::function<void(double)> progress = [](double) {};  ///< share of the whole that is done
};

/// The page's data.
nlohmann::ordered_json as_json(const StressReport& report);

}  // namespace sandstroke
