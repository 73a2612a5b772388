// Strokes replayed: against the clock, against the plain reference, and on beds of all sizes.
#include <unistd.h>

#include <chrono>
#include <cstring>
#include <fstream>
#include <set>
#include <utility>

#include "bench/end_to_end.h"
#include "core/hash.h"
#include "core/stopwatch.h"
#include "haptics/stroke_script.h"
#include "sand/relaxation.h"
#include "sim/simulation.h"

namespace sandstroke {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point begin) {
  return std::chrono::duration<double>(Clock::now() - begin).count();
}

/// A stroke like strokes/wscg: "WSCG" at 0.25 m/s, 4 mm deep; one line of it per base line.
Stroke wscg(double letter_height, double left, const std::vector<double>& base_lines,
            double least_seconds = 0.0) {
  StrokeScript script;
  script.start = {left, 0.0};
  script.travel_speed = 0.8;
  script.plunge_speed = 0.1;
  for (const double y : base_lines) {
    ScriptText text;
    text.text = "WSCG";
    text.at = {left, y};
    text.height = letter_height;
    script.segments.push_back({text, {PressProfile::Kind::depth, {0.004}}, 0.25});
  }
  Stroke stroke = trace_script(script, {});
  if (stroke.duration() < least_seconds) {
    script.repeat = static_cast<int>(std::ceil(least_seconds / stroke.duration()));
    stroke = trace_script(script, {});
  }
  return stroke;
}

/// Adds up the time spent in relaxations.
class RelaxationClock : public SimulationObserver {
 public:
  void on_tick(const TickRecord&) override { begin_ = Clock::now(); }  // what comes due follows
  void on_progress(double) override { begin_ = Clock::now(); }         // the last relaxation follows
  void on_relaxation(const RelaxationRecord&) override { seconds_ += seconds_since(begin_); }
  double seconds() const { return seconds_; }

 private:
  Clock::time_point begin_;
  double seconds_ = 0.0;
};

struct Replay {
  RunResult result;
  double cpu_seconds;
  double relaxation_seconds;
  HeightField bed;
};

Replay replay(const Scene& scene, const Stroke& stroke, std::unique_ptr<Relaxer> relaxer = nullptr) {
  Simulation simulation(scene, HeightField(scene.bed.rows, scene.bed.cols, scene.bed.cell_size()), stroke,
                        std::move(relaxer));
  RelaxationClock clock;
  const double cpu_begin = processor_seconds();
  const RunResult result = simulation.run({&clock});
  return {result, processor_seconds() - cpu_begin, clock.seconds(), simulation.bed()};
}

/// The first moments of contact with the engine and the reference, and what the whole stroke would take the
/// reference.
nlohmann::json against_reference(const Scene& scene, const Stroke& stroke, const Replay& whole,
                                 double contact_seconds) {
  std::size_t first = 0;
  while (stroke.position[first].z() >= 0.0) ++first;
  StrokePlacement cut;
  cut.start = stroke.time[first] - stroke.time[0];
  cut.stop = cut.start + contact_seconds;
  const Stroke beginning = place_stroke(stroke, cut);
  std::vector<double> tiles_seconds;
  std::optional<Replay> tiles;
  for (int i = 0; i < 5; ++i) {
    tiles = replay(scene, beginning);
    tiles_seconds.push_back(tiles->relaxation_seconds);
  }
  RelaxationSettings plain = scene.relaxation;
  plain.method = RelaxationMethod::plain;
  const Replay reference = replay(scene, beginning, make_relaxer(plain, scene.bed.cell_size()));

  const HeightGrid a = tiles->bed.grid(), b = reference.bed.grid();
  const bool same = std::memcmp(a.data(), b.data(), static_cast<std::size_t>(a.size()) * sizeof(double)) == 0;
  const auto sweeps = [](const RunResult& r) {
    return static_cast<double>(r.relaxation.passes + r.relaxations);
  };
  const double reference_seconds =
      reference.relaxation_seconds / sweeps(reference.result) * sweeps(whole.result);
  return {
      {"contact_seconds", contact_seconds},
      {"relaxations", reference.result.relaxations},
      {"passes", reference.result.relaxation.passes},
      {"same_bits", same},
      {"same_passes", reference.result.relaxation.passes == tiles->result.relaxation.passes},
      {"tiles_seconds_per_relaxation",
       median(tiles_seconds) / static_cast<double>(reference.result.relaxations)},
      {"reference_seconds_per_relaxation",
       reference.relaxation_seconds / static_cast<double>(reference.result.relaxations)},
      {"ratio", reference.relaxation_seconds / median(tiles_seconds)},
      {"whole_stroke",
       {{"note",
         "reference extrapolated: its time per sweep of the field, times the whole stroke's passes, and one "
         "sweep more per relaxation"},
        {"reference_seconds", reference_seconds},
        {"ratio", reference_seconds / whole.relaxation_seconds}}}};
}

}  // namespace

