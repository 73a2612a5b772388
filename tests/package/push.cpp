// Sand of your own: pushes a tool through a bed, lets it come to rest, and then lets a simulated hand do the
// same.
#include <cmath>
#include <iostream>

#include "sand/relaxation.h"
#include "sand/sphere_tool.h"
#include "sim/simulation.h"

using namespace sandstroke;

int main() {
  constexpr double cell_size = 0.002, depth = 0.005, step = 0.001;  // m
  HeightField bed(100, 150, cell_size);
  SphereTool tool({.radius = 0.012});
  double pushed = 0.0;
  for (double x = -0.05; x < 0.05; x += step) {
    tool.place(bed, x, 0.0);
    pushed += tool.displace(bed, -depth, {step, 0.0, 0.0}, {.deposit = Deposit::ahead});
  }
  const RelaxationOutcome rest = make_relaxer({}, cell_size)->relax(bed);
  std::cout << "pushed " << pushed << " m^3; volume afterwards " << bed.volume() << " m^3, highest "
            << bed.highest() << " m, " << (rest.converged ? "at rest" : "NOT AT REST") << '\n';

  Scene scene;
  scene.bed.width = 0.3;
  scene.bed.depth = 0.2;
  scene.bed.cols = 150;
  scene.bed.rows = 100;
  Stroke stroke;
  stroke.time = {0.0, 0.05, 0.1};
  stroke.position = {{0.0, 0.0, 0.01}, {0.0, 0.0, -depth}, {0.0, 0.0, 0.01}};
  const RunResult run = Simulation(scene, HeightField(100, 150, cell_size), stroke).run();
  const double force = scene.force.k_s * std::expm1(scene.force.k_c * run.max_depth);
  std::cout << "a hand that goes " << run.max_depth << " m deep feels " << run.device.max_force << " N ("
            << force << " N without drag)\n";

  const bool kept = std::abs(bed.volume()) < 1e-12 * pushed && run.volume_drift < 1e-12;
  return rest.converged && run.relaxation.converged && kept && pushed > 0.0 && run.device.max_force >= force
             ? 0
             : 1;
}
