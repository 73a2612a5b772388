#pragma once

#include <memory>

#include "sim/device_force.h"
#include "sim/simulation_observer.h"
#include "validation/stress/device_loop.h"

namespace sandstroke {

/// Keeps the stiffest contact of a scene's run, among those within the device's force limit.
class StiffestContact : public SimulationObserver {
 public:
  explicit StiffestContact(const Scene& scene);
  void on_tick(const TickRecord& tick) override;

  /// The loop of the scene's device in this contact, as a dynamic device with exact encoders and no dropped
  /// ticks. Error: input, if the tool felt no sand within the limit, or the force is more than latest_judged
  /// ticks late.
  LoopSettings loop() const;

 private:
  const Scene scene_;
  std::unique_ptr<DeviceForce> force_;
  double stiffness_ = 0.0;  // N/m, felt by the device
  double depth_ = 0.0;      // m
  bool touched_ = false;
};

}  // namespace sandstroke
