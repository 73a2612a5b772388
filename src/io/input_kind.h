#pragma once

#include <filesystem>
#include <initializer_list>

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

/// By content, but for a journal's ending; what is no regular file (a pipe) is left alone. No Error: whoever
/// reads the file says what is wrong with it.
InputKind kind_of(const std::filesystem::path& path);

/// Refuses a file that is plainly of another kind than the wanted ones, and says what it is for. One of
/// unknown kind passes. Error: input.
void expect_kind(const std::filesystem::path& path, std::initializer_list<InputKind> wanted);

}  // namespace sandstroke
