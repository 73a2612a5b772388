#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <limits>
#include <string>

#include "any_hdf5.h"
#include "compare/check.h"
#include "io/run_file.h"
#include "test_folder.h"

namespace sandstroke {

/// A run made up by a test: a bump of sand pushed from a hollow, and a stroke that is lifted for its first 20
/// ticks.
struct SyntheticRun {
  double cell_size = 0.01;
  bool complete = true, has_final = true, has_trace = true;
  std::string scene_hash = "0123456789abcdef", stroke_hash = "fedcba9876543210";
  HeightGrid initial = HeightGrid::Zero(30, 40), final;
  HeightGrid floor;  // empty: none
  std::vector<TickRecord> trace;
  std::string missing_column;                             // of the trace
  std::string scene = "[device]\nservo_rate = 1000.0\n";  // /scene, if it is to have one

  static constexpr std::size_t ticks = 105, lifted_ticks = 20;

  SyntheticRun() {
    final = initial;
    for (int row = 10; row < 16; ++row)
      for (int col = 20; col < 30; ++col) final(row, col) = 0.003 * std::sin(row + 0.7 * col);
    for (std::size_t tick = 0; tick < ticks; ++tick) {
      const bool lifted = tick < lifted_ticks;
      const double depth = lifted ? 0.0 : 1e-4 * static_cast<double>(tick);
      TickRecord& record = trace.emplace_back();
      record.time = static_cast<double>(tick) / 1000.0;
      record.depth = depth;
      record.level = lifted ? std::numeric_limits<double>::quiet_NaN() : 0.001;
      record.device_force.z() = 1000.0 * std::expm1(0.5 * depth);
      record.contact = !lifted;
    }
  }

  void write(const std::filesystem::path& path) const {
    Hdf5Writer file(path, any_hdf5);
    file.attribute("/", "format", "sandstroke.run");
    file.attribute("/", "format_version", 1.0);
    file.attribute("/", "complete", complete ? 1.0 : 0.0);
    file.make_group("/surface");
    file.attribute("/surface", "cell_size", cell_size);
    file.write("/surface/initial", initial);
    if (has_final) file.write("/surface/final", final);
    if (floor.size() > 0) file.write("/surface/floor", floor);
    if (!scene.empty()) file.write("/scene", scene);
    file.write("/provenance/scene_hash", scene_hash);
    file.write("/provenance/stroke_hash", stroke_hash);
    if (has_trace)
      visit_tick_fields([&](const FieldText& text, const auto& of) {
        const std::string name = text.name;
        using Field = std::decay_t<decltype(of(trace.front()))>;
        std::vector<std::conditional_t<std::is_same_v<Field, bool>, std::uint32_t, Field>> column;
        for (const TickRecord& tick : trace) column.push_back(of(tick));
        if (name != missing_column) file.write("/trace/" + name, column);
      });
    file.finish();
  }
};

/// Exactly one check fails: the one with this name, with these words in its sentence.
inline void expect_only_failure(const Comparison& comparison, const std::string& name,
                                const std::string& words) {
  EXPECT_EQ(comparison.failures(), 1) << check_table(comparison);
  for (const Check& check : comparison.checks) {
    if (check.passed) continue;
    EXPECT_EQ(check.name, name) << check.sentence;
    EXPECT_NE(check.sentence.find(words), std::string::npos) << check.sentence;
  }
}

}  // namespace sandstroke
