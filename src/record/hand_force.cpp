#include "record/hand_force.h"

#include <algorithm>

#include "haptics/recording.h"
#include "sim/contact_force.h"

namespace sandstroke {
namespace {

/// Equations 1 and 3, of depth and velocity.
class DepthOnHand : public HandForce {
 public:
  DepthOnHand(const Scene& scene, const PointPlacement& placement)
      : settings_(scene.force), placement_(placement), scene_limit_(scene.device.max_force) {}

  void feel(const MovedTool& tool, FeltForce& felt) override {
    if (!tool.interaction.contact) return;
    felt.force = placement_.force_back(
        sand_force(tool.interaction.depth, tool.velocity, scene_limit_, settings_).total);
  }

 private:
  ForceSettings settings_;
  PointPlacement placement_;
  double scene_limit_;  // N; 0: none
};

/// The wrench of sand that is weakened to what the hand may get (Wrench::given).
class ContactOnHand : public HandForce {
 public:
  ContactOnHand(const Scene& scene, double cell_size, const PointPlacement& placement, double largest_force)
      : placement_(placement),
        scene_limit_(scene.device.max_force),
        largest_force_(scene_limit_ > 0.0 ? std::min(largest_force, scene_limit_) : largest_force) {
    Scene limited = scene;
    limited.device.max_force = largest_force_;
    force_ = make_contact_force(limited, cell_size);
  }

  void turn(const Eigen::Matrix3d& rotation) override { force_->turn(rotation); }
  void lift() override { force_->lift(); }

  void feel(const MovedTool& tool, FeltForce& felt) override {
    const Wrench full = force_->in_tick(tool.sand, tool.bed, tool.tip, tool.motion, tool.interaction.contact);
    felt.force = placement_.force_back(full.given);
    felt.due = full.limited(largest_force_).strength;
    // Cut by more than a run of the scene would cut it.
    if (full.limited(scene_limit_).strength > largest_force_) felt.flags |= clamped_force;
  }

 private:
  std::unique_ptr<ToolForce> force_;
  PointPlacement placement_;
  double scene_limit_, largest_force_;  // N; scene_limit_ 0: none
};

}  // namespace

std::unique_ptr<HandForce> make_hand_force(const Scene& scene, double cell_size,
                                           const PointPlacement& placement, double largest_force) {
  if (is_contact_law(scene))
    return std::make_unique<ContactOnHand>(scene, cell_size, placement, largest_force);
  return std::make_unique<DepthOnHand>(scene, placement);
}

}  // namespace sandstroke
