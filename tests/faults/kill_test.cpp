// Killed, whenever: by time, and between any two changes that it makes to a file.
#include <gtest/gtest.h>
#include <signal.h>
#include <spdlog/fmt/fmt.h>

#include <random>

#include "faults/commands_test.h"
#include "sanitized.h"

namespace sandstroke {
namespace {

class Kill : public CommandsTest {};
SANDSTROKE_FOR_EACH_COMMAND(Kill);

TEST_P(Kill, LeavesNothingHalfWrittenAtAnyMoment) {
  Disturbed disturbed(GetParam());
  std::mt19937 random(7);
  std::uniform_real_distribution<double> within(0.0, 1.0);
  std::map<std::string, int> outcomes;
  const int repeats = fault_repeats();
  for (int i = 0; i < repeats; ++i) {
    const double milliseconds = 1e3 * disturbed.seconds() * (i + within(random)) / repeats;
    const std::string where = fmt::format("killed after {:.1f} ms", milliseconds);
    const ProgramResult killed = disturbed.run({.signal = SIGKILL, .after_ms = milliseconds});
    EXPECT_TRUE(killed.exit_code == 128 + SIGKILL || killed.exit_code == 0) << where << killed.err;
    outcomes[disturbed.state()]++;
    disturbed.expect_nothing_half(where);
    disturbed.expect_rerun(where);
  }
  tell("kill -9 at a random moment", GetParam().name, outcomes);
}

TEST_P(Kill, LeavesNothingHalfWrittenBetweenAnyTwoChangesOfFiles) {
  if (sanitized) GTEST_SKIP() << "a sanitizer must be loaded first, and so must be what fails";
  Disturbed disturbed(GetParam());
  const long calls = disturbed.calls().changes;
  ASSERT_GT(calls, 3);
  std::map<std::string, int> outcomes;
  for (const long call : some_calls(calls)) {
    const std::string where = fmt::format("killed before call {} of {}", call, calls);
    disturbed.run({.in_child = faulty_system(fmt::format("kill:{}", call))});
    outcomes[disturbed.state()]++;
    EXPECT_EQ(disturbed.state().find("cannot be read"), std::string::npos) << where;
    disturbed.expect_nothing_half(where);
    disturbed.expect_rerun(where);
  }
  tell("kill -9 between two calls that change a file", GetParam().name, outcomes);
}

}  // namespace
}  // namespace sandstroke
