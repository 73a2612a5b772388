#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <algorithm>
#include <limits>

#include "compare/compare_runs.h"
#include "core/error.h"
#include "core/interrupt.h"
#include "core/version.h"
#include "io/mesh_file.h"
#include "io/run_file.h"
#include "io/scene_toml.h"
#include "io/toml_reader.h"
#include "python/arrays.h"
#include "python/errors.h"
#include "python/interpreter_lock.h"
#include "python/kept_run.h"
#include "python/module_parts.h"
#include "python/plugin_laws.h"
#include "render/height_field_renderer.h"
#include "sand/ground.h"
#include "sim/scene_moisture.h"
#include "tool/tool_surface.h"

// The extension module on which src/python/sandstroke builds its functions. Names with a _ are not for users.

namespace sandstroke {
namespace {

namespace py = pybind11;
using Run = std::shared_ptr<KeptRun>;

py::array grid_view(const HeightGrid& grid, py::handle owner) {
  constexpr py::ssize_t number = sizeof(double);
  return view_of(grid.data(), {grid.rows(), grid.cols()}, {grid.cols() * number, number}, owner);
}

/// Lists the run's fields: name, units, meaning, array and names of its components for each.
py::list trace_columns(const py::object& self) {
  KeptRun& run = *self.cast<Run>();
  py::list columns;
  if (run.trace.empty()) return columns;
  visit_tick_fields([&](const FieldText& field, const auto& of) {
    if (field.only_with && !(run.content.*field.only_with)) return;
    using Field = std::decay_t<decltype(of(run.trace.front()))>;
    columns.append(py::make_tuple(field.name, field.units, field.meaning, column_view(run.trace, of, self),
                                  components_of<Field>()));
  });
  return columns;
}

py::list relaxation_columns(const py::object& self) {
  KeptRun& run = *self.cast<Run>();
  py::list columns;
  visit_relaxation_fields([&](const FieldText& field, const auto& of) {
    columns.append(
        py::make_tuple(field.name, field.units, field.meaning, column_view(run.relaxations, of, self), ""));
  });
  return columns;
}

py::array frames(const py::object& self) {
  const KeptRun& run = *self.cast<Run>();
  constexpr py::ssize_t number = sizeof(double);
  const py::ssize_t rows = run.initial.rows(), cols = run.initial.cols();
  return view_of(run.frames.data(), {static_cast<py::ssize_t>(run.frame_times.size()), rows, cols},
                 {rows * cols * number, cols * number, number}, self);
}

/// Tells the user, as a Python warning, what the settings left out.
void tell_left_out(const std::vector<LeftOut>& left_out) {
  Warnings warnings;
  if (!left_out.empty()) warnings.add("scene: " + left_out_text(left_out));
  warnings.give();
}

SceneHere scene_of_file(const std::filesystem::path& path, const std::vector<std::string>& overrides) {
  std::vector<LeftOut> left_out;
  SceneHere here{load_scene(path, overrides, &left_out), path.parent_path()};
  tell_left_out(left_out);
  return here;
}

/// own: overrides that belong to the text.
SceneHere scene_of_text(const std::string& text, const std::filesystem::path& folder,
                        const std::vector<std::string>& own, const std::vector<std::string>& overrides) {
  std::vector<LeftOut> left_out;
  SceneHere here{scene_from_text({text, "scene", own}, overrides, &left_out), folder};
  tell_left_out(left_out);
  return here;
}

/// A ground for pictures. floor [m]: not-a-number where there is none.
std::shared_ptr<const Ground> ground_of(const HeightGrid& floor, const BedGeometry& bed) {
  if (floor.rows() != bed.rows() || floor.cols() != bed.cols())
    throw_input_error("floor: must have as many rows and columns as heights");
  constexpr double no_slope = 0.0, none = -std::numeric_limits<double>::infinity();
  auto ground = std::make_shared<Ground>(bed, floor.isFinite().all() ? floor.minCoeff() : none, no_slope);
  for (int row = 0; row < bed.rows(); ++row)
    for (int col = 0; col < bed.cols(); ++col)
      if (floor(row, col) > ground->level()) ground->floor.set(row, col, floor(row, col));
  return ground;
}

/// Draws an array (height, width, 3) of 8 bits. Without tip it draws no tool; floor: None, or as Run.floor.
py::array picture(const SceneHere& here, const py::object& heights, const py::object& start,
                  const std::optional<std::array<double, 3>>& tip, const std::array<double, 4>& orientation,
                  const py::object& floor) {
  const SceneFile& scene = here.scene;
  const HeightGrid shown = grid_of("heights", heights), before = grid_of("start", start);
  if (before.rows() != shown.rows() || before.cols() != shown.cols())
    throw_input_error("start: must have as many rows and columns as heights");
  const HeightGrid lowest = floor.is_none() ? HeightGrid() : grid_with_gaps("floor", floor);
  Image image;
  {
    const WithoutLock let_go;
    RenderSubject subject;
    subject.view = scene.view;
    subject.crumbs = slope_of_crumbs(scene);
    const double cell_size = scene.bed.width / static_cast<double>(shown.cols());
    subject.start = start_heights(HeightField(before, cell_size));
    HeightGrid change;
    if (scene.view.style == RenderStyle::difference) {
      change = shown - before;
      subject.difference = &change;
    }
    if (tip) {
      subject.tool = ToolBody{Eigen::Vector3d((*tip)[0], (*tip)[1], (*tip)[2]), scene.tool.radius};
      if (scene.tool.shape != ToolShape::sphere) {
        const ToolSettings tool = with_mesh(scene.tool, here.folder);
        const Eigen::Quaterniond hand(orientation[3], orientation[0], orientation[1], orientation[2]);
        subject.tool->mesh = std::make_shared<TriangleMesh>(
            turned(tool_surface(tool), rotation_of(hand.normalized()) * own_rotation(tool)));
      }
    }
    HeightFieldRenderer renderer(static_cast<int>(shown.rows()), static_cast<int>(shown.cols()), cell_size);
    HeightField surface(shown, cell_size, scene.bed.shape);
    if (lowest.size() > 0) surface.lie_on(ground_of(lowest, surface));
    image = renderer.render(surface, subject);
  }
  py::array_t<std::uint8_t> array({image.height, image.width, 3});
  std::copy(image.rgb.begin(), image.rgb.end(), array.mutable_data());
  return py::array(array);
}

/// Error: input, where the options of `sandstroke compare` would refuse a number, or runs do not use it.
void check_tolerances(const GivenTolerances& given) {
  for (const auto& tolerance : given) {
    const auto& [name, value] = tolerance;
    const auto* key = std::find_if(tolerance_keys.begin(), tolerance_keys.end(),
                                   [&](const ToleranceKey& one) { return one.name == tolerance.first; });
    if (key == tolerance_keys.end() || name.starts_with("pixel"))
      throw_input_error("'{}' is not a tolerance of runs; use height, force or depth", name);
    if (!key->range.contains(value))
      throw_input_error("{} is {}; give a number {}", name, value, range_text(key->range));
  }
}

/// Compares two runs and returns JSON text.
std::string comparison(const std::filesystem::path& golden, const std::filesystem::path& run,
                       const GivenTolerances& given, bool coarsen) {
  const WithoutLock let_go;
  check_tolerances(given);
  const Tolerances tolerances = values_of(used_tolerances(given));
  return to_json(compare_runs(RunFile(golden), RunFile(run), tolerances, coarsen)).dump();
}

void add_run(py::module_& module) {
  py::class_<KeptRun, Run>(module, "_Run")
      .def_property_readonly("path", [](const KeptRun& run) { return run.path; })
      .def_property_readonly("scene", [](const KeptRun& run) { return run.scene; })
      .def_property_readonly("summary", [](const KeptRun& run) { return run.summary.dump(); })
      .def_property_readonly("cell_size", [](const KeptRun& run) { return run.bed.cell_size(); })
      .def_property_readonly("x", [](const KeptRun& run) { return columns_of(run.bed); })
      .def_property_readonly("y", [](const KeptRun& run) { return rows_of(run.bed); })
      .def_property_readonly(
          "initial", [](const py::object& self) { return grid_view(self.cast<Run>()->initial, self); })
      .def_property_readonly("final",
                             [](const py::object& self) { return grid_view(self.cast<Run>()->final, self); })
      .def_property_readonly("floor",
                             [](const py::object& self) {
                               const Run run = self.cast<Run>();
                               return run->floor.size() == 0 ? py::object(py::none())
                                                             : py::object(grid_view(run->floor, self));
                             })
      .def_property_readonly("frame_times",
                             [](const py::object& self) {
                               const KeptRun& run = *self.cast<Run>();
                               return view_of(run.frame_times.data(),
                                              {static_cast<py::ssize_t>(run.frame_times.size())},
                                              {sizeof(double)}, self);
                             })
      .def_property_readonly("frames", &frames)
      .def("trace_columns", &trace_columns)
      .def("relaxation_columns", &relaxation_columns);
}

}  // namespace

PYBIND11_MODULE(_sandstroke, module) {
  ignore_write_signals();
  module.attr("version") = version;
  add_errors(module);
  wait_for_threads_at_exit();
  py::class_<SceneHere>(module, "_Scene")
      .def_property_readonly("text", [](const SceneHere& here) { return scene_text(here.scene); })
      .def_property_readonly("folder", [](const SceneHere& here) { return here.folder; });
  add_run(module);
  add_stepped(module);
  add_judging(module);
  module.def("_scene_of_file", &scene_of_file);
  module.def("_scene_of_text", &scene_of_text);
  module.def("_run", [](const SceneHere& scene, const py::object& stroke, const py::object& surface,
                        const std::filesystem::path& output, int threads) {
    std::optional<Stroke> samples;
    if (!stroke.is_none()) samples = stroke_of(stroke.cast<py::dict>());
    std::optional<HeightField> start;
    if (!surface.is_none()) start = surface_of(scene.scene, grid_with_gaps("surface", surface));
    return or_what_ended_it(
        [&] { return kept_run(scene, std::move(samples), std::move(start), output, threads); });
  });
  module.def("_read", &read_run);
  module.def("_with_laws", &with_python_laws);
  module.def("_picture", &picture);
  module.def("_compare", &comparison);
}

}  // namespace sandstroke
