#include "core/interrupt.h"

#include <gtest/gtest.h>
#include <signal.h>
#include <unistd.h>

#include <chrono>
#include <thread>

#include "reset_signals.h"

namespace sandstroke {
namespace {

/// Beside SIGINT and SIGTERM, all that end a program (signal(7)) and that are neither a fault of its own nor
/// SIGKILL, SIGQUIT, SIGPIPE and SIGXFSZ.
std::vector<int> signals_from_outside() {
  std::vector<int> all = {SIGHUP,  SIGUSR1, SIGUSR2, SIGALRM, SIGVTALRM,
                          SIGPROF, SIGXCPU, SIGIO,   SIGPWR,  SIGSTKFLT};
  for (int number = SIGRTMIN; number <= SIGRTMAX; ++number) all.push_back(number);
  return all;
}

TEST(CatchInterruptsDeathTest, ASecondOneEndsTheProgramAtOnce) {
  for (const int number : {SIGINT, SIGTERM, SIGUSR1})
    EXPECT_EXIT(
        {
          reset_signals();
          catch_interrupts();
          raise(number);
          if (interrupted() == number) raise(number);
          _exit(0);
        },
        testing::KilledBySignal(number), "");
}

TEST(CatchInterruptsDeathTest, WhateverEndsAProgramIsCaught) {
  EXPECT_EXIT(
      {
        reset_signals();
        catch_interrupts();
        for (const int number : signals_from_outside()) {
          raise(number);
          if (interrupted() != number) _exit(number);
        }
        _exit(0);
      },
      testing::ExitedWithCode(0), "");
}

TEST(CatchInterruptsDeathTest, TheLimitOfCpuTimeIsToldEverySecondAndIsOne) {
  EXPECT_EXIT(
      {
        reset_signals();
        catch_interrupts();
        for (int second = 0; second < 3; ++second) raise(SIGXCPU);
        _exit(interrupted() == SIGXCPU ? 0 : 1);
      },
      testing::ExitedWithCode(0), "");
}

TEST(CatchInterruptsDeathTest, WhatIsIgnoredStaysSo) {
  for (const auto& catch_them : {catch_interrupts, catch_all_interrupts})
    EXPECT_EXIT(
        {
          signal(SIGHUP, SIG_IGN);  // nohup
          catch_them();
          raise(SIGHUP);
          _exit(interrupted());
        },
        testing::ExitedWithCode(0), "");
}

TEST(CatchAllInterruptsDeathTest, WhateverEndsOrStopsAProgramIsCaught) {
  for (const int number : signals_from_outside())
    EXPECT_EXIT(
        {
          reset_signals();
          catch_all_interrupts();
          raise(number);
          _exit(interrupted() == number ? 0 : 1);
        },
        testing::ExitedWithCode(0), "");
  EXPECT_EXIT(
      {
        reset_signals();
        catch_all_interrupts();
        for (const int number : {SIGTSTP, SIGTTIN, SIGTTOU})
          if (signal(number, SIG_DFL) != SIG_IGN) _exit(number);
        _exit(0);
      },
      testing::ExitedWithCode(0), "");
}

TEST(CatchAllInterruptsDeathTest, ThoseThatComeTogetherAreOne) {
  EXPECT_EXIT(
      {
        reset_signals();
        catch_all_interrupts();
        for (const int number : {SIGHUP, SIGHUP, SIGINT, SIGINT, SIGTERM, SIGUSR1, SIGTSTP}) raise(number);
        _exit(interrupted() == SIGHUP ? 0 : 1);
      },
      testing::ExitedWithCode(0), "");
}

TEST(CatchAllInterruptsDeathTest, OneThatComesLaterEndsTheProgram) {
  EXPECT_EXIT(
      {
        reset_signals();
        catch_all_interrupts();
        raise(SIGXCPU);
        std::this_thread::sleep_for(std::chrono::milliseconds(1001));
        raise(SIGXCPU);  // which is the same one
        raise(SIGINT);
        _exit(0);
      },
      testing::KilledBySignal(SIGINT), "");
}

TEST(IgnoreWriteSignalsDeathTest, AWriteThatFailsEndsNothing) {
  EXPECT_EXIT(
      {
        ignore_write_signals();
        for (const int number : {SIGPIPE, SIGXFSZ}) raise(number);
        _exit(0);
      },
      testing::ExitedWithCode(0), "");
}

}  // namespace
}  // namespace sandstroke
