#include "fit/confidence.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/elementary.h"
#include "core/hash.h"
#include "fit/contact_scene.h"
#include "fit/felt_ticks.h"
#include "fit/force_fit.h"

namespace sandstroke {
namespace {

using Eigen::Vector3d;

constexpr double period = 0.02;
constexpr Eigen::Index ticks = 400;

/// Noise of 1 rms in each component, correlated over that time [s], with the same bits everywhere. The sums
/// that a fit makes of it are normal, though its own distribution is uniform.
Eigen::Matrix3Xd noise(std::uint64_t seed, double correlated, Eigen::Index count = ticks) {
  const double stays = correlated > 0.0 ? elementary::exp(-period / correlated) : 0.0;
  const double fresh = std::sqrt(1.0 - stays * stays);
  Eigen::Matrix3Xd noise(3, count);
  for (Eigen::Index i = 0; i < count; ++i)
    for (Eigen::Index k = 0; k < 3; ++k) {
      const double unit =
          std::sqrt(12.0) * (unit_hash((seed << 32) + 0x9e3779b97f4a7c15U * (3 * i + k + 1)) - 0.5);
      noise(k, i) = i == 0 ? unit : stays * noise(k, i - 1) + fresh * unit;
    }
  return noise;
}

/// A law whose recorded force is its own force with these values, and an error of the recording.
class Recorded : public FeltLaw {
 public:
  Recorded(const FeltLaw& law, const Eigen::VectorXd& values)
      : law_(law), exact_(law.forces(values, DeviceLimit::applied)) {}
  Eigen::Matrix3Xd error;

  Eigen::Matrix3Xd recorded() const override { return exact_ + error; }
  std::span<const ForceConstant> constants() const override { return law_.constants(); }
  ForceScale scale() const override { return law_.scale(); }
  const Eigen::VectorXd& start() const override { return law_.start(); }
  Eigen::VectorXd weak() const override { return law_.weak(); }
  Eigen::VectorXd numbers(const Eigen::VectorXd& values) const override { return law_.numbers(values); }
  Eigen::VectorXd values(const Eigen::VectorXd& numbers) const override { return law_.values(numbers); }
  Eigen::VectorXd with(Eigen::VectorXd values, std::size_t constant, double value) const override {
    return law_.with(std::move(values), constant, value);
  }
  Range range(std::size_t constant) const override { return law_.range(constant); }
  Eigen::Matrix3Xd forces(const Eigen::VectorXd& values, DeviceLimit limit) const override {
    return law_.forces(values, limit);
  }
  double max_force() const override { return law_.max_force(); }
  std::int64_t ticks() const override { return law_.ticks(); }
  double period() const override { return law_.period(); }

