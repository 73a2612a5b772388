#include "python/plugin_laws.h"

#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include <array>
#include <cmath>
#include <memory>
#include <stdexcept>

#include "core/error.h"
#include "python/arrays.h"
#include "python/errors.h"
#include "python/interpreter_lock.h"
#include "sim/plugin_laws.h"

namespace sandstroke {
namespace {

namespace py = pybind11;

/// A user's function. It may be destroyed without the interpreter lock.
class Function {
 public:
  explicit Function(py::object function)
      : function_(new py::object(std::move(function)), [](py::object* kept) {
          if (leaving()) return;  // the interpreter frees all, or is no more
          const WithLock interpreter;
          delete kept;
        }) {}
  /// Call it with the interpreter lock. An exception of the function becomes an error sentence.
  template <class... Arguments>
  py::object operator()(Arguments&&... arguments) const {
    try {
      return (*function_)(std::forward<Arguments>(arguments)...);
    } catch (const py::error_already_set& raised) {
      throw_raised(raised);
    }
  }

 private:
  std::shared_ptr<py::object> function_;
};

/// Sets the cells that a function changed, from (first_row, first_col) on. Returns the moved volume [m^3].
double take_changes(HeightField& bed, int first_row, int first_col, const HeightGrid& before,
                    const HeightGrid& after) {
  double moved = 0.0;
  for (int row = 0; row < before.rows(); ++row)
    for (int col = 0; col < before.cols(); ++col) {
      const double height = after(row, col);
      if (height == before(row, col)) continue;
      moved += 0.5 * std::abs(height - before(row, col)) * bed.cell_size() * bed.cell_size();
      bed.set(first_row + row, first_col + col, height);
    }
  return moved;
}

/// A dict of the numbers that laws may need.
py::dict numbers_of(const Scene& scene, double cell_size) {
  using namespace py::literals;
  return py::dict("cell_size"_a = cell_size, "talus_slope"_a = talus_slope(scene.relaxation.talus_angle),
                  "tolerance"_a = scene.relaxation.tolerance, "radius"_a = scene.tool.radius,
                  "servo_rate"_a = scene.device.servo_rate, "parameters"_a = scene.plugin_laws.parameters);
}

class PythonRelaxer : public Relaxer {
 public:
  PythonRelaxer(Function law, const Scene& scene, double cell_size)
      : law_(std::move(law)), scene_(scene), cell_size_(cell_size) {}

  RelaxationOutcome relax(HeightField& bed, const PassWatcher& after_pass) override {
    const HeightGrid before = bed.grid();
    RelaxationOutcome outcome;
    {
      const WithLock interpreter;
      const SharedGrid heights(before);
      py::array_t<bool> walls({before.rows(), before.cols()});
      for (int row = 0; row < bed.rows(); ++row)
        for (int col = 0; col < bed.cols(); ++col) walls.mutable_at(row, col) = bed.is_wall(row, col);
      const py::object passes = law_(heights.array, walls, **numbers_of(scene_, cell_size_));
      try {
        outcome.passes = passes.is_none() ? 1 : passes.cast<std::int64_t>();
      } catch (const py::cast_error&) {
        throw std::runtime_error(
            "it must change heights in place, and return nothing or the number of passes");
      }
      const HeightGrid& after = *heights.grid;
      for (int row = 0; row < bed.rows(); ++row)
        for (int col = 0; col < bed.cols(); ++col)
          if (bed.is_wall(row, col) && after(row, col) != before(row, col))
            throw std::runtime_error(fmt::format("it changed the wall in row {}, column {}", row, col));
      outcome.moved_volume = take_changes(bed, 0, 0, before, after);
    }
    // The law of the scene's settings decides, without moving sand, whether the bed is at rest.
    HeightField seen = bed;
    RelaxationSettings look = scene_.relaxation;
    look.max_passes = 0;
    const RelaxationOutcome left = make_relaxer(look, cell_size_)->relax(seen);
    outcome.residual = left.residual;
    outcome.converged = left.converged;
    if (after_pass) after_pass(outcome.passes, [&]() -> const HeightField& { return bed; });
    return outcome;
  }