nlohmann::json measure_paper_scene(const BenchOptions& options) {
  Scene scene;  // the paper's: 2 m x 2 m, 1000 x 1000, R = 0.01 m, 1 kHz, relaxed at 60 Hz to 1e-3
  const Stroke stroke =
      options.quick ? wscg(0.44, -0.9, {-0.18}) : wscg(0.44, -0.9, {-0.94, -0.46, 0.02, 0.5}, 60.0);
  std::vector<double> seconds, cpu, relaxation_seconds;
  std::optional<Replay> run;
  for (int i = 0; i < (options.quick ? 3 : 5); ++i) {
    run = replay(scene, stroke);
    seconds.push_back(run->result.wall_seconds);
    cpu.push_back(run->cpu_seconds);
    relaxation_seconds.push_back(run->relaxation_seconds);
  }
  run->relaxation_seconds = median(relaxation_seconds);
  const RunResult& r = run->result;
  return {{"stroke_seconds", r.simulated_seconds},
          {"contact_share", static_cast<double>(r.contact_ticks) / static_cast<double>(r.ticks)},
          {"wall_seconds", spread(seconds)},
          {"cpu_seconds", spread(cpu)},
          {"relaxation_seconds", spread(relaxation_seconds)},
          {"real_time_factor", r.simulated_seconds / median(seconds)},
          {"ns_per_tick", 1e9 * median(cpu) / static_cast<double>(r.ticks)},
          {"relaxations", r.relaxations},
          {"passes", r.relaxation.passes},
          {"cells_per_pass",
           static_cast<double>(r.relaxation.cells_visited) / static_cast<double>(r.relaxation.passes)},
          {"ns_per_cell_and_pass",
           1e9 * median(relaxation_seconds) / static_cast<double>(r.relaxation.cells_visited)},
          {"converged", r.relaxation.converged},
          {"volume_drift", r.volume_drift},
          {"against_reference", against_reference(scene, stroke, *run, options.quick ? 0.05 : 0.25)}};
}

nlohmann::json measure_bed_sizes(const BenchOptions& options) {
  const Stroke stroke = wscg(0.1, -0.21, {-0.2, -0.05, 0.1});  // fits 256 cells of 2 mm
  std::vector<int> sides = {256, 1000, 4096, 16384, 65536};
  std::vector<std::vector<nlohmann::json>> runs(sides.size());
  for (int repeat = 0; repeat < (options.quick ? 3 : 9); ++repeat)
    for (std::size_t i = 0; i < sides.size(); ++i)
      runs[i].push_back(in_child([&] {
        Scene scene;
        scene.bed.cols = scene.bed.rows = sides[i];
        scene.bed.width = scene.bed.depth = sides[i] * 0.002;
        const Replay run = replay(scene, stroke);
        return nlohmann::json{{"ns_per_tick", 1e9 * run.cpu_seconds / static_cast<double>(run.result.ticks)},
                              {"bed_bytes", run.bed.bytes()},
                              {"tiles", run.bed.allocated_tiles()},
                              {"passes", run.result.relaxation.passes}};
      }));
  nlohmann::json rows = nlohmann::json::array();
  for (std::size_t i = 0; i < sides.size(); ++i) {
    std::vector<double> ns, rss;
    for (const auto& run : runs[i]) {
      ns.push_back(run["ns_per_tick"]);
      rss.push_back(run["peak_rss_bytes"]);
    }
    nlohmann::json row = runs[i].front();
    row["cells"] = sides[i];
    row["ns_per_tick"] = spread(ns);
    row["peak_rss_bytes"] = median(rss);
    row["ns_per_tick_over_smallest"] =
        i == 0 ? 1.0 : median(ns) / rows[0]["ns_per_tick"]["median"].get<double>();
    rows.push_back(row);
  }
  return rows;
}

