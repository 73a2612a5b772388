#include "allocations.h"

#include <atomic>
#include <cerrno>
#include <cstdlib>

#include "sanitized.h"

namespace {

std::atomic<std::int64_t> by_all = 0;
thread_local std::int64_t by_this_thread = 0;

}  // namespace

namespace sandstroke {

std::int64_t allocations() { return by_all; }
std::int64_t allocations_of_this_thread() { return by_this_thread; }

bool allocations_are_counted() { return !sanitized; }

}  // namespace sandstroke

#ifndef SANDSTROKE_SANITIZE

namespace {

void count() {
  ++by_all;
  ++by_this_thread;
}

}  // namespace

// The C library's own, under which operator new and every other allocator get their memory.
extern "C" {
void* __libc_malloc(std::size_t);
void* __libc_calloc(std::size_t, std::size_t);
void* __libc_realloc(void*, std::size_t);
void* __libc_memalign(std::size_t, std::size_t);

void* malloc(std::size_t size) {
  count();
  return __libc_malloc(size);
}
void* calloc(std::size_t number, std::size_t size) {
  count();
  return __libc_calloc(number, size);
}
void* realloc(void* memory, std::size_t size) {
  count();
  return __libc_realloc(memory, size);
}
void* memalign(std::size_t alignment, std::size_t size) {
  count();
  return __libc_memalign(alignment, size);
}
void* aligned_alloc(std::size_t alignment, std::size_t size) { return memalign(alignment, size); }
int posix_memalign(void** memory, std::size_t alignment, std::size_t size) {
  *memory = memalign(alignment, size);
  return *memory ? 0 : ENOMEM;
}
}

#endif
