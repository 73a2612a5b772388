#pragma once

#include <spdlog/fmt/fmt.h>

#include "core/error.h"
#include "core/version.h"
#include "sim/plugin_laws.h"

namespace sandstroke {

#ifdef __FAST_MATH__  // sets the processor's mode for the whole program, and so changes bits
#define SANDSTROKE_FLOATING_POINT "fast"
#else
#define SANDSTROKE_FLOATING_POINT "exact"
#endif

/// Text in which a plugin must agree with the program that loads it: the library, the C++ ABI of the
/// compiler, and how objects lie in memory, which also depends on flags such as -march=native. Raise
/// `interface` by hand when a class that laws derive from changes. static: a plugin must not find another
/// library's, built with other flags.
static inline std::string plugin_interface() {
  constexpr int interface = 3;
  return fmt::format(
      "sandstroke {}, laws {}, C++ ABI {}.{}, Eigen {}.{}.{} aligned to {} and {} bytes, indices of {} "
      "bytes, {} floating point, objects of {} {} {} {} {} {} bytes aligned to {} {} {}",
      version, interface, __GXX_ABI_VERSION, _GLIBCXX_USE_CXX11_ABI, EIGEN_WORLD_VERSION, EIGEN_MAJOR_VERSION,
      EIGEN_MINOR_VERSION, EIGEN_MAX_ALIGN_BYTES, EIGEN_MAX_STATIC_ALIGN_BYTES, sizeof(Eigen::Index),
      SANDSTROKE_FLOATING_POINT, sizeof(Scene), sizeof(HeightField), sizeof(ToolFootprint), sizeof(Tool),
      sizeof(RelaxationOutcome), sizeof(Wrench), alignof(Scene), alignof(HeightField), alignof(Wrench));
}

}  // namespace sandstroke

/// The head of the function that a plugin (a shared library that links sandstroke::sim) defines once. Its
/// body adds the plugin's laws to `laws`.
#define SANDSTROKE_LAWS(laws)                                            \
  extern "C" const char* sandstroke_plugin_interface() {                 \
    static const std::string interface = sandstroke::plugin_interface(); \
    return interface.c_str();                                            \
  }                                                                      \
  extern "C" void sandstroke_plugin_laws(sandstroke::PluginLaws& laws)
