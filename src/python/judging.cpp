#include "python/module_parts.h"

#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <array>

#include "python/errors.h"
#include "python/interpreter_lock.h"
#include "python/plugin_laws.h"
#include "validation/stress/stress.h"
#include "validation/study/plugin_contenders.h"
#include "validation/study/study_files.h"
#include "validation/study/study_table.h"

namespace sandstroke {
namespace {

namespace py = pybind11;

std::vector<PluginLawSettings> settings_of(const py::dict& laws, const std::array<double, 4>& parameters) {
  PluginLawSettings plugin_laws = with_python_laws({}, laws).scene.plugin_laws;
  plugin_laws.plugin = "Python";
  plugin_laws.parameters = parameters;
  return single_laws(plugin_laws, {});
}

/// Runs the bench and returns JSON text. folder: for the page.
std::string bench(const py::dict& laws, const std::array<double, 4>& parameters,
                  const std::filesystem::path& folder, bool quick, const std::vector<std::string>& problems) {
  const std::vector<PluginLawSettings> plugin_laws = settings_of(laws, parameters);
  return or_what_ended_it([&] {
    const WithoutLock let_go;
    StudyOptions options;
    options.quick = quick;
    options.problems = problems;
    add_plugin_laws(options, plugin_laws);
    SignalWatch signals;
    options.progress = [&](double) { signals.look(); };
    const StudyFiles files(folder);
    const Study study = run_study(options);
    files.write(study);
    return study_json(study).dump();
  });
}

std::string stress(const py::dict& laws, const std::array<double, 4>& parameters, bool quick) {
  StressOptions options;
  options.plugin_laws = settings_of(laws, parameters);
  options.quick = quick;
  return or_what_ended_it([&] {
    const WithoutLock let_go;
    SignalWatch signals;
    options.progress = [&](double) { signals.look(); };
    return as_json(stress_all(options)).dump();
  });
}

}  // namespace

void add_judging(py::module_& module) {
  module.def("_bench", &bench);
  module.def("_stress", &stress);
}

}  // namespace sandstroke
