// A minute in the servo loop: where every tick went, how late they were, and what was allocated; without and
// with a load on all cores, and with sand under the hand while a bed of 1000 x 1000 cells collapses; and that
// with pages that show it.
#include <sys/resource.h>

#include <cmath>
#include <numbers>
#include <thread>

#include "allocations.h"
#include "bench/end_to_end.h"
#include "core/temporary_folder.h"
#include "record/journal.h"
#include "record/live_sand.h"
#include "record/recorder.h"
#include "record/stroke_device.h"
#include "view/view_client.h"
#include "view/view_server.h"

namespace sandstroke {
namespace {

/// Round and round, in and out of the sand, for so long.
Stroke winding(double seconds) {
  Stroke stroke;
  for (int i = 0; i <= static_cast<int>(100.0 * seconds); ++i) {
    const double t = 0.01 * i, angle = 2.0 * std::numbers::pi * t / 3.0;
    stroke.time.push_back(t);
    stroke.position.emplace_back(0.3 * std::cos(angle), 0.3 * std::sin(angle), 0.004 * std::cos(9.0 * t));
  }
  return stroke;
}

/// Counts what is allocated from the loop's first reading to its last, in its thread.
class WatchedDevice : public StrokeDevice {
 public:
  using StrokeDevice::StrokeDevice;
  bool read(double time, DeviceReading& reading) noexcept override {
    last_ = allocations_of_this_thread();
    if (first_ < 0) first_ = last_;
    return StrokeDevice::read(time, reading);
  }
  std::int64_t allocated() const { return last_ - first_; }

 private:
  std::int64_t first_ = -1, last_ = -1;
};

/// Keeps all cores busy, and their caches.
class Load {
 public:
  explicit Load(bool on) {
    if (!on) return;
    for (unsigned i = 0; i < std::thread::hardware_concurrency(); ++i) {
      threads_.emplace_back([](const std::stop_token& stop) {
        std::vector<double> memory(std::size_t{1} << 22, 1.0);  // 32 MB
        while (!stop.stop_requested())
          for (double& x : memory) x = std::sqrt(x + 1.0);
      });
    }
  }

 private:
  std::vector<std::jthread> threads_;
};

/// N: the largest change of the commanded force from one sample to the next.
double largest_jump(const std::filesystem::path& journal) {
  JournalReader reader(journal);
  double largest = 0.0;
  Eigen::Vector3d before = Eigen::Vector3d::Zero();
  for (auto samples = reader.next(1000); !samples.empty(); samples = reader.next(1000))
    for (const RecordedSample& sample : samples) {
      const Eigen::Vector3d force(sample.force);
      largest = std::max(largest, (force - before).norm());
      before = force;
    }
  return largest;
}

Scene collapsing_scene() {
  Scene scene;  // 2 m x 2 m, 1000 x 1000
  scene.bed.surface.kind = SurfaceKind::noise;
  scene.bed.surface.amplitude = 0.1;
  scene.relaxation.law = RelaxationLaw::isotropic;
  return scene;
}

/// Pages that take what they are sent, and one that takes nothing, while sand is recorded.
class Watched {
 public:
  Watched(const Scene& scene, const HeightField& bed, LiveSand& sand, double seconds)
      : seconds_(seconds),
        bed_(bed),
        server_({bed_, state_, {"bench", bed, height_range(bed), scene.tool, 12.0, {}}, "", nullptr}) {
    sand.show_to([this](const HeightField& now) { bed_.publish(now); });
    stalled_.emplace(server_.address());
    reader_ = std::thread([this] {
      ViewClient page(server_.address());
      page.hear_to_end();
      pictures_ = page.pictures;
      tiles_ = page.tiles_taken;
    });
  }
  void show(const ServoProgress& progress) {
    ViewState state;
    state.time = progress.time;
    state_.publish(state);
    if (progress.time <= 0.1 * seconds_) settled_memory_ = peak_memory();
  }
  nlohmann::json end() {
    server_.end("");
    reader_.join();
    return {{"pictures_per_second", pictures_ / seconds_},
            {"tiles_per_second", static_cast<double>(tiles_) / seconds_},
            {"peak_rss_bytes_after_a_tenth", settled_memory_},
            {"peak_rss_bytes", peak_memory()}};
  }

