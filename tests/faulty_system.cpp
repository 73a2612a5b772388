// Loaded into the program by LD_PRELOAD: a system that fails on request, by SANDSTROKE_FAULT =
//   count:FILE   does not fail, and says in FILE at the end how many calls changed a file, and how many read
//   one
//                of the user's: one in the current folder, or below
//   kill:N       kills the program right before the N-th of these calls, counted from 1
//   full:N       from the N-th on the disk is full
//   read:N       from the N-th read of a file of the user's on, the disk is damaged
//   once:N       the N-th such read fails, and no other
//   short        such a read gives a few bytes at a time, and each other one is interrupted
//   clock        the wall clock jumps by days, to and fro, each time it is asked
//   locks:E      locks of files fail with errno E
#include <dlfcn.h>
#include <fcntl.h>
#include <limits.h>
#include <signal.h>
#include <sys/file.h>
#include <sys/time.h>
#include <sys/uio.h>
#include <time.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cstdarg>
#include <cstdio>
#include <cstdlib>
#include <cstring>

namespace {

/// The system's own function of this name.
template <class Function>
Function* real(const char* name) {
  return reinterpret_cast<Function*>(dlsym(RTLD_NEXT, name));
}

/// The text of SANDSTROKE_FAULT for this kind; null where it names another one.
const char* fault(const char* kind) {
  const char* text = std::getenv("SANDSTROKE_FAULT");
  const std::size_t length = std::strlen(kind);
  return text && std::strncmp(text, kind, length) == 0 ? text + length : nullptr;
}

std::atomic<long> calls = 0, reads = 0;

/// Counts a call that changes a file, before it is made. False: the disk is full.
bool goes_on() {
  static const char* const kill_at = fault("kill:");
  static const char* const full_from = fault("full:");
  const long call = ++calls;
  if (kill_at && call == std::atol(kill_at)) kill(getpid(), SIGKILL);
  if (!full_from || call < std::atol(full_from)) return true;
  errno = ENOSPC;
  return false;
}

/// 0, 1 and 2 are what the program says, not its files.
bool takes(int file) { return file <= 2 || goes_on(); }

/// True for a file of the user, not of the system and its libraries.
bool is_users(int file) {
  char link[32], folder[PATH_MAX] = "", path[PATH_MAX] = "";
  std::snprintf(link, sizeof link, "/proc/self/fd/%d", file);
  if (!getcwd(folder, sizeof folder) || readlink(link, path, sizeof path - 1) < 0) return false;
  const std::size_t length = std::strlen(folder);
  return std::strncmp(path, folder, length) == 0 && path[length] == '/';
}

/// The bytes that a read may give, asked before each; -1: none, for it fails.
ssize_t given(int file, std::size_t count) {
  static const char *const fail_from = fault("read:"), *const fail_once = fault("once:");
  static const bool few = fault("short");
  constexpr std::size_t most = 5;
  if (!is_users(file)) return static_cast<ssize_t>(count);
  const long read = ++reads;
  const bool fails =
      (fail_from && read >= std::atol(fail_from)) || (fail_once && read == std::atol(fail_once));
  if (fails) {
    errno = EIO;
    return -1;
  }
  if (few && read % 2 == 0) {
    errno = EINTR;
    return -1;
  }
  return static_cast<ssize_t>(few ? std::min(count, most) : count);
}

__attribute__((destructor)) void say_count() {
  const char* path = fault("count:");
  if (!path) return;
  if (std::FILE* file = std::fopen(path, "w")) {
    std::fprintf(file, "%ld %ld", calls.load(), reads.load());
    std::fclose(file);
  }
}

/// False: there are no locks.
bool locks() {
  static const char* const error = fault("locks:");
  if (error) errno = std::atoi(error);
  return !error;
}

timespec jumped(timespec time) {
  static std::atomic<long> asked = 0;
  constexpr long day = 86'400;
  const long jumps = asked++;
  time.tv_sec += (jumps % 2 == 0 ? -3 : 2) * day * (1 + jumps % 5);
  return time;
}

}  // namespace

