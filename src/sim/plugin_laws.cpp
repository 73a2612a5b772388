#include "sim/plugin_laws.h"

#include <spdlog/fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/error.h"
#include "core/interrupt.h"
#include "sim/contact_force.h"
#include "tool/tool_surface.h"

namespace sandstroke {
namespace {

struct Stopped {};  // thrown through a law, which is not to catch it: no std::exception

/// Does something of a plugin law's. An Error passes: it is a sentence already, of the law or of who watches
/// it.
template <class Work>
auto by_law(const std::string& law, const Work& work) {
  try {
    return work();
  } catch (const Error&) {
    throw;
  } catch (const std::exception& failure) {
    throw_input_error("{} failed: {}; correct the law", law, failure.what());
  } catch (const Stopped&) {
    throw;
  } catch (...) {
    throw_input_error("{} failed without an error message; correct the law", law);
  }
}

/// Error: input, if the law cannot be copied.
template <class Law>
std::unique_ptr<Law> copy_of(const Law& plugin_law, const std::string& law) {
  std::unique_ptr<Law> copy = by_law(law, [&] { return plugin_law.copy(); });
  if (!copy) throw_input_error("{} cannot be copied with a simulation: it has no copy(); override that", law);
  return copy;
}

/// Error: unstable, where the volume [m^3] that a law says it has moved cannot be true.
void check_moved_volume(const std::string& law, double volume) {
  if (!(volume >= 0.0 && std::isfinite(volume)))
    throw Error(
        ErrorKind::unstable,
        fmt::format("{} reports a moved volume of {} m^3; it must be 0 or more, and finite; correct the law",
                    law, volume));
}

class WatchedRelaxer : public Relaxer {
 public:
  WatchedRelaxer(std::string law, std::unique_ptr<Relaxer> plugin_law)
      : law_(std::move(law)), plugin_law_(std::move(plugin_law)) {}
  std::unique_ptr<Relaxer> copy() const override {
    return std::make_unique<WatchedRelaxer>(law_, copy_of(*plugin_law_, law_));
  }

  RelaxationOutcome relax(HeightField& bed, const PassWatcher& after_pass) override {
    const BedGeometry before = bed;
    RelaxationOutcome outcome;
    try {
      outcome = by_law(law_, [&] {
        return plugin_law_->relax(bed, [&](std::int64_t passes, const BedNow& bed_now) {
          if (after_pass) after_pass(passes, bed_now);
          if (interrupted()) throw Stopped();
        });
      });
    } catch (const Stopped&) {
    }
    if (!(bed.rows() == before.rows() && bed.cols() == before.cols() && bed.shape() == before.shape() &&
          bed.cell_size() == before.cell_size()))
      throw_input_error(
          "{} replaced the bed by another one of {} x {} cells; let it only set the heights of the bed that "
          "it is given",
          law_, bed.cols(), bed.rows());
    check_moved_volume(law_, outcome.moved_volume);
    bed.clear_disturbed();
    return outcome;
  }

 private:
  std::string law_;
  std::unique_ptr<Relaxer> plugin_law_;
};

class WatchedDisplacer : public Displacer {
 public:
  WatchedDisplacer(std::string law, std::unique_ptr<Displacer> plugin_law)
      : law_(std::move(law)), plugin_law_(std::move(plugin_law)) {}
  std::unique_ptr<Displacer> copy() const override {
    return std::make_unique<WatchedDisplacer>(law_, copy_of(*plugin_law_, law_));
  }

  double displace(HeightField& bed, const Tool& tool, double tip_height,
                  const Eigen::Vector3d& motion) override {
    const double moved = by_law(law_, [&] { return plugin_law_->displace(bed, tool, tip_height, motion); });
    check_moved_volume(law_, moved);
    return moved;
  }

 private:
  std::string law_;
  std::unique_ptr<Displacer> plugin_law_;
};

class WatchedForce : public ToolForce {
 public:
  WatchedForce(std::string law, std::unique_ptr<ToolForce> plugin_law)
      : law_(std::move(law)), plugin_law_(std::move(plugin_law)) {}
  std::unique_ptr<ToolForce> copy() const override {
    return std::make_unique<WatchedForce>(law_, copy_of(*plugin_law_, law_));
  }