 private:
  static double peak_memory() {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return 1024.0 * static_cast<double>(usage.ru_maxrss);
  }

  double seconds_, settled_memory_ = 0.0;  // s, bytes
  LiveBed bed_;
  LiveState state_;
  ViewServer server_;
  std::optional<ViewClient> stalled_;
  int pictures_ = 0;
  std::int64_t tiles_ = 0;
  std::thread reader_;
};

/// A load that runs beside a recording.
struct Beside {
  bool load = false, sand = false, view = false;
};

nlohmann::json recorded(double seconds, const Beside& beside) {
  const TemporaryFolder folder;
  WatchedDevice device(winding(seconds), "winding");
  RecorderSettings settings;
  settings.servo.duration = seconds;
  settings.servo.force.max_force = 12.0;
  settings.servo.force.ramp = 0.0;
  std::optional<Watched> watched;
  std::optional<LiveSand> live;
  if (beside.sand) {
    const Scene scene = collapsing_scene();
    const HeightField bed = starting_bed(scene.bed);
    live.emplace(scene, bed, FeltDevice{"bed"});
    if (beside.view) watched.emplace(scene, bed, *live, seconds);
    if (beside.view) settings.watch = 1.0 / 60.0;
  }
  const Load busy(beside.load);
  if (live) live->start();
  const RecordingReport report = record(device, live ? &*live : nullptr, settings, {}, folder / "journal",
                                        [&](const ServoProgress& progress) {
                                          if (watched) watched->show(progress);
                                          return std::nullopt;
                                        });
  const TickCounts& ticks = report.footer.ticks;
  nlohmann::json result = {{"ticks_elapsed", ticks.elapsed},
                           {"recorded", ticks.recorded},
                           {"skipped", ticks.skipped},
                           {"unread", ticks.unread},
                           {"dropped", ticks.dropped},
                           {"late", ticks.late},
                           {"lateness_mean_us", 1e6 * report.footer.lateness.mean},
                           {"lateness_p99_us", 1e6 * report.footer.lateness.p99},
                           {"lateness_max_us", 1e6 * report.footer.lateness.max},
                           {"allocations_in_the_loop", device.allocated()},
                           {"scheduling", report.header.scheduling.policy},
                           {"largest_force_jump_N", largest_jump(folder / "journal")}};
  if (live) {
    const LiveSandReport felt = live->finish();
    result["contact_ticks"] = felt.contact_ticks;
    result["held_ticks"] = felt.deferred_ticks;
    result["rate_limited"] = ticks.rate_limited;
    result["relaxations"] = felt.relaxation.relaxations;
    result["passes"] = felt.relaxation.passes;
    result["most_changes_waiting"] = felt.relaxation.most_waiting;
    if (watched) result["view"] = watched->end();
  }
  return result;
}

}  // namespace

nlohmann::json measure_recording(const BenchOptions& options) {
  const double seconds = options.quick ? 1.0 : 60.0;
  return {{"seconds", seconds},
          {"alone", recorded(seconds, {})},
          {"under_load", recorded(seconds, {.load = true})},
          {"sand_alone", recorded(seconds, {.sand = true})},
          {"sand_under_load", recorded(seconds, {.load = true, .sand = true})},
          {"sand_and_view", recorded(seconds, {.sand = true, .view = true})},
          {"sand_and_view_under_load", recorded(seconds, {.load = true, .sand = true, .view = true})}};
}

nlohmann::json measure_soak(const BenchOptions& options) {
  return recorded(options.quick ? 5.0 : 600.0, {.sand = true, .view = true});
}

}  // namespace sandstroke
