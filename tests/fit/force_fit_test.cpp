#include "fit/force_fit.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "core/error.h"
#include "fit/paper_law.h"

namespace sandstroke {
namespace {

const std::vector<std::string> all = {"k_s", "k_c", "k_f"};
constexpr double no_limit = 0.0;

struct PaperFit : ForceFit {
  ForceSettings force;  // with the fitted constants
  double stiffness = 0.0, stiffness_error = 0.0;
};

PaperFit fit_force(const std::vector<FeltTick>& ticks, const ForceSettings& start, double max_force,
                   const std::vector<std::string>& names) {
  const PaperLaw law(ticks, start, max_force, 0.01);
  const ForceFit fit = fit_force(law, chosen_constants(law.constants(), names));
  return {fit, law.settings(fit.values), fit.scale.value, fit.scale.error};
}

/// A hand that goes up and down between two depths [m] and in circles, and the force that sand with these
/// constants would give it, with noise [N rms per component].
std::vector<FeltTick> felt(const ForceSettings& truth, double shallow, double deep, double noise = 0.0,
                           int count = 1000, double max_force = no_limit) {
  std::mt19937 random(7);
  std::normal_distribution<double> error(0.0, 1.0);
  std::vector<FeltTick> ticks;
  for (int k = 0; k < count; ++k) {
    const double t = 0.01 * k, mean = 0.5 * (shallow + deep), half = 0.5 * (deep - shallow);
    FeltTick tick{mean + half * std::sin(t),
                  {0.1 * std::cos(3.0 * t), 0.08 * std::sin(2.0 * t), half * std::cos(t)},
                  {}};
    tick.recorded = sand_force(tick.depth, tick.velocity, max_force, truth).total;
    for (double& component : tick.recorded) component += noise * error(random);
    ticks.push_back(tick);
  }
  return ticks;
}

const ForceSettings truth = {.k_s = 40.0, .k_c = 30.0, .k_f = 4.0};

TEST(ForceFit, FindsTheConstantsThatMadeTheForce) {
  const PaperFit fit = fit_force(felt(truth, 0.001, 0.05), ForceSettings{}, no_limit, all);
  EXPECT_NEAR(fit.force.k_s, truth.k_s, 1e-5 * truth.k_s);
  EXPECT_NEAR(fit.force.k_c, truth.k_c, 1e-5 * truth.k_c);
  EXPECT_NEAR(fit.force.k_f, truth.k_f, 1e-5 * truth.k_f);
  EXPECT_NEAR(fit.stiffness, truth.k_s * truth.k_c, 1e-5 * truth.k_s * truth.k_c);
  EXPECT_LT(fit.residual, 1e-5 * fit.recorded_rms);
  EXPECT_GT(fit.start_residual, 0.1 * fit.recorded_rms);
  EXPECT_NEAR(fit.explained, 1.0, 1e-9);
  EXPECT_EQ(fit.ticks, 1000);
}

TEST(ForceFit, FindsThemWhereTheDevicesLimitCutSome) {
  const PaperFit fit = fit_force(felt(truth, 0.001, 0.05, 0.0, 1000, 60.0), ForceSettings{}, 60.0, all);
  EXPECT_NEAR(fit.force.k_s, truth.k_s, 1e-3 * truth.k_s);
  EXPECT_NEAR(fit.force.k_c, truth.k_c, 1e-3 * truth.k_c);
  EXPECT_NEAR(fit.force.k_f, truth.k_f, 1e-3 * truth.k_f);
}

TEST(ForceFit, ErrorsGrowWithTheNoiseAndCoverTheTruth) {
  double before = 0.0;
  for (const double noise : {0.1, 1.0}) {
    const PaperFit fit = fit_force(felt(truth, 0.001, 0.05, noise, 4000), ForceSettings{}, no_limit, all);
    ASSERT_EQ(fit.constants.size(), 3u);
    const double true_values[] = {truth.k_s, truth.k_c, truth.k_f};
    for (std::size_t i = 0; i < fit.constants.size(); ++i) {
      const FittedConstant& one = fit.constants[i];
      EXPECT_EQ(one.value, fit.values[static_cast<Eigen::Index>(i)]);
      EXPECT_NEAR(one.value, true_values[i], 4.0 * one.error) << one.constant.name;
      EXPECT_LT(one.error, 0.2 * one.value) << one.constant.name;
    }
    EXPECT_NEAR(fit.residual, std::sqrt(3.0) * noise, 0.05 * noise);
    EXPECT_GT(fit.stiffness_error, 3.0 * before);
    before = fit.stiffness_error;
  }
}

TEST(ForceFit, FitsWhatIsAskedForAndKeepsTheOthers) {
  ForceSettings start = truth;
  start.k_f = 9.0;
  const PaperFit fit = fit_force(felt(truth, 0.001, 0.05), start, no_limit, {"k_f"});
  EXPECT_EQ(fit.force.k_s, truth.k_s);
  EXPECT_EQ(fit.force.k_c, truth.k_c);
  EXPECT_NEAR(fit.force.k_f, truth.k_f, 1e-6);
  ASSERT_EQ(fit.constants.size(), 1u);
  EXPECT_STREQ(fit.constants.front().constant.name, "k_f");
}

TEST(ForceFit, SaysThatAForceInShallowSandTellsOnlyTheProduct) {
  const ForceSettings paper;  // k_c d = 0.002: the force is k_s k_c d to one in a thousand
  ForceSettings start = paper;
  start.k_s = 300.0;
  start.k_c = 2.0;
  const PaperFit fit = fit_force(felt(paper, 0.001, 0.004, 0.05), start, no_limit, all);
  EXPECT_EQ(fit.force.k_c, start.k_c);
  EXPECT_TRUE(fit.constants[1].kept);
  EXPECT_TRUE(fit.constants[1].likely.contains(paper.k_c));
  EXPECT_FALSE(fit.constants[0].determined());
  EXPECT_TRUE(fit.constants[0].likely.contains(paper.k_s));
  EXPECT_GT(std::abs(fit.force.k_s - paper.k_s), 100.0 * fit.constants[0].given_error);
  EXPECT_NEAR(fit.stiffness, 500.0, 4.0 * fit.stiffness_error);
  EXPECT_LT(fit.stiffness_error, 10.0);
}

TEST(ForceFit, KeepsTheOnlyConstantThatWasAskedForIfItIsNotDetermined) {
  const ForceSettings paper;
  ForceSettings start = paper;
  start.k_c = 0.6;
  start.k_s = paper.k_s * paper.k_c / start.k_c;
  const PaperFit fit = fit_force(felt(paper, 0.001, 0.004, 0.05), start, no_limit, {"k_c"});
  EXPECT_TRUE(fit.constants[0].kept || fit.constants[0].determined());
}

TEST(ForceFit, LimitsAConstantThatIsNothing) {
  ForceSettings sand = truth;
  sand.k_f = 0.0;
  const PaperFit fit = fit_force(felt(sand, 0.001, 0.05, 1.0, 4000), sand, no_limit, all);
  EXPECT_EQ(fit.constants[2].likely.low, 0.0);
  EXPECT_LT(fit.constants[2].likely.high, 1.0);
}

TEST(FittedConstant, OneThatIsKeptIsNotDetermined) {
  FittedConstant one{paper_constants[2], 2, 0.75, 0.2, {0.4, 1.4}};
  EXPECT_TRUE(one.determined());
  one.kept = true;
  EXPECT_FALSE(one.determined());
}

/// All of it is at the device's limit: any sand that is hard enough gives it.
TEST(ForceFit, AForceThatTheLimitCutsEverywhereTellsNothing) {
  const std::vector<FeltTick> ticks =
      felt({.k_s = 4e4, .k_c = 30.0, .k_f = 4.0}, 0.01, 0.05, 0.0, 1000, 12.0);
  std::string said;
  try {
    fit_force(ticks, ForceSettings{}, 12.0, all);
  } catch (const Error& failure) {
    said = failure.what();
  }
  EXPECT_NE(said.find("device.max_force = 12 N) cuts the force in 1000 of 1000 ticks"), std::string::npos)
      << said;
}

/// It grows in proportion to the depth: no k_c is small enough, and none is known.
TEST(ForceFit, AForceThatIsExactlyStraightTellsOnlyTheProduct) {
  std::vector<FeltTick> ticks = felt(truth, 0.001, 0.05);
  for (FeltTick& tick : ticks) tick.recorded = {0.0, 0.0, 500.0 * tick.depth};
  ForceSettings start;
  start.k_c = 0.01;
  const PaperFit fit = fit_force(ticks, start, no_limit, all);
  EXPECT_FALSE(fit.constants[1].determined());
  EXPECT_NEAR(fit.stiffness, 500.0, 0.2);
}

TEST(ForceFit, SaysWhichConstantsTheRecordingDetermines) {
  for (const double k_f : {4.0, 0.0}) {  // without drag, noise alone is fitted
    ForceSettings sand = truth;
    sand.k_f = k_f;
    const PaperFit fit = fit_force(felt(sand, 0.001, 0.05, 1.0, 4000), ForceSettings{}, no_limit, all);
    EXPECT_TRUE(fit.constants[0].determined());
    EXPECT_TRUE(fit.constants[1].determined());
    EXPECT_EQ(fit.constants[2].determined(), k_f > 0.0) << fit.constants[2].value;
  }
  FittedConstant one{paper_constants[2], 2, 1.0, 0.2, {0.6, 1.4}};
  EXPECT_TRUE(one.determined());
  one.likely.high = 2.1;
  EXPECT_FALSE(one.determined());
  EXPECT_FALSE((FittedConstant{paper_constants[2], 2, 0.0, 0.0, {}}.determined()));
}

/// A force without any drag, to rounding: a tiny k_f is found, and is sure to be tiny, but it is no
/// knowledge.
TEST(ForceFit, AConstantThatDoesNotActIsNotDetermined) {
  ForceSettings no_drag = truth;
  no_drag.k_f = 0.0;
  const PaperFit fit = fit_force(felt(no_drag, 0.001, 0.05), ForceSettings{}, no_limit, all);
  EXPECT_TRUE(fit.constants[0].determined());
  EXPECT_TRUE(fit.constants[1].determined());
  EXPECT_FALSE(fit.constants[2].determined()) << fit.constants[2].value << " +- " << fit.constants[2].error;
  std::vector<FeltTick> still = felt(truth, 0.001, 0.05);
  for (FeltTick& tick : still) tick.recorded.setZero();
  EXPECT_THROW(fit_force(still, ForceSettings{}, no_limit, all), Error);
}

TEST(ForceFit, AForceOfAnotherKindIsHardlyExplained) {
  std::vector<FeltTick> ticks = felt(truth, 0.001, 0.05);
  for (FeltTick& tick : ticks) tick.recorded = {3.0, 0.0, 0.0};  // constant, and sideways
  const PaperFit fit = fit_force(ticks, ForceSettings{}, no_limit, all);
  EXPECT_NEAR(fit.recorded_rms, 3.0, 1e-12);
  EXPECT_LT(fit.explained, 0.2);
  EXPECT_GE(fit.residual, 2.5);
}

TEST(ForceFit, NeverLeavesMoreThanNoForceWouldWhereverItBegins) {
  std::mt19937 random(11);
  std::normal_distribution<double> any(0.0, 1.0);
  std::vector<FeltTick> ticks;  // a quick hand, and a force that has nothing to do with it
  for (int k = 0; k < 1000; ++k)
    ticks.push_back({0.02 + 0.01 * std::abs(any(random)),
                     {0.5 * any(random), 0.5 * any(random), 0.0},
                     {any(random), any(random), any(random) - 1.0}});
  for (const double k_f : {0.0, 1.0, 10.0, 100.0}) {
    ForceSettings start;
    start.k_f = k_f;
    const PaperFit fit = fit_force(ticks, start, 12.0, all);
    EXPECT_LE(fit.residual, fit.recorded_rms * (1.0 + 1e-9)) << "from k_f = " << k_f;
    EXPECT_GE(fit.explained, -1e-9);
  }
}

TEST(ForceFit, SeesAForceWithTheOtherSign) {
  std::vector<FeltTick> ticks = felt(truth, 0.001, 0.05);
  for (FeltTick& tick : ticks) tick.recorded = -tick.recorded;
  const PaperFit fit = fit_force(ticks, ForceSettings{}, no_limit, all);
  EXPECT_LT(fit.explained, 0.01);
  EXPECT_GT(fit.explained_reversed, 0.99);
  EXPECT_GE(fit.force.k_s, 0.0);
  EXPECT_GE(fit.force.k_f, 0.0);
}

TEST(ForceFit, RefusesWhatItCannotDo) {
  EXPECT_THROW(fit_force(felt(truth, 0.001, 0.05), truth, no_limit, {"k_x"}), Error);
  EXPECT_THROW(fit_force(felt(truth, 0.001, 0.05, 0.0, 99), truth, no_limit, all), Error);
  EXPECT_NO_THROW(fit_force(felt(truth, 0.001, 0.05, 0.0, 100), truth, no_limit, all));
}

}  // namespace
}  // namespace sandstroke
