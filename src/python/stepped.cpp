#include "python/module_parts.h"

#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include <array>
#include <atomic>
#include <chrono>
#include <memory>
#include <mutex>
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
namespace {

namespace py = pybind11;

/// The simulation, and what else its scene's file says: the folder of the files it names, and the view.
class Stepped {
 public:
  /// Without surface it takes the scene's.
  Stepped(const SceneHere& here, bool relaxes, const py::object& surface)
      : folder_(here.folder), view_(here.scene.view) {
    std::optional<HeightField> start;
    if (!surface.is_none()) start = surface_of(here.scene, grid_with_gaps("surface", surface));
    Warnings warnings;
    {
      const WithoutLock let_go;
      const Scene scene = with_files(here.scene, folder_);
      simulation_ = std::make_unique<SteppedSimulation>(
          scene, start ? *start : load_surface(scene.bed, folder_), relaxes);
      start_ = copy_of(*simulation_);
    }
    warnings.give();
  }

  /// Gives work the simulation, without the interpreter lock, and in one thread after the other. Error:
  /// input, if a law of the simulation itself asks for it.
  template <class Work>
  auto use(const Work& work) {
    if (user_ == std::this_thread::get_id())
      throw_input_error("a law uses the simulation that has called it; let it use only its arguments");
    const WithoutLock let_go;
    const std::unique_lock<std::timed_mutex> turn = next_turn();
    const User user(user_);
    return work(*simulation_);
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
    auto simulation = std::make_unique<SteppedSimulation>(scene, starting_bed(bed));
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

  /// Tells which thread uses the simulation while it lives.
  struct User {
    explicit User(std::atomic<std::thread::id>& user) : thread(user) { thread = std::this_thread::get_id(); }
    ~User() { thread = std::thread::id(); }
    User(const User&) = delete;
    User& operator=(const User&) = delete;
    std::atomic<std::thread::id>& thread;
  };

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

/// Reads n numbers from a sequence or array. Error: input, naming `name`.
template <int n>
Eigen::Matrix<double, n, 1> vector_of(const py::handle& given, const char* name) {
  Eigen::Matrix<double, n, 1> vector;
  // The fast case. Not for classes derived from arrays: a masked one has any numbers under its mask.
  if (Py_TYPE(given.ptr()) == py::detail::npy_api::get().PyArray_Type_ &&
      py::isinstance<py::array_t<double>>(given)) {
    const auto array = py::reinterpret_borrow<py::array_t<double>>(given);
    if (array.ndim() == 1 && array.shape(0) == n) {
      for (int i = 0; i < n; ++i) vector[i] = *array.data(i);
      return vector;
    }
  } else {
    try {
      const auto numbers = given.cast<std::array<double, n>>();
      for (int i = 0; i < n; ++i) vector[i] = numbers[static_cast<std::size_t>(i)];
      return vector;
    } catch (const py::cast_error&) {
    }
  }
  throw_input_error("{}: give {} numbers", name, n);
}

py::array_t<double> array_of(const Eigen::Vector3d& vector) { return py::array_t<double>(3, vector.data()); }

TickRecord tick(Stepped& stepped, const py::object& position, const py::object& velocity, bool down,
                const py::object& orientation) {
  Hand hand;
  hand.position = vector_of<3>(position, "position");
  hand.down = down;
  const bool moves = !velocity.is_none(), turns = !orientation.is_none();
  if (moves) hand.velocity = vector_of<3>(velocity, "velocity");
  if (turns) {
    const Eigen::Vector4d q = vector_of<4>(orientation, "orientation");
    if (!(q.norm() > 1e-6)) throw_input_error("orientation: a quaternion x, y, z, w must not be 0");
    hand.orientation = Eigen::Quaterniond(q).normalized();
  }
  return or_what_ended_it([&] {
    return stepped.use([&](SteppedSimulation& simulation) {
      return TickRecord(simulation.tick(hand, {.velocity = moves, .orientation = turns}));
    });
  });
}

py::dict relax(Stepped& stepped) {
  SignalWatch signals;
  RelaxationRecord record;
  or_what_ended_it([&] {
    stepped.use([&](SteppedSimulation& simulation) {
      record.outcome = simulation.relax([&](std::int64_t, const BedNow&) { signals.look(); });
      record.time = simulation.time();
    });
  });
  py::dict result;
  visit_relaxation_fields([&](const FieldText& field, const auto& of) { result[field.name] = of(record); });
  result["converged"] = record.outcome.converged;
  return result;
}

}  // namespace

void add_stepped(py::module_& module) {
  py::class_<TickRecord>(module, "Tick", "The state of tool and force in a tick.")
      .def_readonly("time", &TickRecord::time, "Start of the tick [s].")
      .def_property_readonly(
          "force", [](const TickRecord& tick) { return array_of(tick.device_force); },
          "Force on the device [N], after limit and delay.")
      .def_property_readonly(
          "sand_force",
          [](const TickRecord& tick) {
            return array_of(Eigen::Vector3d(tick.repulse_force + tick.drag_force));
          },
          "Force of the sand on the tool [N], before limit and delay.")
      .def_property_readonly(
          "torque", [](const TickRecord& tick) { return array_of(tick.wrench.torque); },
          "Torque of the sand on the tool about its tip [N m]; 0 with force.law = \"paper\".")
      .def_readonly("depth", &TickRecord::depth,
                    "Depth of the tip below the sand's level [m]; negative above it.")
      .def_readonly("level", &TickRecord::level, "Height of the sand under the tool [m]; nan: there is none.")
      .def_readonly("contact", &TickRecord::contact, "Whether the tool touches sand.")
      .def_readonly("displaced_volume", &TickRecord::displaced_volume,
                    "Volume of the sand displaced in the tick [m^3].")
      .def_property_readonly(
          "position", [](const TickRecord& tick) { return array_of(tick.device_position); },
          "Position of the device as read [m].")
      .def("__repr__", [](const TickRecord& tick) {
        return fmt::format("<sandstroke.Tick at {:.4f} s: depth {:.3g} m, force ({:.3g}, {:.3g}, {:.3g}) N>",
                           tick.time, tick.depth, tick.device_force.x(), tick.device_force.y(),
                           tick.device_force.z());
      });
  py::class_<Stepped>(module, "_Simulation")
      .def(py::init<const SceneHere&, bool, const py::object&>())
      .def("tick", &tick, py::arg("position"), py::arg("velocity") = py::none(), py::kw_only(),
           py::arg("down") = true, py::arg("orientation") = py::none())
      .def("relax", &relax)
      .def("copy", &Stepped::copy)
      .def("reset", &Stepped::reset)
      .def("state", [](Stepped& stepped) { return py::bytes(stepped.state()); })
      .def("set_state", &Stepped::set_state)
      .def("save", &Stepped::save)
      .def_static("from_state", &Stepped::from_state)
      .def("lift", [](Stepped& stepped) { stepped.use([](SteppedSimulation& s) { s.lift(); }); })
      .def("height_at",
           [](Stepped& stepped, double x, double y) {
             return stepped.use([&](SteppedSimulation& s) { return s.bed().height_at(x, y); });
           })
      .def_property_readonly(
          "heights",
          [](Stepped& stepped) {
            return copy_of(stepped.use([](SteppedSimulation& s) { return HeightGrid(s.bed().grid()); }));
          })
      .def_property_readonly(
          "time", [](Stepped& stepped) { return stepped.use([](SteppedSimulation& s) { return s.time(); }); })
      .def_property_readonly("scene", &Stepped::scene)
      .def_property_readonly(
          "volume",
          [](Stepped& stepped) { return stepped.use([](SteppedSimulation& s) { return s.bed().volume(); }); })
      .def_property_readonly("cell_size",
                             [](const Stepped& stepped) { return stepped.settings().bed.cell_size(); })
      .def_property_readonly("x", [](const Stepped& stepped) { return columns_of(stepped.cells()); })
      .def_property_readonly("y", [](const Stepped& stepped) { return rows_of(stepped.cells()); });
}

}  // namespace sandstroke