extern "C" {

ssize_t write(int file, const void* bytes, size_t count) {
  return takes(file) ? real<decltype(write)>("write")(file, bytes, count) : -1;
}
ssize_t writev(int file, const iovec* parts, int count) {
  return takes(file) ? real<decltype(writev)>("writev")(file, parts, count) : -1;
}
ssize_t pwrite(int file, const void* bytes, size_t count, off_t offset) {
  return takes(file) ? real<decltype(pwrite)>("pwrite")(file, bytes, count, offset) : -1;
}
ssize_t pwrite64(int file, const void* bytes, size_t count, off_t offset) {
  return takes(file) ? real<decltype(pwrite)>("pwrite64")(file, bytes, count, offset) : -1;
}

ssize_t read(int file, void* bytes, size_t count) {
  const ssize_t most = given(file, count);
  return most < 0 ? -1 : real<decltype(read)>("read")(file, bytes, most);
}
ssize_t readv(int file, const iovec* parts, int count) {
  if (count < 1) return 0;
  return read(file, parts->iov_base, parts->iov_len);  // of the first part, which it may
}
ssize_t pread(int file, void* bytes, size_t count, off_t offset) {
  const ssize_t most = given(file, count);
  return most < 0 ? -1 : real<decltype(pread)>("pread")(file, bytes, most, offset);
}
ssize_t pread64(int file, void* bytes, size_t count, off_t offset) {
  return pread(file, bytes, count, offset);
}

int fsync(int file) { return takes(file) ? real<decltype(fsync)>("fsync")(file) : -1; }
int fdatasync(int file) { return takes(file) ? real<decltype(fdatasync)>("fdatasync")(file) : -1; }

int fallocate64(int file, int mode, off_t offset, off_t size) {
  return takes(file) ? real<decltype(fallocate64)>("fallocate64")(file, mode, offset, size) : -1;
}
int fallocate(int file, int mode, off_t offset, off_t size) { return fallocate64(file, mode, offset, size); }

// Calls that need no room never find the disk full.
int ftruncate64(int file, off_t size) noexcept {
  const bool room = goes_on();
  return room || size == 0 ? real<int(int, off_t)>("ftruncate64")(file, size) : -1;
}
int ftruncate(int file, off_t size) noexcept { return ftruncate64(file, size); }
int rename(const char* from, const char* to) noexcept {
  goes_on();
  return real<int(const char*, const char*)>("rename")(from, to);
}
int renameat2(int from_place, const char* from, int to_place, const char* to, unsigned flags) noexcept {
  goes_on();
  return real<int(int, const char*, int, const char*, unsigned)>("renameat2")(from_place, from, to_place, to,
                                                                              flags);
}
int unlink(const char* path) noexcept {
  goes_on();
  return real<int(const char*)>("unlink")(path);
}
int unlinkat(int folder, const char* path, int flags) noexcept {
  goes_on();
  return real<int(int, const char*, int)>("unlinkat")(folder, path, flags);
}
int remove(const char* path) noexcept {
  goes_on();
  return real<int(const char*)>("remove")(path);
}
int mkdir(const char* path, mode_t mode) noexcept {
  return goes_on() ? real<int(const char*, mode_t)>("mkdir")(path, mode) : -1;
}
char* mkdtemp(char* path) noexcept { return goes_on() ? real<char*(char*)>("mkdtemp")(path) : nullptr; }

#define SANDSTROKE_OPEN(name)                                          \
  int name(const char* path, int flags, ...) {                         \
    mode_t mode = 0;                                                   \
    if (flags & O_CREAT) {                                             \
      va_list rest;                                                    \
      va_start(rest, flags);                                           \
      mode = va_arg(rest, mode_t);                                     \
      va_end(rest);                                                    \
    }                                                                  \
    const bool room = (flags & (O_CREAT | O_TRUNC)) == 0 || goes_on(); \
    if (!room && access(path, F_OK) != 0) return errno = ENOSPC, -1;   \
    return real<int(const char*, int, ...)>(#name)(path, flags, mode); \
  }
SANDSTROKE_OPEN(open)
SANDSTROKE_OPEN(open64)

int fcntl(int file, int command, ...) {
  va_list rest;
  va_start(rest, command);
  void* const argument = va_arg(rest, void*);
  va_end(rest);
  const bool locking = command == F_OFD_SETLK || command == F_OFD_SETLKW;
  return !locking || locks() ? real<int(int, int, ...)>("fcntl")(file, command, argument) : -1;
}
int flock(int file, int how) noexcept { return locks() ? real<int(int, int)>("flock")(file, how) : -1; }

int clock_gettime(clockid_t clock, timespec* time) noexcept {
  const int failure = real<int(clockid_t, timespec*)>("clock_gettime")(clock, time);
  static const bool jumps = fault("clock");
  if (failure == 0 && clock == CLOCK_REALTIME && jumps) *time = jumped(*time);
  return failure;
}
int gettimeofday(timeval* time, void*) noexcept {
  timespec now;
  const int failure = clock_gettime(CLOCK_REALTIME, &now);
  *time = {now.tv_sec, now.tv_nsec / 1000};
  return failure;
}
time_t time(time_t* time) noexcept {
  timespec now;
  clock_gettime(CLOCK_REALTIME, &now);
  if (time) *time = now.tv_sec;
  return now.tv_sec;
}

}  // extern "C"
