#include "io/plugin_file.h"

#include <dlfcn.h>

#include <cfenv>

#include "core/error.h"
#include "core/input_file.h"
#include "io/stroke_file.h"
#include "sim/plugin.h"

namespace sandstroke {
namespace {

template <class Function>
Function* function_of(void* library, const char* name, const std::string& file) {
  void* const found = dlsym(library, name);
  if (!found)
    throw_input_error(
        "{}: is not a plugin, because it has no {}; write SANDSTROKE_LAWS(laws) {{ ... }} in one of its "
        "files, and build it again",
        file, name);
  return reinterpret_cast<Function*>(found);
}

/// Opens a library, and keeps how this thread rounds: what -ffast-math links into it lets tiny numbers be
/// zero.
void* open_library(const std::filesystem::path& path) {
  std::fenv_t rounding;
  std::fegetenv(&rounding);
  void* const library = dlopen(std::filesystem::absolute(path).c_str(), RTLD_NOW | RTLD_LOCAL);
  std::fesetenv(&rounding);
  return library;
}

}  // namespace

std::shared_ptr<const PluginLaws> load_plugin(const std::filesystem::path& path) {
  const std::string file = path.string();
  auto laws = std::make_shared<PluginLaws>();
  laws->hash = file_hash(path);  // this reports a file that cannot be read
  // The library is never closed: its laws, and what they throw, may be in use anywhere.
  void* const library = open_library(path);
  if (!library) {
    const char* const why = dlerror();
    throw_input_error(
        "{}: cannot be loaded as a plugin ({}); build it again, with add_library(... MODULE ...)", file,
        why ? why : "no reason given");
  }
  const std::string theirs = function_of<const char*()>(library, "sandstroke_plugin_interface", file)(),
                    ours = plugin_interface();
  if (theirs != ours)
    throw_input_error(
        "{}: was built for {}, but this program is {}; build it again, for this version and without flags "
        "that change how objects lie in memory or how numbers are rounded, such as -march=native and "
        "-ffast-math",
        file, theirs, ours);
  const auto add_laws = function_of<void(PluginLaws&)>(library, "sandstroke_plugin_laws", file);
  try {
    add_laws(*laws);
  } catch (const Error&) {
    throw;
  } catch (const std::exception& failure) {
    throw_input_error("{}: SANDSTROKE_LAWS failed: {}; correct it", file, failure.what());
  }
  if (laws->relaxations.empty() && laws->displacements.empty() && laws->forces.empty())
    throw_input_error("{}: has no laws; add some in its SANDSTROKE_LAWS", file);
  return laws;
}

PluginLawSettings with_plugin(PluginLawSettings own, const std::filesystem::path& folder) {
  if (!own.plugin.empty() && !own.laws) own.laws = load_plugin(folder / own.plugin);
  return own;
}

void check_plugin_force(const Scene& scene, const std::filesystem::path& stroke_file) {
  if (scene.plugin_laws.force.empty() || is_pipe(stroke_file) || !stroke_depends_on_force(stroke_file))
    return;
  throw_input_error(
      "{}: the script gives forces, but only the paper's law can turn forces into depths; give depths, or "
      "leave out model.force = \"{}\"",
      stroke_file.string(), scene.plugin_laws.force);
}

}  // namespace sandstroke
