#include "hdf5/hdf5_reader.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>

#include "core/error.h"
#include "core/file_lock.h"
#include "core/input_file.h"
#include "core/machine.h"
#include "hdf5/hdf5_storage.h"
#include "hdf5/part_driver.h"

namespace sandstroke {
namespace {

std::vector<hsize_t> extent_of(const Hdf5Handle& dataset) {
  const Hdf5Handle space(H5Dget_space(dataset), H5Sclose);
  const int rank = H5Sget_simple_extent_ndims(space);
  std::vector<hsize_t> shape(rank > 0 ? rank : 0);
  if (rank > 0) H5Sget_simple_extent_dims(space, shape.data(), nullptr);
  return shape;
}

/// Reads a scalar string, of fixed or variable length. False: it is no string. read: gets the memory type and
/// the buffer.
template <class Read>
bool read_string(hid_t file_type, std::string& text, const Read& read) {
  if (H5Tget_class(file_type) != H5T_STRING) return false;
  const Hdf5Handle memory_type(H5Tcopy(H5T_C_S1), H5Tclose);
  H5Tset_cset(memory_type, H5Tget_cset(file_type));
  if (H5Tis_variable_str(file_type) > 0) {
    H5Tset_size(memory_type, H5T_VARIABLE);
    char* characters = nullptr;
    read(memory_type, &characters);
    text = characters ? characters : "";
    H5free_memory(characters);
    return true;
  }
  const std::size_t length = H5Tget_size(file_type);
  H5Tset_size(memory_type, length + 1);
  text.assign(length + 1, '\0');
  read(memory_type, text.data());
  text.resize(std::strlen(text.c_str()));
  return true;
}

/// HDF5 calls this for each link or attribute. It adds the name to a list. HDF5 1.10 must not sort them: if
/// it fails in between, it frees memory that it never took.
template <class Info>
herr_t add_name(hid_t, const char* name, const Info*, void* list) {
  static_cast<std::vector<std::string>*>(list)->emplace_back(name);
  return 0;
}

/// True if sandstroke is writing the file, or another program has it open for writing through HDF5, which
/// locks it where there are locks.
bool is_being_written(const std::filesystem::path& path) {
  if (path.extension() == ".part" && !FileLock::try_share(path)) return true;
  const int file = open(path.c_str(), O_RDONLY | O_CLOEXEC);
  const bool locked = flock(file, LOCK_SH | LOCK_NB) != 0 && errno == EWOULDBLOCK;
  if (file >= 0) close(file);
  return locked;
}

}  // namespace

bool is_hdf5_number(hid_t type) {
  const H5T_class_t kind = H5Tget_class(type);
  return kind == H5T_INTEGER || kind == H5T_FLOAT || kind == H5T_ENUM;
}

Hdf5Reader::Hdf5Reader(const std::filesystem::path& path) : name_(path.string()) {
  prepare_hdf5();
  if (!begins_with(path, hdf5_signature) && H5Fis_hdf5(name_.c_str()) <= 0) {
    check_can_be_read_whole(path);
    throw_input_error("{}: is not an HDF5 file; name another file", name_);
  }
  if (!is_being_written(path))
    file_ = Hdf5Handle(H5Fopen(name_.c_str(), H5F_ACC_RDONLY, reading_access(path)), H5Fclose);
  if (!file_.valid()) {
    check_can_be_read_whole(path);
    throw_input_error("{}: is a damaged or truncated HDF5 file, or still being written; make it again",
                      name_);
  }
  hsize_t bytes = 0;
  H5Fget_filesize(file_, &bytes);
  file_bytes_ = static_cast<double>(bytes);
  access_ = Hdf5Handle(H5Pcreate(H5P_DATASET_ACCESS), H5Pclose);
  const auto refuse = [](const char*, const char*, const char*, const char*, unsigned*, hid_t,
                         void*) -> herr_t { return -1; };
  H5Pset_elink_cb(access_, refuse, nullptr);
}

void Hdf5Reader::fail(const std::string& object, const std::string& sentence) const {
  throw_input_error("{}: {} {}", name_, object, sentence);
}

void Hdf5Reader::fail_to_read(const std::string& object, const std::string& sentence) const {
  check_can_be_read_whole(name_);
  fail(object, sentence);
}

bool Hdf5Reader::yes(const std::function<htri_t()>& ask) const {
  htri_t answer = ask();
  if (answer < 0) {
    check_can_be_read_whole(name_);
    answer = ask();  // the disk may have failed once; a link into another file always fails
  }
  return answer > 0;
}

bool Hdf5Reader::has(const std::string& object) const {
  if (object == "/") return true;
  // H5Lexists needs every group on the way to exist.
  for (std::size_t slash = object.find('/', 1); slash != std::string::npos;
       slash = object.find('/', slash + 1)) {
    if (!yes([&] { return H5Lexists(file_, object.substr(0, slash).c_str(), access_); })) return false;
  }
  return yes([&] { return H5Lexists(file_, object.c_str(), access_); }) &&
         yes([&] { return H5Oexists_by_name(file_, object.c_str(), access_); });
}

Hdf5Handle Hdf5Reader::open_dataset(const std::string& dataset) const {
  if (!has(dataset)) fail(dataset, "is missing; name a file of the right kind");
  Hdf5Handle opened(H5Dopen2(file_, dataset.c_str(), access_), H5Dclose);
  if (!opened.valid()) fail_to_read(dataset, "is not a dataset; name a file of the right kind");
  if (const std::string fault = layout_fault(opened, file_bytes_); !fault.empty()) fail(dataset, fault);
  return opened;
}

Hdf5Handle Hdf5Reader::open_numbers(const std::string& dataset, int rank, std::vector<hsize_t>& shape) const {
  Hdf5Handle opened = open_dataset(dataset);
  const Hdf5Handle type(H5Dget_type(opened), H5Tclose);
  if (!is_hdf5_number(type)) fail(dataset, "does not hold numbers; write it as float64");
  shape = extent_of(opened);
  if (static_cast<int>(shape.size()) != rank)
    fail(dataset, fmt::format("has {} dimensions; write it with {}", shape.size(), rank));
  hsize_t count = 1;
  constexpr hsize_t most = hsize_t{1} << 32;
  for (const hsize_t side : shape) {
    if (side > most || (count *= side) > most)
      fail(dataset, "claims over 4e9 numbers; it is damaged or too large");
  }
  return opened;
}

Hdf5Handle Hdf5Reader::open_column(const std::string& dataset, int rank, std::size_t row_bytes,
                                   std::vector<hsize_t>& shape) const {
  Hdf5Handle opened = open_numbers(dataset, rank, shape);
  if (static_cast<double>(shape[0]) * static_cast<double>(row_bytes) > most_unpacked(file_bytes_))
    fail(dataset,
         fmt::format("claims {} rows, but its file has {} bytes; it is damaged", shape[0], file_bytes_));
  return opened;
}

void Hdf5Reader::read(const std::string& dataset, const Hdf5Handle& opened, hid_t memory_type,
                      void* values) const {
  if (const std::string fault = storage_fault(opened, file_bytes_); !fault.empty())
    fail_to_read(dataset, fault);
  constexpr double most_chunks = 2e5;  // HDF5 takes memory for each chunk
  if (const double chunks = chunk_count(opened); chunks > most_chunks)
    fail(dataset,
         fmt::format("has {:.0f} chunks, which are too many; make them larger: h5repack -l CHUNK=... OLD NEW",
                     chunks));
  if (H5Dread(opened, memory_type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values) < 0)
    fail_to_read(dataset, "cannot be read; the file is damaged");
}

std::vector<hsize_t> Hdf5Reader::shape(const std::string& dataset) const {
  return extent_of(open_dataset(dataset));
}

std::vector<double> Hdf5Reader::doubles(const std::string& dataset) const {
  std::vector<hsize_t> shape;
  const Hdf5Handle opened = open_column(dataset, 1, sizeof(double), shape);
  std::vector<double> values(shape[0]);
  read(dataset, opened, H5T_NATIVE_DOUBLE, values.data());
  return values;
}

std::vector<std::uint32_t> Hdf5Reader::integers(const std::string& dataset) const {
  std::vector<hsize_t> shape;
  const Hdf5Handle opened = open_column(dataset, 1, sizeof(std::int64_t) + sizeof(std::uint32_t), shape);
  std::vector<std::int64_t> stored(shape[0]);  // HDF5 would turn -1 into 0
  read(dataset, opened, H5T_NATIVE_INT64, stored.data());
  constexpr std::int64_t most = std::numeric_limits<std::uint32_t>::max();
  for (const std::int64_t value : stored)
    if (value < 0 || value > most)
      fail(dataset, fmt::format("holds {}; write whole numbers from 0 to {}", value, most));
  return {stored.begin(), stored.end()};
}

std::vector<Eigen::Vector3d> Hdf5Reader::vectors(const std::string& dataset) const {
  std::vector<hsize_t> shape;
  const Hdf5Handle opened = open_column(dataset, 2, sizeof(Eigen::Vector3d), shape);
  if (shape[1] != 3) fail(dataset, fmt::format("has {} columns; write x, y, z", shape[1]));
  std::vector<Eigen::Vector3d> values(shape[0]);
  read(dataset, opened, H5T_NATIVE_DOUBLE, values.data());
  return values;
}

std::vector<Eigen::Vector4d> Hdf5Reader::quaternions(const std::string& dataset) const {
  std::vector<hsize_t> shape;
  const Hdf5Handle opened = open_column(dataset, 2, sizeof(Eigen::Vector4d), shape);
  if (shape[1] != 4) fail(dataset, fmt::format("has {} columns; write x, y, z, w", shape[1]));
  std::vector<Eigen::Vector4d> values(shape[0]);
  read(dataset, opened, H5T_NATIVE_DOUBLE, values.data());
  return values;
}

HeightGrid Hdf5Reader::grid(const std::string& dataset) const {
  std::vector<hsize_t> shape;
  const Hdf5Handle opened = open_numbers(dataset, 2, shape);
  // The file's size does not limit the grid's: parts that were never written take no room in it. A caller
  // that works with a grid holds a few of its size.
  check_memory(4.0 * sizeof(double) * static_cast<double>(shape[0]) * static_cast<double>(shape[1]),
               fmt::format("{}: {}: working with {} x {} numbers", name_, dataset, shape[0], shape[1]),
               "read a part of it, for example with h5py");
  HeightGrid values(static_cast<Eigen::Index>(shape[0]), static_cast<Eigen::Index>(shape[1]));
  read(dataset, opened, H5T_NATIVE_DOUBLE, values.data());
  return values;
}

BedGeometry Hdf5Reader::bed_geometry(const std::string& dataset, double cell_size) const {
  std::vector<hsize_t> shape;
  open_numbers(dataset, 2, shape);
  constexpr hsize_t largest = BedGeometry::most_cells;
  if (shape[0] > largest || shape[1] > largest)
    fail(dataset,
         fmt::format("has {} x {} cells; a bed has at most {} per side", shape[0], shape[1], largest));
  return {static_cast<int>(shape[0]), static_cast<int>(shape[1]), cell_size};
}

double Hdf5Reader::fill_value(const std::string& dataset) const {
  const Hdf5Handle opened = open_dataset(dataset);
  const Hdf5Handle properties(H5Dget_create_plist(opened), H5Pclose);
  double fill = 0.0;
  if (H5Pget_fill_value(properties, H5T_NATIVE_DOUBLE, &fill) < 0)
    fail_to_read(dataset, "cannot be read; the file is damaged");
  return fill;
}

void Hdf5Reader::visit_written(
    const std::string& dataset,
    const std::function<void(Eigen::Index, Eigen::Index, const HeightGrid&)>& visit) const {
  std::vector<hsize_t> shape;
  const Hdf5Handle opened = open_numbers(dataset, 2, shape);
  const Hdf5Handle properties(H5Dget_create_plist(opened), H5Pclose);
  if (H5Pget_layout(properties) != H5D_CHUNKED) return visit(0, 0, grid(dataset));
  std::vector<std::array<hsize_t, 2>> starts;
  const std::string fault = storage_fault(opened, file_bytes_, [&](const hsize_t* start) {
    starts.push_back({start[0], start[1]});
  });
  if (!fault.empty()) fail_to_read(dataset, fault);
  hsize_t chunk[2] = {1, 1};
  H5Pget_chunk(properties, 2, chunk);
  const Hdf5Handle space(H5Dget_space(opened), H5Sclose);
  std::sort(starts.begin(), starts.end());
  for (const auto& start : starts) {
    if (start[0] >= shape[0] || start[1] >= shape[1]) fail(dataset, "cannot be read; the file is damaged");
    const hsize_t block[2] = {std::min(chunk[0], shape[0] - start[0]),
                              std::min(chunk[1], shape[1] - start[1])};
    HeightGrid heights(static_cast<Eigen::Index>(block[0]), static_cast<Eigen::Index>(block[1]));
    const Hdf5Handle memory_space(H5Screate_simple(2, block, nullptr), H5Sclose);
    H5Sselect_hyperslab(space, H5S_SELECT_SET, start.data(), nullptr, block, nullptr);
    if (H5Dread(opened, H5T_NATIVE_DOUBLE, memory_space, space, H5P_DEFAULT, heights.data()) < 0)
      fail_to_read(dataset, "cannot be read; the file is damaged");
    visit(static_cast<Eigen::Index>(start[0]), static_cast<Eigen::Index>(start[1]), heights);
  }
}

HeightField Hdf5Reader::bed(const std::string& dataset, double cell_size) const {
  const BedGeometry shape = bed_geometry(dataset, cell_size);
  HeightField bed(shape.rows(), shape.cols(), cell_size, std::make_shared<LevelRule>(fill_value(dataset)));
  visit_written(dataset, [&](Eigen::Index first_row, Eigen::Index first_col, const HeightGrid& heights) {
    bed.set_block(static_cast<int>(first_row), static_cast<int>(first_col), heights);
  });
  return bed;
}

std::string Hdf5Reader::text(const std::string& dataset) const {
  const Hdf5Handle opened = open_dataset(dataset);
  const Hdf5Handle type(H5Dget_type(opened), H5Tclose);
  if (static_cast<double>(H5Tget_size(type)) > most_unpacked(file_bytes_))
    fail(dataset, fmt::format("claims {} letters, but its file has {} bytes; it is damaged",
                              H5Tget_size(type), file_bytes_));
  std::string text;
  const bool is_text =
      extent_of(opened).empty() && read_string(type, text, [&](hid_t memory_type, void* buffer) {
        read(dataset, opened, memory_type, buffer);
      });
  if (!is_text) fail(dataset, "is not a string; name a file of the right kind");
  return text;
}

bool Hdf5Reader::has_attribute(const std::string& object, const std::string& attribute) const {
  return has(object) &&
         yes([&] { return H5Aexists_by_name(file_, object.c_str(), attribute.c_str(), access_); });
}

Hdf5Handle Hdf5Reader::open_attribute(const std::string& object, const std::string& attribute) const {
  if (!has_attribute(object, attribute))
    fail(object, fmt::format("has no attribute '{}'; name a file of the right kind", attribute));
  Hdf5Handle opened(H5Aopen_by_name(file_, object.c_str(), attribute.c_str(), H5P_DEFAULT, access_),
                    H5Aclose);
  if (!opened.valid())
    fail_to_read(object, fmt::format("attribute '{}' cannot be read; the file is damaged", attribute));
  return opened;
}

double Hdf5Reader::number_attribute(const std::string& object, const std::string& attribute) const {
  const Hdf5Handle opened = open_attribute(object, attribute);
  const Hdf5Handle type(H5Aget_type(opened), H5Tclose);
  const Hdf5Handle space(H5Aget_space(opened), H5Sclose);
  double value = 0.0;
  if (!is_hdf5_number(type) || H5Sget_simple_extent_npoints(space) != 1 ||
      H5Aread(opened, H5T_NATIVE_DOUBLE, &value) < 0)
    fail_to_read(object, fmt::format("attribute '{}' is not a single number", attribute));
  return value;
}

std::string Hdf5Reader::text_attribute(const std::string& object, const std::string& attribute) const {
  const Hdf5Handle opened = open_attribute(object, attribute);
  const Hdf5Handle type(H5Aget_type(opened), H5Tclose);
  const Hdf5Handle space(H5Aget_space(opened), H5Sclose);
  std::string text;
  const bool is_text =
      H5Sget_simple_extent_npoints(space) == 1 && static_cast<double>(H5Tget_size(type)) <= file_bytes_ &&
      read_string(type, text, [&](hid_t memory_type, void* buffer) {
        if (H5Aread(opened, memory_type, buffer) < 0)
          fail_to_read(object, fmt::format("attribute '{}' cannot be read; the file is damaged", attribute));
      });
  if (!is_text) fail(object, fmt::format("attribute '{}' is not a single string", attribute));
  return text;
}

double Hdf5Reader::cell_size(const std::string& object) const {
  const double size = number_attribute(object, "cell_size");
  if (!(size > 0.0 && std::isfinite(size)))
    fail(object, fmt::format("has cell_size {}; the file is damaged", size));
  return size;
}

std::vector<std::string> Hdf5Reader::members(const std::string& group) const {
  if (!has(group)) fail(group, "is missing; name a file of the right kind");
  std::vector<std::string> names;
  if (H5Literate_by_name(file_, group.c_str(), H5_INDEX_NAME, H5_ITER_NATIVE, nullptr, add_name<H5L_info_t>,
                         &names, access_) < 0)
    fail_to_read(group, "is not a group; name a file of the right kind");
  std::sort(names.begin(), names.end());
  return names;
}

std::vector<std::string> Hdf5Reader::attributes(const std::string& object) const {
  if (!has(object)) fail(object, "is missing; name a file of the right kind");
  std::vector<std::string> names;
  if (H5Aiterate_by_name(file_, object.c_str(), H5_INDEX_NAME, H5_ITER_NATIVE, nullptr, add_name<H5A_info_t>,
                         &names, access_) < 0)
    fail_to_read(object, "has attributes that cannot be read; the file is damaged");
  std::sort(names.begin(), names.end());
  return names;
}

}  // namespace sandstroke
