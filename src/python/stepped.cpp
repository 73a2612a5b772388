#include "python/stepped.h"

#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include <array>

#include "python/module_parts.h"
#include "sand/ground.h"

namespace sandstroke {
namespace {

namespace py = pybind11;

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

py::list sources_of(Stepped& stepped) {
  py::list sources;
  for (const SourceLedger& source : stepped.use([](SteppedSimulation& s) { return s.sources(); })) {
    py::dict row;
    visit_source_fields([&](const FieldText& field, const auto& of) { row[field.name] = of(source); });
    sources.append(row);
  }
  return sources;
}

py::object load_of(Stepped& stepped) {
  const auto load = stepped.use([](SteppedSimulation& s) {
    return s.load() ? std::optional(s.load()->ledger()) : std::optional<LoadLedger>();
  });
  if (!load) return py::none();
  py::dict row;
  visit_load_fields([&](const FieldText& field, const auto& of) { row[field.name] = of(*load); });
  return row;
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
      .def_readonly("carried", &TickRecord::carried, "Sand on the tool [kg].")
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
      .def_property_readonly("floor",
                             [](Stepped& stepped) -> py::object {
                               const HeightGrid floor = stepped.use([](SteppedSimulation& s) {
                                 return has_floor(s.bed()) ? floor_grid(*s.bed().ground()) : HeightGrid();
                               });
                               return floor.size() == 0 ? py::object(py::none()) : py::object(copy_of(floor));
                             })
      .def_property_readonly("sources", &sources_of)
      .def_property_readonly("on_tool", &load_of)
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
  add_step_many(module);
}

}  // namespace sandstroke
