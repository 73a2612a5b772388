#pragma once

#include <filesystem>
#include <initializer_list>

#include "core/error.h"
#include "core/output_file.h"
#include "hdf5/hdf5_file.h"

namespace sandstroke {

/// The files that this program reads or writes, by what is in them.
enum class InputKind {
  scene,
  plan,       ///< of a sweep
  script,     ///< a stroke, as what it draws
  stroke,     ///< recorded
  recording,  ///< the journal of one that was cut off
  run,
  golden,
  sweep,  ///< its results, collected
  point,  ///< of a sweep
  bench,
  picture,
  unknown  ///< none of these, damaged, or not there
};

/// Of a kind that is an HDF5 file with a format: what is known by that.
OutputKind output_kind(InputKind kind);
/// Whether a file has that kind's format, in whatever version.
bool has_format(const Hdf5Reader& file, InputKind kind);

/// By content, but for a journal's ending; what is no regular file (a pipe) is left alone. No Error: whoever
/// reads the file says what is wrong with it.
InputKind kind_of(const std::filesystem::path& path);

/// Refuses a file that is plainly of another kind than the wanted ones, and says what it is for. One of
/// unknown kind passes. To be asked where reading failed. Error: input.
void expect_kind(const std::filesystem::path& path, std::initializer_list<InputKind> wanted);

/// What `read` makes of a file of one of these kinds. Error: what `read` says, or that the file is of another
/// kind.
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
