#pragma once

#include <cmath>

namespace sandstroke {

/// Neumaier's compensated sum: the error of a sum of n terms does not grow with n. The result depends on the
/// order of the terms only in its last bit, so add in a fixed order where bits matter.
class CompensatedSum {
 public:
  void add(double term) {
    const double next = sum_ + term;
    compensation_ += std::abs(sum_) >= std::abs(term) ? (sum_ - next) + term : (term - next) + sum_;
    sum_ = next;
  }
  double value() const { return sum_ + compensation_; }
  template <class State>
  void visit_state(State& state) {
    state.value("sum", sum_);
    state.value("compensation", compensation_);
  }

 private:
  double sum_ = 0.0;
  double compensation_ = 0.0;
};

}  // namespace sandstroke