/// The memory of the cells that the strokes/wscg run changes in tiles of other sizes: counted, not timed.
nlohmann::json measure_tile_sizes() {
  const Replay run = replay({}, wscg(0.44, -0.9, {-0.18}));
  const HeightGrid heights = run.bed.grid();
  nlohmann::json result = {{"changed_cells", (heights != 0.0).count()},
                           {"tiles_of_the_run", run.bed.allocated_tiles()},
                           {"bytes_of_the_run", run.bed.bytes()}};
  for (const int side : {32, 64, 128}) {
    std::set<std::pair<int, int>> blocks;
    for (int row = 0; row < heights.rows(); ++row)
      for (int col = 0; col < heights.cols(); ++col)
        if (heights(row, col) != 0.0) blocks.emplace(row / side, col / side);
    const int per_side = (run.bed.rows() + side - 1) / side;
    // Heights, a flag per cell, what else a tile holds, its pointer; and its number, for each of the bed.
    const std::size_t bytes =
        blocks.size() * (side * side * 8 + side * side / 8 + 64 + 8) + 4 * per_side * per_side;
    result["sides"].push_back({{"side", side}, {"blocks", blocks.size()}, {"bytes", bytes}});
  }
  return result;
}

namespace {

/// The CPU time of each minute of a stroke, and the memory that is resident at its end.
class Minutes : public SimulationObserver {
 public:
  explicit Minutes(double seconds) : seconds_(seconds) {}
  void on_tick(const TickRecord& record) override {
    if (record.time < seconds_ * static_cast<double>(cpu_seconds.size() + 1)) return;
    const double now = processor_seconds();
    cpu_seconds.push_back(now - std::exchange(last_, now));
    std::int64_t pages = 0, resident = 0;
    std::ifstream("/proc/self/statm") >> pages >> resident;
    resident_bytes.push_back(static_cast<double>(resident * sysconf(_SC_PAGESIZE)));
  }
  std::vector<double> cpu_seconds, resident_bytes;

 private:
  double seconds_, last_ = processor_seconds();
};

}  // namespace

/// The paper's scene for an hour, twice: WSCG over and over, by a hand that never stops.
nlohmann::json measure_long_stroke(const BenchOptions& options) {
  const double minute = options.quick ? 1.0 : 60.0;  // s
  const Stroke stroke = wscg(0.44, -0.9, {-0.18}, 60.0 * minute);
  nlohmann::json runs = nlohmann::json::array();
  for (int i = 0; i < 2; ++i) {
    Scene scene;
    Simulation simulation(scene, HeightField(scene.bed.rows, scene.bed.cols, scene.bed.cell_size()), stroke);
    Minutes minutes(minute);
    const RunResult result = simulation.run({&minutes});
    const HeightGrid heights = simulation.bed().grid();
    ContentHash hash;
    hash.add(heights.data(), static_cast<std::size_t>(heights.size()) * sizeof(double));
    const std::vector<double>&cpu = minutes.cpu_seconds, &memory = minutes.resident_bytes;
    // The first minutes carve what later ones find carved, so the end is compared with the second ten.
    const auto of = [&](const std::vector<double>& values, std::size_t first) {
      return median({values.begin() + first, values.begin() + first + 10});
    };
    runs.push_back({{"ticks", result.ticks},
                    {"content_hash", hash.text()},
                    {"moved_volume", result.moved_volume},
                    {"volume_drift", result.volume_drift},
                    {"passes", result.relaxation.passes},
                    {"minutes", cpu.size()},
                    {"first_minute_cpu_seconds", cpu.front()},
                    {"last_minute_cpu_seconds", cpu.back()},
                    {"minutes_10_to_20_cpu_seconds", of(cpu, 10)},
                    {"last_ten_minutes_cpu_seconds", of(cpu, cpu.size() - 10)},
                    {"first_minute_resident_bytes", memory.front()},
                    {"last_minute_resident_bytes", memory.back()}});
  }
  return {{"same_bits", runs[0]["content_hash"] == runs[1]["content_hash"]}, {"runs", runs}};
}

}  // namespace sandstroke
