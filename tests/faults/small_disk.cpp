#include "faults/small_disk.h"

#include <sched.h>
#include <spdlog/fmt/fmt.h>
#include <sys/mount.h>
#include <unistd.h>

#include "cli/program.h"

namespace sandstroke {
namespace {

bool enter_own_mounts() {
  const uid_t user = geteuid();
  const gid_t group = getegid();
  if (user == 0) {
    if (unshare(CLONE_NEWNS) != 0) return false;
  } else {  // as root of a user namespace
    if (unshare(CLONE_NEWUSER | CLONE_NEWNS) != 0) return false;
    write_file("/proc/self/setgroups", "deny");
    write_file("/proc/self/uid_map", fmt::format("0 {} 1", user));
    write_file("/proc/self/gid_map", fmt::format("0 {} 1", group));
  }
  return mount("none", "/", nullptr, MS_REC | MS_PRIVATE, nullptr) == 0;
}

}  // namespace

bool have_own_mounts() {
  static const bool have = enter_own_mounts();
  return have;
}

SmallDisk::SmallDisk(std::filesystem::path folder, long kilobytes)
    : folder_(std::move(folder)), kilobytes_(kilobytes) {
  std::filesystem::create_directories(folder_);
  mounted_ = have_own_mounts() &&
             mount("tmpfs", folder_.c_str(), "tmpfs", 0, fmt::format("size={}k", kilobytes).c_str()) == 0;
}

SmallDisk::~SmallDisk() {
  if (mounted_) umount2(folder_.c_str(), MNT_DETACH);
}

void SmallDisk::resize(long kilobytes) {
  kilobytes_ = kilobytes;
  set_read_only(false);
}

void SmallDisk::set_read_only(bool read_only) {
  mount(nullptr, folder_.c_str(), nullptr, MS_REMOUNT | (read_only ? MS_RDONLY : 0),
        fmt::format("size={}k", kilobytes_).c_str());
}

}  // namespace sandstroke
