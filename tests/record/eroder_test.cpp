#include "record/eroder.h"

#include <gtest/gtest.h>

#include <new>

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

/// Of a machine without memory left.
class FailingRelaxer : public Relaxer {
 public:
  RelaxationOutcome relax(HeightField&, const std::function<void(std::int64_t)>&) override {
    throw std::bad_alloc();
  }
};

TEST(Eroder, ThatFailsEndsItsThreadAndNotTheProgram) {
  SandRing dug(8), slipped(8);
  Eroder eroder(HeightField(10, 10, 0.01), {}, dug, slipped, std::make_unique<FailingRelaxer>());
  dug.push({5, 5, -1e-6});
  eroder.start();
  while (dug.size() > 0) std::this_thread::yield();  // in the first turn, which fails right after
  eroder.stop();
  ASSERT_TRUE(eroder.failure());
  EXPECT_THROW(std::rethrow_exception(eroder.failure()), std::bad_alloc);
}

}  // namespace
}  // namespace sandstroke
