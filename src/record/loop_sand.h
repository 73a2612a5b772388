#pragma once

#include <memory>

#include "record/felt_loop.h"

namespace sandstroke {

/// The sand of a scene in a device's loop, as its law of force has it.
class LoopSand {
 public:
  virtual ~LoopSand() = default;

  /// False where it gives no force at any depth.
  virtual bool resists() const = 0;
  /// The sand as the device feels it at this force [N].
  virtual FeltSand at(double force) const = 0;
  /// The same scene with sand that settles (settling_scene).
  virtual std::optional<Scene> settling(const FeltLoop& loop) const = 0;
  /// The remedy where the device buzzes.
  virtual const char* remedy() const = 0;
};

/// scale, turns: as in FeltLoop. The scene must outlive the sand.
std::unique_ptr<LoopSand> make_loop_sand(const Scene& scene, double scale, bool turns);

}  // namespace sandstroke