 private:
  Function law_;
  Scene scene_;
  double cell_size_;
};

class PythonDisplacer : public Displacer {
 public:
  PythonDisplacer(Function law, const Scene& scene, double cell_size)
      : law_(std::move(law)), scene_(scene), cell_size_(cell_size) {}

  double displace(HeightField& bed, const Tool& tool, double tip_height,
                  const Eigen::Vector3d& motion) override {
    const WithLock interpreter;
    const ToolFootprint& footprint = tool.footprint();
    const CellRange& cells = footprint.cells();
    HeightGrid before(cells.rows(), cells.cols()), underside(cells.rows(), cells.cols());
    for (int row = 0; row < cells.rows(); ++row)
      for (int col = 0; col < cells.cols(); ++col) {
        before(row, col) = footprint.heights(row)[col];
        underside(row, col) = tip_height + footprint.underside(row)[col];
      }
    const SharedGrid heights(before);
    law_(heights.array, copy_of(underside), py::array_t<double>(3, motion.data()),
         **numbers_of(scene_, cell_size_));
    return take_changes(bed, cells.row_begin, cells.col_begin, before, *heights.grid);
  }

 private:
  Function law_;
  Scene scene_;
  double cell_size_;
};

class PythonForce : public ToolForce {
 public:
  PythonForce(Function law, const Scene& scene, double cell_size)
      : law_(std::move(law)), scene_(scene), cell_size_(cell_size) {}

  Wrench feel(const ToolInSand& touch) override {
    const WithLock interpreter;
    const py::object given = law_(touch.depth, py::array_t<double>(3, touch.motion.data()),
                                  py::array_t<double>(3, touch.tip.data()), **numbers_of(scene_, cell_size_));
    Wrench wrench;
    try {
      const auto force = given.cast<std::array<double, 3>>();
      wrench.force = {force[0], force[1], force[2]};
    } catch (const py::cast_error&) {
      throw std::runtime_error("it must return three numbers, the force on the tool in N");
    }
    // Devices get the stiffness of a spring to the surface.
    wrench.strength = wrench.force.norm();
    wrench.stiffness = touch.depth > 0.0 ? wrench.strength / touch.depth : 0.0;
    wrench.stored = 0.5 * wrench.strength * std::max(touch.depth, 0.0);
    return wrench;
  }

 private:
  Function law_;
  Scene scene_;
  double cell_size_;
};

}  // namespace

SceneHere with_python_laws(SceneHere here, const py::dict& laws) {
  if (laws.empty()) return here;
  PluginLawSettings& plugin_laws = here.scene.plugin_laws;
  if (!plugin_laws.plugin.empty())
    throw_input_error("laws: the scene already has laws from model.plugin; remove one of the two");
  if (!here.scene.ground.empty() || here.scene.moisture)
    throw_input_error(
        "laws: a law of your own knows no bed.floor, stone, sand.map, sand.region, sand.layer or moisture; "
        "remove them from the scene, or leave the laws out");
  auto made = std::make_shared<PluginLaws>();
  for (const auto& [key, function] : laws) {
    const auto kind = key.cast<std::string>();
    const std::string name = py::str(py::getattr(function, "__name__", py::str("law")));
    if (!PyCallable_Check(function.ptr())) throw_input_error("laws: {} is not a function", kind);
    const Function law(py::reinterpret_borrow<py::object>(function));
    if (kind == "relaxation") {
      plugin_laws.relaxation = name;
      made->relaxations[name] = [law](const Scene& scene, double cell_size) {
        return std::make_unique<PythonRelaxer>(law, scene, cell_size);
      };
    } else if (kind == "displacement") {
      plugin_laws.displacement = name;
      made->displacements[name] = [law](const Scene& scene, double cell_size) {
        return std::make_unique<PythonDisplacer>(law, scene, cell_size);
      };
    } else if (kind == "force") {
      plugin_laws.force = name;
      made->forces[name] = [law](const Scene& scene, double cell_size) {
        return std::make_unique<PythonForce>(law, scene, cell_size);
      };
    } else {
      throw_input_error("laws: unknown kind '{}'; use relaxation, displacement or force", kind);
    }
  }
  plugin_laws.laws = std::move(made);
  return here;
}

}  // namespace sandstroke
