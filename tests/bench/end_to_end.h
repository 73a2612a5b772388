#pragma once

#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace sandstroke {

/// The thoroughness of the measurement.
struct BenchOptions {
  bool quick = false;  ///< seconds rather than minutes: smaller beds, shorter strokes
  std::string before;  ///< another build of the program, for `speed` to compare with
};

// The parts of the report. Each runs in a child process, so that none finds memory that another has warmed
// up.
nlohmann::json measure_paper_scene(const BenchOptions& options);
nlohmann::json measure_bed_sizes(const BenchOptions& options);
nlohmann::json measure_tile_sizes();
nlohmann::json measure_long_stroke(const BenchOptions& options);
nlohmann::json measure_cones(const BenchOptions& options);
nlohmann::json measure_rough_beds(const BenchOptions& options);
nlohmann::json measure_levels(const BenchOptions& options);
nlohmann::json measure_clones(const BenchOptions& options);
nlohmann::json measure_paper_law(const BenchOptions& options);
nlohmann::json measure_sweeps(const BenchOptions& options);
nlohmann::json measure_recording(const BenchOptions& options);
/// Rows of name, unit, value, and with a program to compare with: before, and how many times better it is
/// now; disturbed: repeats of one program differ by more than 20 %.
nlohmann::json measure_speed(const BenchOptions& options);
/// Ten minutes with pages that look on: memory must not grow.
nlohmann::json measure_soak(const BenchOptions& options);

/// Runs `measure` in a child process and adds "peak_rss_bytes": by how much it raised its resident memory.
nlohmann::json in_child(const std::function<nlohmann::json()>& measure);

double median(std::vector<double> values);

/// {median, least, largest} of repeated measurements.
nlohmann::json spread(const std::vector<double>& values);

}  // namespace sandstroke
