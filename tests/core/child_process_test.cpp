#include "core/child_process.h"

#include <gtest/gtest.h>
#include <signal.h>
#include <unistd.h>

#include <cstdint>
#include <filesystem>
#include <fstream>

#include "core/interrupt.h"
#include "test_folder.h"

namespace sandstroke {
namespace {

TEST(OneLine, JoinsTheLinesOfAProgram) {
  EXPECT_EQ(one_line("one"), "one");
  EXPECT_EQ(one_line("one\r\n\ntwo\nthree"), "one; two; three");
  EXPECT_EQ(one_line("\n\n"), "");
}

namespace fs = std::filesystem;

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

TEST(ChildProcess, ItIgnoresNoSignalThatThisProgramIgnores) {
  ignore_write_signals();
  const auto result = run_child({"sed", "-n", "s/^SigIgn:[[:space:]]*//p", "/proc/self/status"});
  for (const int number : {SIGPIPE, SIGXFSZ}) signal(number, SIG_DFL);
  ASSERT_TRUE(result);
  const std::uint64_t ignored = std::stoull(result->out, nullptr, 16);
  for (const int number : {SIGPIPE, SIGXFSZ}) EXPECT_EQ(ignored >> (number - 1) & 1, 0u) << number;
}

TEST(ChildProcess, ThereIsNoSuchProgram) {
  EXPECT_FALSE(run_child({"sandstroke-no-such-program"}));
  EXPECT_FALSE(FedChild::start({"sandstroke-no-such-program"}));
}

TEST(ChildProcess, TakesAllThatItIsFed) {
  auto child = FedChild::start({"sh", "-c", "cat; echo end >&2; exit 3"});
  ASSERT_TRUE(child);
  std::string all;
  for (char c = 'a'; c < 'f'; ++c) {
    const std::string part(300'000, c);
    EXPECT_TRUE(child->feed(part.data(), part.size()));
    all += part;
  }
  const auto result = child->wait();
  ASSERT_TRUE(result);
  EXPECT_EQ(result->exit_code, 3);
  EXPECT_TRUE(result->out == all);
  EXPECT_EQ(result->err, "end");
}

TEST(ChildProcess, OneThatTakesNoMoreIsNoSignal) {
  auto child = FedChild::start({"sh", "-c", "head -c 10; exit 5"});
  ASSERT_TRUE(child);
  const std::string part(3'000'000, 'x');
  EXPECT_FALSE(child->feed(part.data(), part.size()));
  const auto result = child->wait();
  ASSERT_TRUE(result);
  EXPECT_EQ(result->exit_code, 5);
  EXPECT_EQ(result->out, "xxxxxxxxxx");
}

TEST(ChildProcess, NobodyWaitsForItItIsKilled) {
  const TestFolder folder;
  const std::string file = (folder / "pid").string();
  {
    auto child = FedChild::start({"sh", "-c", "echo $$ > " + file + "; exec sleep 1000"});
    ASSERT_TRUE(child);
    while (!fs::exists(file) || fs::file_size(file) == 0) usleep(1000);
  }
  pid_t process = 0;
  std::ifstream(file) >> process;
  ASSERT_GT(process, 0);
  EXPECT_EQ(kill(process, 0), -1);
}

TEST(IsInstalled, LooksAlongPath) {
  EXPECT_TRUE(is_installed("sh"));
  EXPECT_FALSE(is_installed("no-such-program-anywhere"));
}

}  // namespace
}  // namespace sandstroke
