#include "record/real_time.h"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include <thread>
#include <vector>

namespace sandstroke {
namespace {

/// Makes this process that of a user without privileges, who may lock so much memory.
void become_a_user(rlim_t memory) {
  const rlimit none{0, 0}, locked{memory, memory};
  setrlimit(RLIMIT_RTPRIO, &none);
  if (setrlimit(RLIMIT_MEMLOCK, &locked) != 0) _exit(77);
  if (geteuid() == 0 && setresuid(65534, 65534, 65534) != 0) _exit(77);
}

/// True if the advice on SCHED_FIFO, and on locked memory, is there exactly where each was refused.
bool says_what_was_refused(const Scheduling& given) {
  const auto says = [&](const char* word) { return given.advice.find(word) != std::string::npos; };
  return says("rtprio") == (given.policy != "SCHED_FIFO") && says("memlock") == !given.memory_locked;
}

TEST(AskForRealTime, AsksForNothingWhereNothingIsWanted) {
  std::thread([] {
    const Scheduling given = ask_for_real_time(0, MemoryLock::not_asked);
    EXPECT_EQ(given.policy, "SCHED_OTHER");
    EXPECT_EQ(given.priority, 0);
    EXPECT_FALSE(given.memory_locked);
    EXPECT_EQ(given.advice, "");
  }).join();
}

TEST(AskForRealTime, GetsItOrSaysHow) {
  std::thread([] {
    const Scheduling given = ask_for_real_time(7, MemoryLock::not_asked);
    EXPECT_EQ(given.priority, given.policy == "SCHED_FIFO" ? 7 : 0);
    EXPECT_EQ(given.advice.empty(), given.policy == "SCHED_FIFO");
  }).join();
  std::thread([] {
    EXPECT_NE(ask_for_real_time(0, MemoryLock::not_asked).policy, "SCHED_FIFO")
        << "it is the one thread's only";
  }).join();
}

TEST(AskForRealTimeDeathTest, LeavesAUserWithLittleLockedMemoryAllTheOther) {
  EXPECT_EXIT(
      {
        become_a_user(8 << 20);
        const Scheduling given = ask_for_real_time(80, MemoryLock::asked);
        if (given.policy != "SCHED_OTHER" || given.priority != 0 || given.memory_locked) _exit(1);
        if (!says_what_was_refused(given)) _exit(2);
        if (given.advice.find("rtprio 81 ") == std::string::npos) _exit(4);  // the watchdog's, too
        const std::vector<char> memory(std::size_t{64} << 20, 'x');  // refused, if its locking were asked for
        _exit(memory.back() == 'x' ? 0 : 3);
      },
      testing::ExitedWithCode(0), "");
}

TEST(AskForRealTimeDeathTest, LocksMemoryForAUserWhoMayLockAnyAmount) {
  EXPECT_EXIT(
      {
        become_a_user(RLIM_INFINITY);
        const Scheduling given = ask_for_real_time(80, MemoryLock::asked);
        _exit(given.memory_locked && says_what_was_refused(given) ? 0 : 1);
      },
      [](int status) { return WIFEXITED(status) && (WEXITSTATUS(status) == 0 || WEXITSTATUS(status) == 77); },
      "");
}

}  // namespace
}  // namespace sandstroke
