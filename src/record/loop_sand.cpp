#include "record/loop_sand.h"

#include <algorithm>
#include <cmath>

#include "core/bisection.h"
#include "haptics/loop_stability.h"
#include "measure/contact_stiffness.h"
#include "record/live_sand.h"

namespace sandstroke {
namespace {

/// The unit of the second digit.
double second_digit(double value) { return std::pow(10.0, std::floor(std::log10(value)) - 1.0); }

/// Rounds down to two digits.
double rounded_down(double value) {
  if (!(value > 0.0) || std::isinf(value)) return std::max(value, 0.0);
  const double unit = second_digit(value);
  return std::floor(value / unit) * unit;
}

/// Equations 1 and 3: stiffest, and with the most drag, at the largest force.
class DepthSand : public LoopSand {
 public:
  DepthSand(const Scene& scene, double scale) : scene_(scene), scale_(scale) {}

  bool resists() const override { return scene_.force.k_s > 0.0 && scene_.force.k_c > 0.0; }

  FeltSand at(double force) const override {
    return felt_sand(depth_of_repulse_force(force, scene_.force), force, scale_, scene_.force);
  }

  std::optional<Scene> settling(const FeltLoop& loop) const override {
    Scene settling = scene_;
    settling.force = settling_force(loop, scene_.force);
    return settling;
  }

  const char* remedy() const override { return "lower --max-force or force.k_f"; }

 private:
  static ForceSettings settling_force(const FeltLoop& loop, const ForceSettings& force) {
    ForceSettings settling = force;
    if (loop.felt.drag >= loop.stable.drag)
      settling.k_f = rounded_down(loop.stable.drag / (loop.scale * loop.force));
    double stiffness = loop.stable.stiffness;
    if (force.drag == DragDirection::full)
      stiffness = stable_sand(loop.device, force.drag, settling.k_f * loop.scale * loop.force,
                              LiveSand::velocity_window)
                      .stiffness;
    if (loop.felt.stiffness < stiffness) return settling;
    // K = scale k_c (k_s + F)
    settling.k_s = rounded_down(stiffness / (loop.scale * force.k_c) - loop.force);
    if (settling.k_s > 0.0) return settling;
    settling.k_s = force.k_s;
    settling.k_c = rounded_down(stiffness / (loop.scale * (force.k_s + loop.force)));
    return settling;
  }

  const Scene& scene_;
  double scale_;
};

/// Sand of a contact law, whose drag does not depend on speed.
class ContactSand : public LoopSand {
 public:
  ContactSand(const Scene& scene, double scale, bool turns) : scene_(scene), scale_(scale), turns_(turns) {}

  bool resists() const override { return true; }

  FeltSand at(double force) const override { return {stiffness(scene_, force), 0.0}; }

  std::optional<Scene> settling(const FeltLoop& loop) const override {
    if (loop.is_stable()) return scene_;
    const std::optional<double> yield = settling_yield(loop);
    if (!yield) return std::nullopt;
    return yielding(*yield);
  }

  const char* remedy() const override { return "lower --max-force, or raise force.yield"; }

 private:
  double stiffness(const Scene& scene, double force) const {
    return scale_ * contact_stiffness(scene, force, turns_);
  }

  Scene yielding(double yield) const {
    Scene scene = scene_;
    scene.strength.yield_way = yield;
    return scene;
  }

  /// The least force.yield of two digits that settles [m].
  std::optional<double> settling_yield(const FeltLoop& loop) const {
    const auto shakes = [&](double yield) {
      return stiffness(yielding(yield), loop.force) >= loop.stable.stiffness;
    };
    double low = scene_.strength.yield_way, high = 2.0 * low;
    constexpr double longest = 1.0;  // m, the key's highest value
    for (; high <= longest && shakes(high); high *= 2.0) low = high;
    if (high > longest) return std::nullopt;
    constexpr int halvings = 8;
    low = boundary_between(low, high, halvings, mean, shakes);
    const double unit = second_digit(low);
    double yield = std::ceil(low / unit) * unit;
    while (shakes(yield)) yield += unit;
    return yield;
  }

  const Scene& scene_;
  double scale_;
  bool turns_;
};

}  // namespace

std::unique_ptr<LoopSand> make_loop_sand(const Scene& scene, double scale, bool turns) {
  if (is_contact_law(scene)) return std::make_unique<ContactSand>(scene, scale, turns);
  return std::make_unique<DepthSand>(scene, scale);
}

}  // namespace sandstroke
