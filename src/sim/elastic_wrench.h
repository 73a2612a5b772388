#pragma once

#include <Eigen/Core>

namespace sandstroke {

/// The force that sand exerts on a tool, as an elastic-plastic law whose stored energy is a state of its own:
/// no path of the tool takes more energy out of it than went in.
///
/// The force f comes from the potential f^2 / (2 K) of an elastic part, K being the sand's stiffness. A way q
/// of the tool first changes f to f - K q. If that is larger than the force that the law asks for, sand
/// yields: f shrinks to the size of that, and turns towards it, as far as it can
/// - within the ball whose diameter reaches from 0 to f - K q. There the work that yielding takes, the new
///   force times (f - K q - new f) / K, is not negative (Thales).
/// - within K |q| of f. So K is the stiffness that a device's loop feels, and a tool that rests feels the
/// same. Where the law takes energy, f is soon the law's, and stays that. With f held from tick to tick the
/// loop cannot create energy if its damping is above K T / 2 (passivity_margin): per tick, -f q is at least
/// the growth of what is stored, less K q^2 / 2.
///
/// Forces and ways have six components: force [N] and torque over an arm [N], way [m] and turn times the arm.
class ElasticWrench {
 public:
  using Six = Eigen::Matrix<double, 6, 1>;

  /// Returns the force after the tool went by `way`. asked: the law's force. stiffness: K [N/m]; where it is
  /// less than before, what is stored does not grow. most [N]: of the first three components (0: no limit).
  const Six& follow(const Six& asked, double stiffness, const Six& way, double most = 0.0);
  /// The tool touches no sand.
  void lift() { *this = {}; }

  /// J
  double stored() const;

  template <class State>
  void visit_state(State& state) {
    state.value("force", force_);
    state.value("stiffness", stiffness_);
  }

 private:
  Six force_ = Six::Zero();
  double stiffness_ = 0.0;
};

}  // namespace sandstroke
