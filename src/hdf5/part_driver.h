#pragma once

#include <filesystem>

#include "hdf5/hdf5_handle.h"

namespace sandstroke {

// HDF5 writes its indices over the old ones, one after the other, at any time. A kill in between leaves a
// file that nobody can read. So this program writes and reads PATH.part through its own driver: on the disk
// the file stays as the last commit left it. The driver writes new bytes behind the end at once. Pages that
// replace old ones wait in memory. A commit
//   1. appends these pages to the file, and a seal,
//   2. writes them to their addresses,
//   3. cuts off what it appended.
// A kill before the seal leaves the old state. After a later kill this driver reads the pages behind the end.
// This protects against kills only: a power failure would need writes to be forced to the disk in between.

/// Access properties for PATH.part.
Hdf5Handle part_access();
/// Access properties for reading any file: PATH.part through the driver, others as HDF5 reads them.
Hdf5Handle reading_access(const std::filesystem::path& path);

/// Commits what H5Fflush() wrote into such a file: from now on a kill leaves this state. False: it could not
/// be written, and the state before stays.
bool commit_part(const Hdf5Handle& file);

/// The errno of the last refused read or write through this driver; 0: none since the last open.
int part_failure();

}  // namespace sandstroke
