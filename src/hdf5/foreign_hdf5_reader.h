#pragma once

#include <string>
#include <vector>

#include "hdf5/hdf5_reader.h"

namespace sandstroke {

/// An HDF5 file of another program, whose content has to be found out. Errors as in Hdf5Reader.
class ForeignHdf5Reader : public Hdf5Reader {
 public:
  using Hdf5Reader::Hdf5Reader;

  /// A member of a group that belongs to it by a hard link. A group can hold itself: then the places are
  /// equal.
  struct Member {
    enum class Kind { group, dataset, other };
    std::string path;   ///< from the root
    std::string name;   ///< in its group
    std::string place;  ///< in the file; equal for the same object
    Kind kind = Kind::other;
  };
  /// In alphabetical order, without links by name and links into other files. Error: input, if there are more
  /// than `most`.
  std::vector<Member> own_members(const std::string& group, std::size_t most) const;

  /// True for real numbers of any kind, false for texts, references, pairs of numbers and others.
  bool has_numbers(const std::string& dataset) const;

  /// A dataset's numbers, in its own order.
  struct Numbers {
    enum class Kind { real, whole, natural } kind = Kind::real;  ///< 8 bytes each: double, int64, uint64
    std::vector<hsize_t> shape;
    std::string bytes;  ///< in the byte order of this machine
  };
  Numbers numbers(const std::string& dataset) const;

  double file_bytes() const { return file_bytes_; }
};

}  // namespace sandstroke
