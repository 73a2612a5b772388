#pragma once

#include <filesystem>
#include <initializer_list>

#include "core/error.h"
#include "core/output_file.h"
#include "hdf5/hdf5_file.h"

namespace sandstroke {

/// The kinds of files that this program reads or writes, by their content.
enum class InputKind {
  scene,
  plan,       ///< of a sweep
  script,     ///< a stroke, described by what it draws
  stroke,     ///< recorded
  recording,  ///< the journal of a recording that was cut off
  run,
  golden,
  sweep,  ///< its results, collected
  point,  ///< of a sweep
  bench,
  picture,
  unknown  ///< none of these, damaged, or not there
};

/// The output kind of an HDF5 file with a format, by which it is known.
OutputKind output_kind(InputKind kind);
/// True if a file has that kind's format, in any version.
bool has_format(const Hdf5Reader& file, InputKind kind);

/// The kind of a file by its content, or by its ending for a journal. It does not read from a pipe or a
/// device. Never an Error: the reader of the file says what is wrong with it.
InputKind kind_of(const std::filesystem::path& path);

/// Refuses a file that is plainly of another kind than the wanted ones, and says what it is for. A file of
/// unknown kind passes. Call it after reading has failed. Error: input.
void expect_kind(const std::filesystem::path& path, std::initializer_list<InputKind> wanted);

/// Returns what `read` makes of a file of one of these kinds. Error: that of `read`, or that the file is of
/// another kind.
template <class Read>
auto read_as(std::initializer_list<InputKind> wanted, const std::filesystem::path& path, const Read& read) {
  try {
    return read();
  } catch (const Error&) {
    expect_kind(path, wanted);
    throw;
  }
}

}  // namespace sandstroke
