#pragma once

#include <filesystem>
#include <string>

namespace sandstroke {

/// The memory of this machine [bytes].
double physical_memory();

/// Memory that this process may still take: the least of what the machine has free (or can free), what ulimit
/// leaves, and what the process's control group (a container, a batch job, a service) leaves.
struct MemoryRoom {
  double bytes = 0.0;
  std::string reason;  ///< for messages: "this machine has 3.4 GB free"
};
MemoryRoom memory_room();

/// Error: input, "WHAT takes about 3 GB of memory, but this machine has 2 GB free; REMEDY", if `bytes` is
/// more than `fraction` times memory_room(). Call it before the memory is taken.
void check_memory(double bytes, const std::string& what, const std::string& remedy, double fraction = 1.0);

/// Error: input, if the address space (ulimit -v) has no room for so many more bytes that are only mapped,
/// such as those of a library.
void check_addresses(double bytes, const std::string& what, const std::string& remedy);

/// Error: io, "PATH: takes about 3 GB, but the disk has room for 2 GB; REMEDY", if a file of so many bytes
/// has no room there or is larger than the system allows (ulimit -f). The room of an old PATH.part counts as
/// free. Call it before any work.
void check_disk(const std::filesystem::path& path, double bytes, const std::string& remedy);

/// Makes threads share one heap if the address space is limited (ulimit -v): otherwise each thread reserves
/// 64 MB of it for its own heap. Call it before there are threads.
void share_heap_if_limited();

/// From now on the process keeps freed memory for what comes next, up to 1 GB, unless its address space is
/// limited: for work that makes and frees large arrays in turn. To get their pages from the system takes
/// longer than the work.
void keep_freed_memory();

/// Error: io, if the stack of this process and its threads (ulimit -s) is too small for the libraries.
void check_stack();

/// Memory that control groups leave [bytes]; infinity if they set no limit. groups: the text of
/// /proc/self/cgroup (cgroups(7)); mount: the folder of their files.
double control_group_room(const std::string& groups, const std::filesystem::path& mount);

/// The processor's name from the system; "unknown" if the system gives none.
std::string cpu_name();

}  // namespace sandstroke
