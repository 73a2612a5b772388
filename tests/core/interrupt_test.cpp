#include "core/interrupt.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <thread>

namespace sandstroke {
namespace {

TEST(CatchInterruptsDeathTest, ASecondOneEndsTheProgramAtOnce) {
  for (const int signal : {SIGINT, SIGTERM})
    EXPECT_EXIT(
        {
          catch_interrupts();
          std::raise(signal);
          if (interrupted() == signal) std::raise(signal);
          _exit(0);
        },
        testing::KilledBySignal(signal), "");
}

TEST(CatchAllInterruptsDeathTest, ThoseThatComeTogetherAreOne) {
  EXPECT_EXIT(
      {
        catch_all_interrupts();
        for (const int signal : {SIGHUP, SIGHUP, SIGINT, SIGINT, SIGTERM, SIGTSTP}) std::raise(signal);
        _exit(interrupted() == SIGHUP ? 0 : 1);
      },
      testing::ExitedWithCode(0), "");
}

TEST(CatchAllInterruptsDeathTest, OneThatComesLaterEndsTheProgram) {
  EXPECT_EXIT(
      {
        catch_all_interrupts();
        std::raise(SIGHUP);
        std::this_thread::sleep_for(std::chrono::milliseconds(1001));
        std::raise(SIGINT);
        _exit(0);
      },
      testing::KilledBySignal(SIGINT), "");
}

}  // namespace
}  // namespace sandstroke
