#include <pybind11/numpy.h>
#include <pybind11/stl.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <set>

#include "python/module_parts.h"
#include "python/stepped.h"

namespace sandstroke {
namespace {

namespace py = pybind11;

using Numbers = py::array_t<double, py::array::c_style | py::array::forcecast>;
using Flags = py::array_t<bool, py::array::c_style | py::array::forcecast>;

/// What the hands of many simulations do, as rows of `width` numbers: (simulation, tick, width). Empty:
/// untold.
struct Rows {
  const double* numbers = nullptr;
  py::ssize_t width = 3;
  const double* at(std::size_t row) const { return numbers + row * static_cast<std::size_t>(width); }
};

/// Fields of ticks, as arrays (simulation, tick) or (simulation, tick, 3).
class TickArrays {
 public:
  TickArrays(py::ssize_t simulations, py::ssize_t ticks) {
    const auto make = [&]<class Number>(const char* name, Number*& numbers, py::ssize_t width) {
      std::vector<py::ssize_t> shape = {simulations, ticks};
      if (width > 1) shape.push_back(width);
      py::array_t<Number> array(shape);
      numbers = array.mutable_data();
      arrays_[name] = array;
    };
    make("time", time_, 1);
    make("force", force_, 3);
    make("sand_force", sand_force_, 3);
    make("torque", torque_, 3);
    make("depth", depth_, 1);
    make("level", level_, 1);
    make("contact", contact_, 1);
    make("carried", carried_, 1);
    make("displaced_volume", displaced_volume_, 1);
    make("position", position_, 3);
  }
  void set(std::size_t row, const TickRecord& tick) const {
    const auto put = [row](double* numbers, const Eigen::Vector3d& vector) {
      std::copy_n(vector.data(), 3, numbers + 3 * row);
    };
    time_[row] = tick.time;
    put(force_, tick.device_force);
    put(sand_force_, tick.repulse_force + tick.drag_force);
    put(torque_, tick.wrench.torque);
    depth_[row] = tick.depth;
    level_[row] = tick.level;
    contact_[row] = tick.contact;
    carried_[row] = tick.carried;
    displaced_volume_[row] = tick.displaced_volume;
    put(position_, tick.device_position);
  }
  py::dict arrays() const { return arrays_; }

 private:
  double *time_, *force_, *sand_force_, *torque_, *depth_, *level_, *carried_, *displaced_volume_, *position_;
  bool* contact_;
  py::dict arrays_;
};

/// Error: input, if a simulation is there twice, or has a law that is a Python function: it would wait for
/// the interpreter lock, as all others would.
void check_simulations(const std::vector<Stepped*>& simulations) {
  std::set<const Stepped*> known;
  for (std::size_t i = 0; i < simulations.size(); ++i) {
    if (!known.insert(simulations[i]).second)
      throw_input_error("simulations: number {} is there twice; give a copy()", i);
    const PluginLawSettings& laws = simulations[i]->settings().plugin_laws;
    if (laws.plugin.empty() && !(laws.relaxation.empty() && laws.displacement.empty() && laws.force.empty()))
      throw_input_error("simulations: number {} has a law that is a Python function; step it by tick()", i);
  }
}

/// hands, velocities: (simulation, tick, 3); orientations: (simulation, tick, 4) or none; down: (simulation,
/// tick).
py::dict step_many(const std::vector<Stepped*>& simulations, const Numbers& hands, const Flags& down,
                   const std::optional<Numbers>& velocities, const std::optional<Numbers>& orientations,
                   int threads) {
  check_simulations(simulations);
  const auto count = simulations.size(), ticks = static_cast<std::size_t>(hands.shape(1));
  const TickArrays result(hands.shape(0), hands.shape(1));
  const Rows position{hands.data()}, velocity{velocities ? velocities->data() : nullptr},
      turn{orientations ? orientations->data() : nullptr, 4};
  const bool* const is_down = down.data();
  const auto hand_of = [&](std::size_t row) {
    Hand hand;
    hand.position = Eigen::Map<const Eigen::Vector3d>(position.at(row));
    hand.down = is_down[row];
    if (velocity.numbers) hand.velocity = Eigen::Map<const Eigen::Vector3d>(velocity.at(row));
    if (turn.numbers) {
      const Eigen::Map<const Eigen::Vector4d> q(turn.at(row));
      if (!(q.norm() > 1e-6)) throw_input_error("a quaternion x, y, z, w must not be 0");
      hand.orientation = Eigen::Quaterniond(Eigen::Vector4d(q)).normalized();
    }
    return hand;
  };
  const ToldMotion told{velocity.numbers != nullptr, turn.numbers != nullptr};

  std::vector<std::optional<Error>> failures(count);
  or_what_ended_it([&] {
    const WithoutLock let_go;
    std::vector<Stepped*> in_order = simulations;  // so that two calls do not wait for each other
    std::sort(in_order.begin(), in_order.end());
    std::vector<std::unique_ptr<Stepped::Turn>> turns;
    for (Stepped* stepped : in_order) turns.push_back(std::make_unique<Stepped::Turn>(*stepped));
    std::vector<SteppedSimulation*> all(count);
    for (std::size_t i = 0; i < count; ++i)
      all[i] =
          &turns[static_cast<std::size_t>(std::lower_bound(in_order.begin(), in_order.end(), simulations[i]) -
                                          in_order.begin())]
               ->simulation();
    SignalWatch signals;
    const std::thread::id caller = std::this_thread::get_id();
    const auto step = [&](std::size_t i) {
      try {
        for (std::size_t k = 0; k < ticks; ++k) {
          if (std::this_thread::get_id() == caller) signals.look();
          const std::size_t row = i * ticks + k;
          result.set(row, all[i]->tick(hand_of(row), told));
        }
      } catch (const Error& error) {
        failures[i] = error;
      }
    };
    tbb::task_arena arena(threads > 0 ? threads : tbb::task_arena::automatic);
    arena.execute([&] { tbb::parallel_for(std::size_t{0}, count, step); });
  });
  for (std::size_t i = 0; i < count; ++i)
    if (failures[i])
      throw Error(failures[i]->kind(), fmt::format("simulation {}: {}", i, failures[i]->what()));
  return result.arrays();
}

}  // namespace

void add_step_many(py::module_& module) { module.def("_step_many", &step_many); }

}  // namespace sandstroke
