#include "core/interrupt.h"

#include <signal.h>

#include <atomic>
#include <cstdint>
#include <ctime>
#include <initializer_list>

namespace sandstroke {
namespace {

std::atomic<int> caught_signal = 0;                    // set by one thread and asked for by others
std::atomic<std::int64_t> caught_at = 0;               // ns, the first one that may come twice
static_assert(std::atomic<int>::is_always_lock_free);  // or no signal handler might set it
static_assert(std::atomic<std::int64_t>::is_always_lock_free);

constexpr std::int64_t together = 1'000'000'000;  // ns

void remember_signal(int number) {
  caught_signal = number;
  if (number != SIGXCPU) signal(number, SIG_DFL);
}

void remember_first_signal(int number) {
  timespec time;
  clock_gettime(CLOCK_MONOTONIC, &time);  // which a signal handler may call (POSIX)
  const std::int64_t now = time.tv_sec * std::int64_t{1'000'000'000} + time.tv_nsec;
  if (caught_signal == 0) {
    caught_at = now;
    caught_signal = number;
  } else if (number != SIGXCPU && now - caught_at > together) {
    signal(number, SIG_DFL);
    raise(number);
  }
}

void catch_unless_set(int number, void (*handler)(int)) {
  struct sigaction now = {};
  sigaction(number, nullptr, &now);
  if (now.sa_handler == SIG_DFL) signal(number, handler);
}

/// All that end a program and come from outside, but SIGINT, SIGTERM and SIGQUIT.
void catch_others(void (*handler)(int)) {
  for (const int number :
       {SIGHUP, SIGUSR1, SIGUSR2, SIGALRM, SIGVTALRM, SIGPROF, SIGXCPU, SIGPOLL, SIGPWR, SIGSTKFLT})
    catch_unless_set(number, handler);
  for (int number = SIGRTMIN; number <= SIGRTMAX; ++number) catch_unless_set(number, handler);
}

}  // namespace

void ignore_write_signals() {
  for (const int number : {SIGPIPE, SIGXFSZ}) signal(number, SIG_IGN);
}

void catch_interrupts() {
  for (const int number : {SIGINT, SIGTERM}) signal(number, remember_signal);
  catch_others(remember_signal);
}

void catch_all_interrupts() {
  for (const int number : {SIGINT, SIGTERM, SIGQUIT}) signal(number, remember_first_signal);
  catch_others(remember_first_signal);
  for (const int number : {SIGTSTP, SIGTTIN, SIGTTOU}) signal(number, SIG_IGN);
}

int interrupted() { return caught_signal; }

}  // namespace sandstroke
