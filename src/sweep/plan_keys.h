#pragma once

#include <optional>
#include <string>
#include <vector>

#include "io/key_table.h"

namespace sandstroke {

inline constexpr int most_points = 10'000'000;

/// The keys in [sweep] of a plan.
struct PlanKeys {
  std::string scene, golden;  ///< an empty golden: none
  std::vector<std::string> strokes, metrics, keep;
  int max_points = 10'000;
  int second = 0;    ///< none, coarser, finer
  bool grid = true;  ///< otherwise a Latin hypercube
  int samples = 1, seed = 1;
};
void show_plan(KeyVisitor& visitor, PlanKeys& keys);

/// A range in [axes], written as the table `name`.
struct RangeKeys {
  double from = 0.0, to = 0.0;
  bool logarithmic = false;
  std::optional<int> count;
  std::optional<double> step;
};
void show_range(KeyVisitor& visitor, const std::string& name, RangeKeys& keys, int most_values);

/// Every key that a plan can have.
std::vector<KeySection> all_plan_keys();

}  // namespace sandstroke
