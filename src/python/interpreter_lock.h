#pragma once

#include <pybind11/pybind11.h>

namespace sandstroke {

// Guards for Python's interpreter lock, in place of pybind11's. When the interpreter ends, daemon threads
// that ask for the lock are unwound in the midst of C++, which ends the program by abort. A thread that meets
// with these guards, or with stay_if_leaving(), sleeps for ever instead, as Python does from 3.14 on.

/// Lets other Python threads run while it lives.
class WithoutLock {
 public:
  WithoutLock();
  ~WithoutLock();
  WithoutLock(const WithoutLock&) = delete;
  WithoutLock& operator=(const WithoutLock&) = delete;

 private:
  PyThreadState* state_;
};

/// Holds the interpreter lock while it lives, in any thread.
class WithLock {
 public:
  WithLock();
  ~WithLock();
  WithLock(const WithLock&) = delete;
  WithLock& operator=(const WithLock&) = delete;

 private:
  PyGILState_STATE state_;
};

/// True if the interpreter is about to end.
bool leaving();

/// Does not return in a thread that works without the lock when the interpreter is about to end.
void stay_if_leaving();

/// Lets the interpreter, before it ends, wait for the threads that work without the lock: half a minute at
/// most. Call it once, with the lock.
void wait_for_threads_at_exit();

}  // namespace sandstroke
