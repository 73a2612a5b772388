#include "core/child_process.h"

#include <gtest/gtest.h>

namespace sandstroke {
namespace {

TEST(ChildProcess, NoShellTakesItsWordsApart) {
  const auto result = run_child({"printf", "%s|", "two words", "$HOME", "a'b\"c", "; exit 1", "*", ""});
  ASSERT_TRUE(result);
  EXPECT_EQ(result->exit_code, 0);
  EXPECT_EQ(result->out, "two words|$HOME|a'b\"c|; exit 1|*||");
}

TEST(ChildProcess, ItsOutputsAreKeptApart) {
  const auto result = run_child({"sh", "-c", "echo result; echo trouble >&2; exit 7"});
  ASSERT_TRUE(result);
  EXPECT_EQ(result->exit_code, 7);
  EXPECT_EQ(result->out, "result");
  EXPECT_EQ(result->err, "trouble");
}

TEST(ChildProcess, WritesAsMuchAsItLikesOnBoth) {
  const auto result = run_child({"sh", "-c", "head -c 300000 /dev/zero >&2; head -c 300000 /dev/zero"});
  ASSERT_TRUE(result);
  EXPECT_EQ(result->out.size(), 300000u);
  EXPECT_EQ(result->err.size(), 300000u);
}

TEST(ChildProcess, SaysWhatSignalEndedIt) {
  const auto result = run_child({"sh", "-c", "kill -TERM $$"});
  ASSERT_TRUE(result);
  EXPECT_EQ(result->exit_code, 143);
}

TEST(ChildProcess, ThereIsNoSuchProgram) { EXPECT_FALSE(run_child({"sandstroke-no-such-program"})); }

}  // namespace
}  // namespace sandstroke
