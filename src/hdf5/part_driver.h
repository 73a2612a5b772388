#pragma once

#include "hdf5/hdf5_handle.h"

namespace sandstroke {

// HDF5 writes its indices over the old ones, one after the other and whenever it likes: killed in between, it
// leaves a file that nobody can read. So PATH.part is written and read through a driver of its own, under
// which a file holds what it held at the last commit. What a commit has put there is not written over: pages
// that are to take its place wait in memory. A commit appends them to the file, and a seal; then it writes
// them into their places; then it cuts off what it appended. Who is killed before the seal leaves what was
// there before, and after it the pages, which the driver then reads from where they are.

/// How PATH.part is opened, for reading too.
Hdf5Handle part_access();

/// What H5Fflush() has written into a file opened so stands from now on. False: it could not be written; what
/// stood before still does.
bool commit_part(const Hdf5Handle& file);

/// What the system said when it last refused to read or write a file opened so; 0: it never did.
int part_failure();

}  // namespace sandstroke