  Wrench feel(const ToolInSand& touch) override {
    Wrench wrench = by_law(law_, [&] { return plugin_law_->feel(touch); });
    if (!(wrench.force.allFinite() && wrench.torque.allFinite() && std::isfinite(wrench.stiffness) &&
          std::isfinite(wrench.stored) && std::isfinite(wrench.strength)))
      throw Error(ErrorKind::unstable,
                  fmt::format("{} gives a force that is not a number, {:.4g} m deep at x = {:.4g} m, y = "
                              "{:.4g} m; correct the law",
                              law_, touch.depth, touch.tip.x(), touch.tip.y()));
    wrench.strength = std::max(wrench.strength, wrench.force.norm());  // or a device's limit would not hold
    wrench.whole = wrench.strength;
    return wrench;
  }
  void lift() override {
    by_law(law_, [&] { plugin_law_->lift(); });
  }
  void turn(const Eigen::Matrix3d& rotation) override {
    by_law(law_, [&] { plugin_law_->turn(rotation); });
  }
  bool gives_wrench() const override { return plugin_law_->gives_wrench(); }

 private:
  std::string law_;
  std::unique_ptr<ToolForce> plugin_law_;
};

std::string file_of(const PluginLawSettings& plugin_law) {
  return plugin_law.plugin.empty() ? "" : plugin_law.plugin + ": ";
}

/// The law that a key names, made for the scene and watched; nullptr: it names none.
template <class Watched, class Law>
std::unique_ptr<Law> make_plugin_law(const Scene& scene, double cell_size, const char* key,
                                     const std::string& name,
                                     const std::map<std::string, LawMaker<Law>> PluginLaws::*kind) {
  if (name.empty()) return nullptr;
  if (!scene.plugin_laws.laws)
    throw_input_error("model.{} = \"{}\" names a plugin law; set model.plugin to the plugin's file", key,
                      name);
  const auto& makers = (*scene.plugin_laws.laws).*kind;
  const std::string file = file_of(scene.plugin_laws);
  if (const auto maker = makers.find(name); maker != makers.end()) {
    const std::string law = law_in_words(scene.plugin_laws, key, name);
    std::unique_ptr<Law> made = by_law(law, [&] { return maker->second(scene, cell_size); });
    if (!made) throw_input_error("{} was not made: its maker returned a null pointer; correct the law", law);
    return std::make_unique<Watched>(law, std::move(made));
  }
  std::vector<std::string> known;
  for (const auto& [one, maker] : makers) known.push_back(one);
  throw_input_error("{}has no {} law '{}' (model.{}); {}", file, key, name, key,
                    known.empty() ? std::string("it has no such law at all")
                                  : fmt::format("take one of: {}", fmt::join(known, ", ")));
}

}  // namespace

std::string law_in_words(const PluginLawSettings& plugin_law, const char* key, const std::string& name) {
  return fmt::format("{}{} '{}'", file_of(plugin_law), key, name);
}

std::unique_ptr<Relaxer> make_relaxer(const Scene& scene, double cell_size) {
  std::unique_ptr<Relaxer> plugin_law = make_plugin_law<WatchedRelaxer>(
      scene, cell_size, "relaxation", scene.plugin_laws.relaxation, &PluginLaws::relaxations);
  return plugin_law ? std::move(plugin_law) : make_relaxer(scene.relaxation, cell_size);
}

std::unique_ptr<Displacer> make_plugin_displacer(const Scene& scene, double cell_size) {
  return make_plugin_law<WatchedDisplacer>(scene, cell_size, "displacement", scene.plugin_laws.displacement,
                                           &PluginLaws::displacements);
}

std::unique_ptr<ToolForce> make_tool_force(const Scene& scene, double cell_size) {
  std::unique_ptr<ToolForce> plugin_law =
      make_plugin_law<WatchedForce>(scene, cell_size, "force", scene.plugin_laws.force, &PluginLaws::forces);
  if (!plugin_law) return make_contact_force(scene, cell_size);
  plugin_law->turn(own_rotation(scene.tool));
  return plugin_law;
}

}  // namespace sandstroke
