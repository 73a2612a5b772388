#pragma once

#include <functional>
#include <string>

#include "hdf5/hdf5_handle.h"

namespace sandstroke {

// HDF5 1.10 believes what a file says about its storage. It reads past the end of a chunk that unpacks to
// less than it should, takes memory for all that a chunk claims to hold, and opens any other file that is
// named. So these functions check a dataset before numbers are read from it. They return what is wrong, in
// words that follow the dataset's name, or an empty text.

/// Most bytes that a file of `file_bytes` can unpack to: deflate packs at most 1032 to 1.
double most_unpacked(double file_bytes);

/// Finds numbers in other files, filters that are not read here, and chunks larger than the file can hold.
std::string layout_fault(const Hdf5Handle& dataset, double file_bytes);

/// Finds a written chunk that does not unpack to a chunk's size, or without chunks, too little room. The
/// layout must be without fault. visit: called with the first indices of each chunk, one per dimension.
std::string storage_fault(
    const Hdf5Handle& dataset, double file_bytes,
    const std::function<void(const hsize_t* start)>& visit = [](const hsize_t*) {});

/// The number of chunks, written or not.
double chunk_count(const Hdf5Handle& dataset);

}  // namespace sandstroke
