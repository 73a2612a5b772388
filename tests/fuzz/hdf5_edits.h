#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>

namespace sandstroke {

/// The file for which an input of a target for HDF5 files stands. One that begins as HDF5 files do is the
/// file as it is; else its bytes, one after the other, say what is done to the objects of a good file: their
/// links are taken away, made to other objects (also to groups around them), to names, or to other files;
/// datasets and attributes are made anew with any type, shape, layout, filters and numbers; names are any
/// bytes.
void write_edited(const std::filesystem::path& good, const std::filesystem::path& edited,
                  const std::uint8_t* data, std::size_t size);

}  // namespace sandstroke
