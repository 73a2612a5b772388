#include "record/eroder.h"

#include <gtest/gtest.h>

namespace sandstroke {
namespace {

TEST(Eroder, ThatErodesOnceInAnAgeTakesWhatIsDugMeanwhileAndEndsWhenItIsAsked) {
  for (const double rate : {1e-4, 1e-300, 0.0}) {
    RelaxationSettings settings;
    settings.rate = rate;
    SandRing dug(8), slipped(8);
    Eroder eroder(HeightField(10, 10, 0.01), settings, dug, slipped);
    eroder.start();
    for (int i = 0; i < 3; ++i) {
      dug.push({5, i, -1e-6});
      while (dug.size() > 0) std::this_thread::yield();
    }
    eroder.stop();
    for (int i = 0; i < 3; ++i) EXPECT_EQ(eroder.bed()(5, i), -1e-6);
    EXPECT_EQ(eroder.report().relaxations, rate > 0.0 ? 1 : 0);
  }
}

}  // namespace
}  // namespace sandstroke
