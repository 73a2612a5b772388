#pragma once

#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "sim/scene.h"

namespace sandstroke {

/// How a case ended. stable: it came to rest, or stayed bounded as it should. limit_cycle: bounded, but never
/// at rest. diverged: beyond all bounds. refused: an Error told the user why, before or while it ran.
/// not_converged: still moving after all allowed passes. broken: sand was lost, out of range or not a number,
/// or the run did not end. Nobody expects that.
enum class Verdict { stable, limit_cycle, diverged, refused, not_converged, broken };
const char* name_of(Verdict verdict);
bool is_among(Verdict verdict, const std::vector<Verdict>& expected);

/// One case and its expected verdicts. There may be several: then theory does not say which.
struct StressCase {
  std::string group, name;
  std::string settings;  ///< the settings in words, with units
  std::vector<Verdict> expected;
  Verdict verdict = Verdict::broken;
  std::string detail;  ///< what was measured, or the error sentence of a refusal
  bool surprise() const;
};

struct MapAxis {
  std::string name, unit;
  bool logarithmic = false;
  std::vector<double> values;
};

/// A line in a map: the boundary by theory, or as measured.
struct MapCurve {
  std::string name;
  std::vector<std::pair<double, double>> points;  ///< x, y
};

/// A loop that people ask about, in a map: where its settings are on the axes.
struct MapMark {
  std::string name;
  double x, y;
  bool same;    ///< its other settings are the map's
  bool stable;  ///< by its own eigenvalue
};

/// Verdicts over two settings: row = y index, col = x index. A cell may expect several verdicts.
struct StabilityMap {
  std::string name, title, text;
  MapAxis x, y;
  std::vector<std::vector<Verdict>> verdict;
  std::vector<std::vector<bool>> surprise;
  std::vector<MapCurve> curves;
  std::vector<MapMark> marks = {};
};

/// How far a setting is from the boundary of stability, if only it changes. factor: by how much it may grow
/// or shrink, whichever is worse; below 1 the loop is unstable. Infinite: no value makes the loop unstable.
/// 0, and an infinite boundary: none makes it stable.
struct Margin {
  std::string what, unit;
  double value, boundary, factor;
};

/// The margins of a loop.
struct LoopMargins {
  std::string name;
  std::string settings;  ///< in words
  bool stable;
  std::vector<Margin> margins;
};

/// A stability boundary. measured: by bisection. exact: where an eigenvalue of the exact one-tick map leaves
/// the unit circle.
struct Boundary {
  std::string settings;
  double measured = 0.0, exact = 0.0;  ///< N/m
  double passive = 0.0;                ///< N/m, Colgate & Schenkel's condition holds up to it
};

/// Values over time, for a chart.
struct StressTrace {
  std::string name, title, text, y_name;
  std::vector<double> time;                                         ///< s
  std::vector<std::pair<std::string, std::vector<double>>> series;  ///< name, one value per time
};

struct StressReport {
  std::vector<LoopMargins> margins;
  std::vector<StressCase> cases;
  std::vector<StabilityMap> maps;
  std::vector<Boundary> boundaries;
  std::vector<StressTrace> traces;

  int surprises() const;  ///< in cases and maps
};

struct StressOptions {
  bool quick = false;  ///< coarser maps, fewer and shorter cases: under a minute
  /// Plugin laws, each in its own settings. If there are any, they are tested instead of the program's.
  std::vector<PluginLawSettings> plugin_laws;
  std::function<void(double)> progress = [](double) {};  ///< gets the fraction of the test that is done
};

/// The data of the page, but for machine, options and time. Infinity becomes null in its text.
nlohmann::ordered_json as_json(const StressReport& report);

/// The page that draws them (assets/stress.js), as HTML.
std::string stress_page(const nlohmann::ordered_json& data);

}  // namespace sandstroke
