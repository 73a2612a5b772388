#include "haptics/loop_stability.h"

#include <Eigen/Eigenvalues>

#include "core/bisection.h"

namespace sandstroke {

Eigen::MatrixXd loop_map(const DeviceSettings& device, const Eigen::RowVectorXd& back) {
  const Eigen::Matrix<double, 2, 5> map = device_tick_map(device);
  const Eigen::Index delay = device.delay, past = back.size() - 2, first_past = 2 + delay;
  Eigen::MatrixXd loop = Eigen::MatrixXd::Zero(first_past + past, first_past + past);
  loop.topLeftCorner<2, 2>() = map.leftCols<2>();
  Eigen::RowVectorXd force = Eigen::RowVectorXd::Zero(loop.cols());
  force.head<2>() = -back.head<2>();
  force.tail(past) = -back.tail(past);
  if (delay == 0) {
    loop.topRows<2>() += map.col(4) * force;
  } else {
    loop.block<2, 1>(0, 2) = map.col(4);
    loop.block(2, 3, delay - 1, delay - 1).setIdentity();
    loop.row(1 + delay) = force;
  }
  for (Eigen::Index i = 0; i < past; ++i) loop(first_past + i, i == 0 ? 0 : first_past + i - 1) = 1.0;
  return loop;
}

double spectral_radius(const Eigen::MatrixXd& map) { return map.eigenvalues().cwiseAbs().maxCoeff(); }

Eigen::RowVectorXd windowed_feedback(const FeltSand& felt, int window, double servo_rate) {
  Eigen::RowVectorXd back = Eigen::RowVectorXd::Zero(2 + window);
  const double per_way = felt.drag * servo_rate / window;  // N/m
  back[0] = felt.stiffness + per_way;
  back[1 + window] = -per_way;
  return back;
}

FeltSand stable_sand(const DeviceSettings& device, DragDirection direction, double drag, int window) {
  const auto settles = [&](const FeltSand& felt) {  // or stays, like a device that no hand holds
    return spectral_radius(loop_map(device, windowed_feedback(felt, window, device.servo_rate))) < 1.0 + 1e-9;
  };
  FeltSand largest;
  largest.drag = boundary_of_positive([&](double B) { return settles({0.0, B}); });
  const double along_z = direction == DragDirection::full && drag < largest.drag ? drag : 0.0;
  largest.stiffness = boundary_of_positive([&](double K) { return settles({K, along_z}); });
  return largest;
}

}  // namespace sandstroke
