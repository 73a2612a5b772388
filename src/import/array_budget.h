#pragma once

#include <filesystem>
#include <string>

namespace sandstroke {

/// The bytes of a whole file. Error: io; input, if this machine has no memory for them and the numbers in
/// them.
std::string whole_file(const std::filesystem::path& path);

/// Limits the memory that the arrays of one file take, whatever the file says of their sizes.
class ArrayBudget {
 public:
  ArrayBudget(std::string file, double file_bytes);
  /// Call it before the memory is taken. Error: input, if the file cannot hold so many numbers, or this
  /// machine has no memory for them as doubles.
  void take(const std::string& array, double numbers);
  std::size_t bytes_left() const { return static_cast<std::size_t>(left_); }

 private:
  std::string file_;
  double left_;
};

}  // namespace sandstroke
