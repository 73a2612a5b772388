#include "core/machine.h"

#include <malloc.h>
#include <sys/resource.h>
#include <sys/statvfs.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <limits>
#include <sstream>

#include "core/error.h"
#include "core/output_file.h"

namespace sandstroke {
namespace {

namespace fs = std::filesystem;

constexpr double unlimited = std::numeric_limits<double>::infinity();

/// The number after a name in lines of "name number", as in /proc/meminfo; 0 if the name is missing.
double number_after(const fs::path& file, const std::string& name) {
  std::ifstream lines(file);
  double number = 0.0;
  for (std::string line; std::getline(lines, line);)
    if (std::istringstream words(line); words >> line && line == name && words >> number) return number;
  return 0.0;
}

/// The number in a file; `none` if the file holds a word ("max") or does not exist.
double number_in(const fs::path& file, double none) {
  double number = none;
  return std::ifstream(file) >> number ? number : none;
}

struct GroupFiles {
  const char *limit, *usage, *cached;  // cached: prefix, in memory.stat, of caches that can be freed
};
constexpr GroupFiles version_1{"memory.limit_in_bytes", "memory.usage_in_bytes", "total_"},
    version_2{"memory.max", "memory.current", ""};

double room_in(const fs::path& group, const GroupFiles& files) {
  const double limit = number_in(group / files.limit, unlimited);
  if (limit >= 0x1p62) return unlimited;  // version 1 writes a huge number for no limit
  double taken = number_in(group / files.usage, 0.0);
  for (const char* kind : {"active_file", "inactive_file"})
    taken -= number_after(group / "memory.stat", std::string(files.cached) + kind);
  return limit - taken;
}

/// A limit of setrlimit(2).
double limit_of(__rlimit_resource resource) {
  rlimit limit{};
  if (getrlimit(resource, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY) return unlimited;
  return static_cast<double>(limit.rlim_cur);
}

/// The rest of a limit. taken: the name in /proc/self/status of what the process has taken.
double room_of(__rlimit_resource resource, const char* taken) {
  return limit_of(resource) - 1024.0 * number_after("/proc/self/status", taken);
}

/// The room that the limit of the address space leaves, and the message about it.
double address_room() { return room_of(RLIMIT_AS, "VmSize:"); }
constexpr const char* addresses_left = "the limit of the address space (ulimit -v) leaves {:.3g} GB";

}  // namespace

double physical_memory() {
  return static_cast<double>(sysconf(_SC_PHYS_PAGES)) * static_cast<double>(sysconf(_SC_PAGESIZE));
}

MemoryRoom memory_room() {
  const fs::path machine = "/proc/meminfo";
  const double free = 1024.0 * (number_after(machine, "MemAvailable:") + number_after(machine, "SwapFree:"));
  std::ostringstream groups;
  groups << std::ifstream("/proc/self/cgroup").rdbuf();
  MemoryRoom least{free > 0.0 ? free : physical_memory(), "this machine has {:.3g} GB free"};
  const auto consider = [&](double room, const char* reason) {
    if (room < least.bytes) least = {std::max(0.0, room), reason};
  };
  consider(control_group_room(groups.str(), "/sys/fs/cgroup"),
           "the control group (container or job) leaves {:.3g} GB");
  consider(address_room(), addresses_left);
  consider(room_of(RLIMIT_DATA, "VmData:"), "the limit of data (ulimit -d) leaves {:.3g} GB");
  least.reason = fmt::format(fmt::runtime(least.reason), 1e-9 * least.bytes);
  return least;
}

void check_memory(double bytes, const std::string& what, const std::string& remedy, double fraction) {
  const MemoryRoom room = memory_room();
  if (bytes > fraction * room.bytes)
    throw NotEnoughMemory(fmt::format(
        "{} takes about {:.3g} GB of memory, but {}{}; {}", what, 1e-9 * bytes, room.reason,
        fraction < 1.0 ? fmt::format(", and at most {:.3g} of that may be used", fraction) : "", remedy));
}

void check_addresses(double bytes, const std::string& what, const std::string& remedy) {
  const double room = std::max(0.0, address_room());
  if (bytes > room)
    throw NotEnoughMemory(fmt::format("{} takes about {:.3g} GB of address space, but {}; {}", what,
                                      1e-9 * bytes, fmt::format(addresses_left, 1e-9 * room), remedy));
}

void check_disk(const fs::path& path, double bytes, const std::string& remedy) {
  const auto refuse_beyond = [&](double room, const char* reason) {
    if (bytes > room)
      throw_io_error("{}: takes about {:.3g} GB, but {} {:.3g} GB; {}", path.string(), 1e-9 * bytes, reason,
                     1e-9 * room, remedy);
  };
  refuse_beyond(limit_of(RLIMIT_FSIZE), "the limit of the file size (ulimit -f) is");
  const fs::path folder = fs::absolute(path).parent_path();
  struct statvfs disk = {};
  if (statvfs(folder.c_str(), &disk) != 0 || disk.f_blocks == 0) return;  // the system does not say
  std::error_code none;
  const std::uintmax_t before = fs::file_size(part_path(path), none);
  refuse_beyond(static_cast<double>(disk.f_bavail) * static_cast<double>(disk.f_frsize) +
                    (none ? 0.0 : static_cast<double>(before)),
                "the disk has room for");
}

void share_heap_if_limited() {
  if (limit_of(RLIMIT_AS) < unlimited) mallopt(M_ARENA_MAX, 1);
}

void keep_freed_memory() {
  if (limit_of(RLIMIT_AS) < unlimited) return;
  constexpr int most_kept = 1 << 30;
  mallopt(M_MMAP_THRESHOLD, most_kept);
  mallopt(M_TRIM_THRESHOLD, most_kept);
}

void check_stack() {
  // Drawing with several threads takes 160 kB.
  constexpr double least = 512 * 1024.0;
  if (const double stack = limit_of(RLIMIT_STACK); stack < least)
    throw_io_error("the stack is limited to {:.0f} kB, which is too small; allow {:.0f} kB (ulimit -s)",
                   stack / 1024.0, least / 1024.0);
}

double control_group_room(const std::string& groups, const fs::path& mount) {
  double least = unlimited;
  std::istringstream lines(groups);
  for (std::string line; std::getline(lines, line);) {  // "4:cpu,memory:/path", or "0::/path" of version 2
    const std::size_t first = line.find(':'), second = line.find(':', first + 1);
    if (second == std::string::npos) continue;
    const std::string controllers = fmt::format(",{},", line.substr(first + 1, second - first - 1));
    const bool is_version_2 = controllers == ",,";
    if (!is_version_2 && controllers.find(",memory,") == std::string::npos) continue;
    // Groups above this one limit it, too. In a container its own group may be mounted as the topmost.
    const fs::path top = is_version_2 ? mount : mount / "memory";
    fs::path group = fs::path(line.substr(second + 1)).relative_path();
    for (;; group = group.parent_path()) {
      least = std::min(least, room_in(top / group, is_version_2 ? version_2 : version_1));
      if (group.empty()) break;
    }
  }
  return least;
}

std::string cpu_name() {
  std::ifstream info("/proc/cpuinfo");
  for (std::string line; std::getline(info, line);)
    if (line.starts_with("model name") && line.find(": ") != std::string::npos)
      return line.substr(line.find(": ") + 2);
  return "unknown";
}

}  // namespace sandstroke
