#include "core/interrupt.h"

#include <signal.h>

#include <atomic>
#include <cstdint>
#include <ctime>
#include <initializer_list>

namespace sandstroke {
namespace {

std::atomic<int> caught_signal = 0;                    // one thread sets it, others read it
std::atomic<std::int64_t> caught_at = 0;               // ns, when the first signal came, which may come twice
static_assert(std::atomic<int>::is_always_lock_free);  // else a signal handler could not set it
static_assert(std::atomic<std::int64_t>::is_always_lock_free);

constexpr std::int64_t together = 1'000'000'000;  // ns; signals within this time count as one

void remember_signal(int number) {
  caught_signal = number;
  if (number != SIGXCPU) signal(number, SIG_DFL);
}

void remember_first_signal(int number) {
  timespec time;
  clock_gettime(CLOCK_MONOTONIC, &time);  // a signal handler may call this (POSIX)
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

/// Catches all signals that come from outside and end a program, except SIGINT, SIGTERM and SIGQUIT.
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