 private:
  const FeltLaw& law_;
  Eigen::Matrix3Xd exact_;
};

/// A hand that goes up and down and in bends.
Vector3d position(double t) {
  return {0.04 * elementary::sin(2.2 * t), 0.025 * elementary::sin(4.1 * t),
          -0.006 + 0.004 * elementary::cos(3.0 * t)};
}

PaperLaw paper_law(const ForceSettings& start) {
  std::vector<FeltTick> felt;
  for (Eigen::Index i = 0; i < ticks; ++i) {
    const double t = period * static_cast<double>(i);
    felt.push_back({-position(t).z(), (position(t + 1e-4) - position(t)) / 1e-4, Vector3d::Ones()});
  }
  return {felt, start, 0.0, period};
}

ContactLaw rft_law() {
  Scene scene = scene_with(ForceLaw::rft, ToolShape::sphere);
  scene.device.servo_rate = 1.0 / period;
  Stroke stroke;
  for (Eigen::Index i = 0; i < ticks; ++i) {
    stroke.time.push_back(period * static_cast<double>(i));
    stroke.position.push_back(position(stroke.time.back()));
    stroke.force.emplace_back(Vector3d::Ones());
  }
  const std::vector<bool> free = {true, true, false};
  return felt_in({scene, starting_bed(scene.bed), stroke},
                 {rft_constants, scene.strength, values_in(scene.strength, rft_constants), free});
}

struct Covered {
  int of_68 = 0, of_95 = 0;
  void count(double distance) {
    of_68 += distance <= SlowWaves::within_68;
    of_95 += distance <= SlowWaves::within_95;
  }
};

/// How often the truth, which is the law's start, lies in the intervals of each free constant, and last of
/// the scale.
std::vector<Covered> covered(const FeltLaw& law, const std::vector<bool>& free, double rms, double correlated,
                             int repetitions) {
  const Eigen::VectorXd truth = law.start();
  Recorded recorded(law, truth);
  std::vector<Covered> covered(free.size() + 1);
  for (int k = 0; k < repetitions; ++k) {
    recorded.error = rms * noise(static_cast<std::uint64_t>(k) + 1, correlated, law.recorded().cols());
    const LeastSquares problem{recorded, recorded.recorded(), free};
    const Eigen::VectorXd best = problem.solved(truth);
    const Confidence confidence(problem, best);
    for (std::size_t i = 0; i < free.size(); ++i)
      if (free[i]) covered[i].count(confidence.distance(i, truth[static_cast<Eigen::Index>(i)]));
    const Combination scale = scale_about(problem, free, best);
    covered.back().count(SlowWaves::within_68 * std::abs(scale.value - law.numbers(truth)[0]) / scale.error);
  }
  return covered;
}

/// With 100 repetitions the share of one constant strays by 5 and 2 % (standard deviation), so the constants
/// are counted together.
void expect_covered(const FeltLaw& law, const std::vector<bool>& free, int repetitions = 100) {
  for (const double correlated : {0.0, 0.1})
    for (const double rms : {0.01, 0.2}) {
      double of_68 = 0.0, of_95 = 0.0;
      const std::vector<Covered> all = covered(law, free, rms, correlated, repetitions);
      for (const Covered& one : all) {
        of_68 += one.of_68;
        of_95 += one.of_95;
      }
      const double counted =
          repetitions * (1.0 + static_cast<double>(std::count(free.begin(), free.end(), true)));
      SCOPED_TRACE(testing::Message() << rms << " N, correlated by " << correlated << " s");
      EXPECT_GE(of_68 / counted, 0.60);
      EXPECT_LE(of_68 / counted, 0.75);
      EXPECT_GE(of_95 / counted, 0.90);
      EXPECT_LE(of_95 / counted, 0.98);
    }
}

TEST(Confidence, CoversWhereOnlyAProductIsKnown) {
  expect_covered(paper_law({.k_s = 800.0, .k_c = 0.7, .k_f = 8.0}), {true, true, true});
}

TEST(Confidence, CoversWhereTheForceBends) {
  expect_covered(paper_law({.k_s = 1.0, .k_c = 200.0, .k_f = 8.0}), {true, true, true});
}

TEST(Confidence, CoversTheSandOfRft) {
  expect_covered(rft_law(), {true, true, false}, 400);  // its constants stray together
}

/// The ends of an interval are where the distance is.
TEST(Confidence, EndsWhereTheDistanceIs) {
  const PaperLaw law = paper_law({.k_s = 1.0, .k_c = 200.0, .k_f = 8.0});
  Recorded recorded(law, law.start());
  recorded.error = 0.1 * noise(1, 0.1);
  const LeastSquares problem{recorded, recorded.recorded(), {true, true, true}};
  const Confidence confidence(problem, problem.solved(law.start()));
  for (std::size_t i = 0; i < 3; ++i) {
    const Interval interval = confidence.interval(i, SlowWaves::within_95);
    EXPECT_LT(interval.low, interval.high);
    EXPECT_NEAR(confidence.distance(i, interval.low), SlowWaves::within_95, 0.05);
    EXPECT_NEAR(confidence.distance(i, interval.high), SlowWaves::within_95, 0.05);
  }
}

/// exp(-t / 0.1 s) is 1/e after 0.1 s, and white noise is alike in no two ticks.
TEST(CorrelationLength, IsTheNoises) {
  EXPECT_EQ(correlation_length(noise(1, 0.0, 20'000)), 0);
  EXPECT_NEAR(period * static_cast<double>(correlation_length(noise(1, 0.1, 20'000))), 0.1, period);
}

}  // namespace
}  // namespace sandstroke
