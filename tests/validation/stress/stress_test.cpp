// The quick set of every part: no case ends as nobody expects.
#include "validation/stress/stress.h"

#include <gtest/gtest.h>

#include "sanitized.h"

namespace sandstroke {
namespace {

struct Part {
  const char* name;
  void (*run)(StressReport&, const StressOptions&);
};

class StressPart : public testing::TestWithParam<Part> {};
INSTANTIATE_TEST_SUITE_P(
    Quick, StressPart,
    testing::Values(Part{"DeviceLoop", stress_device_loop}, Part{"ContactLoops", stress_contact_loops},
                    Part{"Relaxation", stress_relaxation}, Part{"Grounds", stress_grounds},
                    Part{"Sources", stress_sources}, Part{"StoneStrokes", stress_stone_strokes},
                    Part{"AnyGround", stress_any_ground}, Part{"Strokes", stress_strokes}),
    [](const auto& part) { return part.param.name; });

TEST_P(StressPart, HasNoSurpriseAndSaysHowFarItIs) {
  StressReport report;
  StressOptions options;
  options.quick = true;
  double done = 0.0;
  struct Enough {};
  options.progress = [&done](double fraction) {
    EXPECT_GE(fraction, done);
    done = fraction;
    if (sanitized && done > 0.0) throw Enough{};
  };
  try {
    GetParam().run(report, options);
  } catch (Enough) {
    GTEST_SKIP() << "the first cases only: what all of them run through is run through by now";
  }
  EXPECT_GT(report.cases.size(), 0u);
  for (const StressCase& one : report.cases)
    EXPECT_FALSE(one.surprise()) << one.group << ", " << one.name << " (" << one.settings
                                 << "): " << name_of(one.verdict) << "; " << one.detail;
  EXPECT_EQ(report.surprises(), 0);
  EXPECT_NEAR(done, 1.0, 1e-9);
}

}  // namespace
}  // namespace sandstroke
