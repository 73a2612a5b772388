#include "record/live_sand.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "core/machine.h"
#include "haptics/recording.h"
#include "tool/tool_surface.h"

namespace sandstroke {
namespace {

constexpr std::size_t ring_size = std::size_t{1} << 20;  // changes: 16 MB each way
constexpr std::size_t most_poses = 1024;                 // of the tool, not read yet: a second of ticks
constexpr int most_taken = 4096;                         // changes per tick: some 50 us
const double gap_threshold = Stroke{}.gap_threshold;     // s: gaps that `run` does not join stay gaps

const HeightField& checked(const Scene& scene, const HeightField& bed) {
  const auto refuse_unless = [](bool felt, const char* key, const char* why) {
    if (!felt)
      throw_input_error("{}: {}; to feel sand live (--feel), leave it out or change it with --set", key, why);
  };
  refuse_unless(scene.device.model == DeviceModel::kinematic, "device.model",
                "\"dynamic\" simulates a device, but the hand holds a real one");
  if (scene.stroke) {
    const StrokePlacement& placement = scene.stroke->placement;
    refuse_unless(placement.plane == StrokePlane::keep, "stroke.plane",
                  "it needs the whole stroke before it begins");
    refuse_unless(placement.fit == 0.0 && placement.place == StrokePlace::keep, "stroke.fit and stroke.place",
                  "they need the whole stroke before it begins");
    refuse_unless(placement.depth_by == DepthBy::none, "stroke.depth_by",
                  "the hand itself decides how deep it goes");
    refuse_unless(placement.follow == StrokeFollow::bed, "stroke.follow",
                  "the hand itself decides how deep it goes");
    refuse_unless(placement.start == 0.0 && std::isinf(placement.stop), "stroke.start and stroke.stop",
                  "they cut a stroke that does not exist yet");
    refuse_unless(
        placement.repeated == RepeatedSamples::keep && placement.smooth == 0.0 && placement.speed == 1.0,
        "stroke.held, stroke.smooth and stroke.speed", "they change a stroke that does not exist yet");
  }
  // The servo loop and the LiveRelaxer each hold their own bed, and what the other knows of it; pages get a
  // copy.
  check_memory(5.0 * bed.tile_count() * static_cast<double>(HeightField::bytes_per_tile()),
               fmt::format("live sand with bed.cells = [{}, {}]", bed.cols(), bed.rows()), "use fewer cells",
               0.5);
  return bed;
}

}  // namespace

LiveSand::LiveSand(const Scene& scene, const HeightField& bed, const FeltDevice& device)
    : device_(scene.device),
      placement_(point_placement(scene.stroke ? scene.stroke->placement : StrokePlacement{}, device.frame)),
      highest_(bed.highest()),
      displaced_(ring_size),
      relaxed_(ring_size),
      poses_(most_poses),
      replica_(checked(scene, bed)),
      relaxer_thread_(bed, scene.tool, scene.relaxation, displaced_, poses_, relaxed_),
      sand_(scene.tool, scene.displacement),
      force_(make_hand_force(scene, bed.cell_size(), placement_, device.largest_force)),
      own_rotation_(own_rotation(scene.tool)),
      turns_(device.turns) {
  sand_.take_memory(replica_.bed());
  if (turns_ && scene.tool.shape != ToolShape::sphere)
    shaper_.emplace(scene.tool, scene.displacement.distance, bed.cell_size());
}

void LiveSand::start() {
  relaxer_thread_.start();
  if (shaper_) shaper_->start();
}

/// The surface that feels turns at once. The footprint that displaces follows as soon as it can.
void LiveSand::turn_tool(const Eigen::Quaterniond& orientation) {
  if (!turns_) return;
  const Eigen::Quaterniond placed = placement_.orientation(orientation);
  for (Eigen::Index i = 0; i < 4; ++i)
    orientation_[static_cast<std::size_t>(i)].store(placed.coeffs()[i], std::memory_order_relaxed);
  const Eigen::Matrix3d rotation = rotation_of(placed) * own_rotation_;
  if (shaper_) shaper_->follow(rotation, sand_);
  force_->turn(rotation);
}

Eigen::Quaterniond LiveSand::orientation() const {
  Eigen::Quaterniond orientation;
  for (Eigen::Index i = 0; i < 4; ++i)
    orientation.coeffs()[i] = orientation_[static_cast<std::size_t>(i)].load(std::memory_order_relaxed);
  return orientation;
}

Eigen::Vector3d LiveSand::velocity(double time, const Eigen::Vector3d& tip) {
  const std::int64_t known = std::min<std::int64_t>(readings_, velocity_window);
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();
  if (known > 0) {
    const Past& before = past(readings_ - known);
    velocity = (tip - before.tip) / (time - before.time);
  }
  past(readings_++) = {time, tip};
  return velocity;
}

void LiveSand::take_relaxed(int most) {
  SandChange change;
  for (int i = 0; i < most && relaxed_.pop(change); ++i) {
    replica_.take_relaxed(change);
    highest_ = std::max(highest_, replica_.bed()(change.row, change.col));
  }
}

std::size_t LiveSand::changes_of_move(const Eigen::Vector3d& tip) const {
  const Tool& tool = sand_.tool();
  const double cells = 2.0 * tool.reach() / replica_.bed().cell_size() + 3.0;
  const double way = sand_.last_tip() ? (tip - *sand_.last_tip()).head<2>().norm() : 0.0;
  const double most = cells * cells * (2.0 * way / tool.radius() + 2.0);
  return most < static_cast<double>(ring_size) ? static_cast<std::size_t>(most) : ring_size + 1;
}

bool LiveSand::touches(const DeviceReading& reading) noexcept {
  const Eigen::Vector3d tip = this->tip(reading.position);
  turn_tool(reading.orientation);
  const Interaction interaction = sand_.look(replica_.bed(), tip);
  return interaction.contact || is_beside(interaction, tip);
}

FeltForce LiveSand::feel(double time, const DeviceReading& reading) noexcept {
  take_relaxed(most_taken);
  const Eigen::Vector3d tip = this->tip(reading.position);
  if (readings_ > 0 && time - past(readings_ - 1).time > gap_threshold) {
    sand_.lift();
    force_->lift();
    readings_ = 0;
  }
  // Also where the tool displaced no sand.
  const Eigen::Vector3d motion =
      readings_ > 0 ? Eigen::Vector3d(tip - past(readings_ - 1).tip) : Eigen::Vector3d::Zero();
  const Eigen::Vector3d speed = velocity(time, tip);
  turn_tool(reading.orientation);

  FeltForce felt;
  Interaction interaction;
  if (displaced_.room() >= changes_of_move(tip)) {
    interaction = sand_.move(replica_.bed(), tip, tip, {}, highest_);
    replica_.tell_disturbed([this](const SandChange& change) {
      displaced_.push(change);
      highest_ = std::max(highest_, replica_.bed()(change.row, change.col));
    });
  } else {
    interaction = sand_.meet(replica_.bed(), tip);
    sand_.lift();
    felt.flags |= deferred_sand;
    ++report_.deferred_ticks;
  }
  poses_.push({tip, interaction.contact,
               shaper_ ? std::optional(shaper_->rotation())
                       : std::nullopt});  // where the ring is full the LiveRelaxer knows an older pose
  depth_.store(interaction.contact ? interaction.depth : std::numeric_limits<double>::quiet_NaN(),
               std::memory_order_relaxed);
  felt.is_above_or_in_sand = !is_beside(interaction, tip);
  report_.contact_ticks += interaction.contact;
  force_->feel({sand_, replica_.bed(), interaction, tip, motion, speed}, felt);
  return felt;
}

LiveSandReport LiveSand::finish() {
  if (shaper_) {
    shaper_->stop();
    if (shaper_->failure()) std::rethrow_exception(shaper_->failure());
  }
  relaxer_thread_.stop();
  if (relaxer_thread_.failure()) std::rethrow_exception(relaxer_thread_.failure());
  do {
    relaxer_thread_.exchange();
    take_relaxed(static_cast<int>(ring_size));
  } while (!relaxer_thread_.all_given());
  relaxer_thread_.show();
  report_.relaxation = relaxer_thread_.report();
  return report_;
}

}  // namespace sandstroke
