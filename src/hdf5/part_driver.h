#pragma once

#include <filesystem>

#include "hdf5/hdf5_handle.h"

namespace sandstroke {

// HDF5 writes its indices over the old ones, one after the other, whenever it likes. A kill in between leaves
// a file that nobody can read. So PATH.part is written and read through a driver of its own: on the disk the
// file stays as the last commit left it. New bytes behind its end are written at once. Pages that are to
// replace old ones wait in memory. A commit
//   1. appends these pages to the file, and a seal,
//   2. writes them into their places,
//   3. cuts off what it appended.
// A kill before the seal leaves the old state. After a later kill this driver reads the pages behind the end.
// This is about kills: nothing is forced to the disk in between, as a power failure would need.

/// How PATH.part is opened.
Hdf5Handle part_access();
/// How any file is opened to be read: PATH.part so, and others as HDF5 does.
Hdf5Handle reading_access(const std::filesystem::path& path);

/// Makes what H5Fflush() wrote into such a file the state that a kill leaves. False: it could not be written,
/// and the state before stays.
bool commit_part(const Hdf5Handle& file);

/// What the system said when it last refused to read or write a file opened so; 0: it never did.
int part_failure();

}  // namespace sandstroke
