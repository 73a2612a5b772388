#include "run/run_progress.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <chrono>
#include <stdexcept>
#include <string>

#include "kept_log.h"

namespace sandstroke {
namespace {

using namespace std::chrono_literals;

const HeightField& no_bed() { throw std::logic_error("nobody looks at the bed"); }

/// A tick may relax in a million passes: the run tells how far it is meanwhile.
TEST(RunProgress, IsToldWithinATick) {
  if (isatty(STDERR_FILENO)) GTEST_SKIP() << "the bar is drawn on the terminal";
  const KeptLog log;
  RunProgress progress(0s);  // tells at once, and again whenever the time has doubled
  const auto next_line = [&](const auto& tell) {
    const std::size_t before = log.text().size();
    for (std::int64_t i = 1; i < 100'000'000 && log.text().size() == before; i += 16)
      for (int k = 0; k < 16; ++k) tell(i + k);
    return log.text().substr(before);
  };
  EXPECT_EQ(next_line([&](std::int64_t i) { progress.on_pass(i, no_bed); }).find("run: 1 relaxation passes"),
            0);
  EXPECT_EQ(next_line([&](std::int64_t) { progress.on_progress(0.25); }).find("run: 25 %, "), 0);
  EXPECT_EQ(next_line([&](std::int64_t i) { progress.on_pass(i, no_bed); }).find("run: 25 %, "), 0);
}

}  // namespace
}  // namespace sandstroke
