#include "record/real_time.h"

#include <linux/capability.h>
#include <pthread.h>
#include <spdlog/fmt/fmt.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <unistd.h>

namespace sandstroke {
namespace {

const char* policy_name(int policy) {
  switch (policy) {
    case SCHED_FIFO:
      return "SCHED_FIFO";
    case SCHED_RR:
      return "SCHED_RR";
    case SCHED_OTHER:
      return "SCHED_OTHER";
    default:
      return "another";  // SCHED_BATCH, SCHED_IDLE, ...: as it was started
  }
}

bool has_capability(unsigned capability) {
  __user_cap_header_struct header{_LINUX_CAPABILITY_VERSION_3, 0};
  __user_cap_data_struct sets[_LINUX_CAPABILITY_U32S_3] = {};
  return syscall(SYS_capget, &header, sets) == 0 &&
         (sets[capability / 32].effective >> (capability % 32) & 1U) != 0;
}

/// Memory is not locked where there is a limit (8 MB for most users). A process that just fits would be
/// locked, and then each later allocation beyond the limit would fail.
bool memory_may_be_locked() {
  rlimit limit{};
  return has_capability(CAP_IPC_LOCK) ||
         (getrlimit(RLIMIT_MEMLOCK, &limit) == 0 && limit.rlim_cur == RLIM_INFINITY);
}

std::string advice(int refused_priority, bool memory_refused) {
  const std::string cost =
      fmt::format("{}{}{}", refused_priority > 0 ? "other programs can delay the loop by milliseconds" : "",
                  refused_priority > 0 && memory_refused ? ", and " : "",
                  memory_refused ? "swapped-out memory can delay the loop until the disk has read it" : "");
  const std::string limits = fmt::format(
      "{}{}{}", refused_priority > 0 ? fmt::format("rtprio {}", watchdog_priority(refused_priority)) : "",
      refused_priority > 0 && memory_refused ? " and " : "", memory_refused ? "memlock unlimited" : "");
  return fmt::format(
      "{} refused: {}; allow your user {} in /etc/security/limits.conf and log in again, or give the program "
      "the right by setcap cap_sys_nice,cap_ipc_lock+ep, or run it as root",
      refused_priority == 0 ? "locked memory was"
      : memory_refused      ? "SCHED_FIFO and locked memory were"
                            : "SCHED_FIFO was",
      cost, limits);
}

}  // namespace

Scheduling ask_for_real_time(int priority, MemoryLock memory) noexcept {
  const bool lock_memory = memory == MemoryLock::asked;
  Scheduling given;
  // Where SCHED_FIFO is refused, a sleep may otherwise end 50 us late, because the system saves power.
  prctl(PR_SET_TIMERSLACK, 1UL);  // ns
  sched_param parameters{};
  parameters.sched_priority = priority;
  if (priority > 0) pthread_setschedparam(pthread_self(), SCHED_FIFO, &parameters);
  int policy = SCHED_OTHER;
  pthread_getschedparam(pthread_self(), &policy, &parameters);
  given.policy = policy_name(policy);
  given.priority = parameters.sched_priority;

  if (lock_memory && memory_may_be_locked()) given.memory_locked = mlockall(MCL_CURRENT | MCL_FUTURE) == 0;

  const bool fifo_refused = priority > 0 && policy != SCHED_FIFO;
  const bool memory_refused = lock_memory && !given.memory_locked;
  if (fifo_refused || memory_refused) given.advice = advice(fifo_refused ? priority : 0, memory_refused);
  return given;
}

}  // namespace sandstroke
