#pragma once

#include <functional>
#include <string>

#include "hdf5/hdf5_handle.h"

namespace sandstroke {

// HDF5 1.10 believes what a file says of how its numbers are stored: it reads past the end of a chunk that
// unpacks to less than it should, takes memory for all that a chunk says it has, and opens whatever other
// file is named. So this is looked at before it is asked for numbers. What is wrong is said in words that
// follow the dataset's name; nothing is wrong where they are empty.

/// Bytes that a file of so many can hold when they are unpacked: deflate packs at most 1032 to 1.
double most_unpacked(double file_bytes);

/// Numbers in other files, filters that are not read here, chunks larger than the file can hold.
std::string layout_fault(const Hdf5Handle& dataset, double file_bytes);

/// Of every chunk that was written, where the layout is without fault: that it does not unpack to what a
/// chunk holds. visit: called with the first indices of each, one per dimension. No chunks: no fault.
std::string storage_fault(
    const Hdf5Handle& dataset, double file_bytes,
    const std::function<void(const hsize_t* start)>& visit = [](const hsize_t*) {});

/// In how many chunks it is cut, written or not.
double chunk_count(const Hdf5Handle& dataset);

}  // namespace sandstroke
