#pragma once

#include <filesystem>
#include <string>

namespace sandstroke {

/// Of this machine [bytes].
double physical_memory();

/// Memory that this process may still take: the least of what the machine has free (or can free), what
/// ulimit leaves, and what the process's control group leaves (of a container, a batch job, a service).
struct MemoryRoom {
  double bytes = 0.0;
  std::string reason;  ///< for messages: "this machine has 3.4 GB free"
};
MemoryRoom memory_room();

/// Error: input, "WHAT takes about 3 GB of memory, and this machine has 2 GB free; REMEDY", where it is more
/// than this share of memory_room(). To be asked before it is taken.
void check_memory(double bytes, const std::string& what, const std::string& remedy, double share = 1.0);

/// Error: input, where the address space (ulimit -v) has no room for so many more bytes, which are mapped
/// rather than taken, as those of a library.
void check_addresses(double bytes, const std::string& what, const std::string& remedy);

/// Error: io, "PATH: takes about 3 GB, and there is room for 2 GB; REMEDY", where a file of so many bytes has
/// no room there, or is more than the system lets it be (ulimit -f). What a PATH.part of before takes is
/// free. To be asked before any work is done.
void check_disk(const std::filesystem::path& path, double bytes, const std::string& remedy);

/// Where the address space is limited (ulimit -v), threads share one heap: else each reserves 64 MB of it for
/// a heap of its own. To be called before there are threads.
void share_heap_if_limited();

/// Error: io, where the stack of this process and its threads (ulimit -s) is too small for the libraries.
void check_stack();

/// What control groups leave [bytes], infinity where they set no limit. groups: the text of
/// /proc/self/cgroup (cgroups(7)); mount: where their files are.
double control_group_room(const std::string& groups, const std::filesystem::path& mount);

/// As the system calls it; "unknown" where it does not say.
std::string cpu_name();

}  // namespace sandstroke
