#pragma once

#include <pybind11/pybind11.h>

#include <atomic>
#include <chrono>
#include <filesystem>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include "core/error.h"
#include "io/scene_toml.h"
#include "io/state_file.h"
#include "io/surface_file.h"
#include "python/arrays.h"
#include "python/errors.h"
#include "python/interpreter_lock.h"
#include "python/kept_run.h"
#include "python/kept_simulation.h"
#include "sim/stepped_simulation.h"

namespace sandstroke {

/// The simulation, and what else its scene's file says: the folder of the files it names, and the view.
class Stepped {
 public:
  /// Without surface it takes the scene's.
  Stepped(const SceneHere& here, bool relaxes, const pybind11::object& surface)
      : folder_(std::filesystem::absolute(here.folder.empty() ? "." : here.folder)), view_(here.scene.view) {
    std::optional<HeightField> start;
    if (!surface.is_none()) start = surface_of(here.scene, grid_with_gaps("surface", surface));
    Warnings warnings;
    {
      const WithoutLock let_go;
      const Scene scene = with_files(here.scene, folder_);
      simulation_ = std::make_unique<SteppedSimulation>(
          scene, start ? on_ground(*start, scene) : load_bed(scene, folder_), relaxes);
      start_ = copy_of(*simulation_);
    }
    warnings.give();
  }

  /// The simulation for this thread alone, while it lives. Take it without the interpreter lock.
  class Turn {
   public:
    explicit Turn(Stepped& stepped) : stepped_(stepped), turn_(stepped.next_turn()) {
      stepped.user_ = std::this_thread::get_id();
    }
    ~Turn() { stepped_.user_ = std::thread::id(); }
    Turn(const Turn&) = delete;
    Turn& operator=(const Turn&) = delete;
    SteppedSimulation& simulation() const { return *stepped_.simulation_; }

   private:
    Stepped& stepped_;
    std::unique_lock<std::timed_mutex> turn_;
  };

  /// Gives work the simulation, without the interpreter lock, and in one thread after the other. Error:
  /// input, if a law of the simulation itself asks for it.
  template <class Work>
  auto use(const Work& work) {
    if (user_ == std::this_thread::get_id())
      throw_input_error("a law uses the simulation that has called it; let it use only its arguments");
    const WithoutLock let_go;
    const Turn turn(*this);
    return work(turn.simulation());
  }
  /// Its copies share the sand that none of them changed.
  std::unique_ptr<Stepped> copy() {
    auto copy =
        use([](SteppedSimulation& simulation) { return std::make_unique<SteppedSimulation>(simulation); });
    return std::unique_ptr<Stepped>(new Stepped(folder_, view_, std::move(copy), start_));
  }
  /// Goes back to where it began. Error: input, if a law of one's own cannot be copied.
  void reset() {
    if (!start_)
      throw_input_error(
          "a simulation with a law of your own that has no copy() cannot be reset; make a new one");
    use([&](SteppedSimulation& simulation) { simulation = *start_; });
  }
  /// Error: input, if a law of one's own has a part in it.
  std::string state() {
    KeptSimulation kept{scene_text(scene().scene), folder_.string(), {}};
    kept.state = use([](SteppedSimulation& simulation) { return simulation.state(); });
    return state_bytes(kept, simulation_state);
  }
  void set_state(const std::string& bytes) {
    const auto kept = read_state<KeptSimulation>(bytes, simulation_state, "the state");
    const std::string difference = scene_difference(scene_text(scene().scene), kept.scene, "simulation");
    if (!difference.empty()) throw_input_error("the state is of another scene: {}", difference);
    use([&](SteppedSimulation& simulation) { simulation.set_state(kept.state); });
  }
  void save(const std::filesystem::path& path) { write_text_file(path, state(), simulation_state); }
  /// From state(). It needs no file of the surface that the simulation began with.
  static std::unique_ptr<Stepped> from_state(const std::string& bytes, const std::string& name) {
    const auto kept = read_state<KeptSimulation>(bytes, simulation_state, name);
    const SceneFile file = scene_from_text(kept.scene, name);
    if (!file.plugin_laws.plugin.empty())
      throw_input_error("{}: names a plugin, whose state no file can keep", name);
    const std::filesystem::path folder = kept.folder;
    const WithoutLock let_go;
    const Scene scene = with_files(file, folder);
    BedSettings bed = scene.bed;
    if (bed.surface.kind == SurfaceKind::file)
      bed.surface.kind = SurfaceKind::flat;  // the state has all of it
    auto simulation = std::make_unique<SteppedSimulation>(scene, on_ground(starting_bed(bed), scene));
    simulation->set_state(kept.state);
    const auto start = copy_of(*simulation);
    return std::unique_ptr<Stepped>(new Stepped(folder, file.view, std::move(simulation), start));
  }

  const Scene& settings() const { return simulation_->scene(); }
  BedGeometry cells() const {
    const BedSettings& bed = settings().bed;
    return BedGeometry(bed.rows, bed.cols, bed.cell_size());
  }
  SceneHere scene() const { return {{simulation_->scene(), view_}, folder_}; }

 private:
  using Start = std::shared_ptr<const SteppedSimulation>;

  Stepped(std::filesystem::path folder, const ViewSettings& view,
          std::unique_ptr<SteppedSimulation> simulation, Start start)
      : folder_(std::move(folder)),
        view_(view),
        simulation_(std::move(simulation)),
        start_(std::move(start)) {}

  /// None, if a law of one's own cannot be copied.
  static Start copy_of(const SteppedSimulation& simulation) try {
    return std::make_shared<const SteppedSimulation>(simulation);
  } catch (const Error&) {
    return nullptr;
  }

  /// Waits for the threads that came first. Ctrl-C ends the wait, and so does the end of the interpreter: a
  /// daemon thread that sleeps from then on keeps its turn.
  std::unique_lock<std::timed_mutex> next_turn() {
    constexpr std::chrono::milliseconds interval(50);
    std::unique_lock turn(turn_, std::defer_lock);
    SignalWatch signals;
    while (!turn.try_lock_for(interval)) {
      signals.look();
      if (leaving()) throw_input_error("a daemon thread still uses the simulation; join it before the end");
    }
    return turn;
  }

  std::timed_mutex turn_;
  std::atomic<std::thread::id> user_;
  std::filesystem::path folder_;
  ViewSettings view_;
  std::unique_ptr<SteppedSimulation> simulation_;
  Start start_;  // shares the sand that nothing touched
};

}  // namespace sandstroke
