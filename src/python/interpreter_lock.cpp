#include "python/interpreter_lock.h"

#include <cxxabi.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <thread>

namespace sandstroke {
namespace {

namespace py = pybind11;

std::atomic<bool> is_leaving = false;
std::atomic<std::thread::id> leaver;  // the thread that ends the interpreter
std::atomic<int> working = 0;         // threads that work without the lock
thread_local int own_guards = 0;      // of this thread, one within the other

[[noreturn]] void sleep_for_ever() {
  if (own_guards > 0) working.fetch_sub(1);
  while (true) pause();
}

/// Runs `take`, which waits for the lock. Does not return where Python would end the thread.
template <class Take>
void take_lock(const Take& take) {
  try {
    take();
  } catch (abi::__forced_unwind&) {
    sleep_for_ever();
  }
}

/// Waits, without the lock, until other threads have noticed that the interpreter ends.
void leave() {
  leaver = std::this_thread::get_id();
  is_leaving = true;
  PyThreadState* const state = PyEval_SaveThread();
  constexpr std::chrono::milliseconds interval(5);
  for (int i = 0; i < 6000 && working.load() > (own_guards > 0); ++i) std::this_thread::sleep_for(interval);
  PyEval_RestoreThread(state);
}

}  // namespace

bool leaving() { return is_leaving; }

void stay_if_leaving() {
  if (is_leaving && leaver.load() != std::this_thread::get_id()) sleep_for_ever();
}

WithoutLock::WithoutLock() : state_(PyEval_SaveThread()) {
  if (own_guards++ == 0) working.fetch_add(1);
}

WithoutLock::~WithoutLock() {
  stay_if_leaving();
  take_lock([this] { PyEval_RestoreThread(state_); });
  if (--own_guards == 0) working.fetch_sub(1);
}

WithLock::WithLock() {
  stay_if_leaving();
  take_lock([this] { state_ = PyGILState_Ensure(); });
}

WithLock::~WithLock() { PyGILState_Release(state_); }

void wait_for_threads_at_exit() { py::module_::import("atexit").attr("register")(py::cpp_function(&leave)); }

}  // namespace sandstroke
