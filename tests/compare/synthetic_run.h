#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <limits>
#include <string>

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
  RunTrace trace;

  static constexpr std::size_t ticks = 105, lifted_ticks = 20;

  SyntheticRun() {
    final = initial;
    for (int row = 10; row < 16; ++row)
      for (int col = 20; col < 30; ++col) final(row, col) = 0.003 * std::sin(row + 0.7 * col);
    for (std::size_t tick = 0; tick < ticks; ++tick) {
      const bool lifted = tick < lifted_ticks;
      const double depth = lifted ? 0.0 : 1e-4 * static_cast<double>(tick);
      trace.time.push_back(0.001 * static_cast<double>(tick));
      trace.depth.push_back(depth);
      trace.level.push_back(lifted ? std::numeric_limits<double>::quiet_NaN() : 0.001);
      trace.device_force.emplace_back(0.0, 0.0, 1000.0 * std::expm1(0.5 * depth));
      trace.contact.push_back(lifted ? 0 : 1);
    }
  }

  void write(const std::filesystem::path& path) const {
    Hdf5Writer file(path);
    file.attribute("/", "format", "sandstroke.run");
    file.attribute("/", "format_version", 1.0);
    file.attribute("/", "complete", complete ? 1.0 : 0.0);
    file.make_group("/surface");
    file.attribute("/surface", "cell_size", cell_size);
    file.write("/surface/initial", initial);
    if (has_final) file.write("/surface/final", final);
    file.write("/provenance/scene_hash", scene_hash);
    file.write("/provenance/stroke_hash", stroke_hash);
    if (has_trace) {
      const std::vector<Eigen::Vector3d> vectors(trace.size(), Eigen::Vector3d::Zero());
      const std::vector<double> numbers(trace.size(), 0.0);
      for (const char* name : {"hand_position", "device_position", "repulse_force", "drag_force"})
        file.write(std::string("/trace/") + name, vectors);
      for (const char* name : {"displaced_volume", "passivity_margin"})
        file.write(std::string("/trace/") + name, numbers);
      file.write("/trace/saturated", std::vector<std::uint32_t>(trace.size(), 0));
      file.write("/trace/time", trace.time);
      file.write("/trace/device_force", trace.device_force);
      file.write("/trace/level", trace.level);
      if (!trace.depth.empty()) file.write("/trace/depth", trace.depth);
      file.write("/trace/contact", trace.contact);
    }
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
