#include "hdf5/hdf5_writer.h"

#include <algorithm>
#include <cstring>

#include "core/error.h"
#include "core/output_file.h"
#include "core/version.h"
#include "hdf5/part_driver.h"

namespace sandstroke {
namespace {

constexpr hsize_t rows_per_chunk = 4096;  // of a growing column
constexpr hsize_t chunk_side = 128;       // of a height field: a whole number of tiles
constexpr hsize_t row_chunk = 65536;      // of numbers in a row

[[noreturn]] void throw_write_error(const std::string& where) {
  const std::string reason = part_failure() ? fmt::format(" ({})", std::strerror(part_failure())) : "";
  throw_io_error("{}: cannot be written{}; free disk space or choose another place", where, reason);
}

Hdf5Handle string_type(std::size_t length) {
  Hdf5Handle type(H5Tcopy(H5T_C_S1), H5Tclose);
  H5Tset_size(type, std::max<std::size_t>(1, length));
  H5Tset_cset(type, H5T_CSET_UTF8);
  return type;
}

/// A space of this shape; a scalar's if the shape is empty.
Hdf5Handle space_of(const std::vector<hsize_t>& shape) {
  return {shape.empty() ? H5Screate(H5S_SCALAR)
                        : H5Screate_simple(static_cast<int>(shape.size()), shape.data(), nullptr),
          H5Sclose};
}

/// Rows go to the file at once, not when a cache is full, so that it is known before what a flush takes.
Hdf5Handle row_by_row() {
  Hdf5Handle access(H5Pcreate(H5P_DATASET_ACCESS), H5Pclose);
  H5Pset_chunk_cache(access, 0, 0, H5D_CHUNK_CACHE_W0_DEFAULT);
  return access;
}

Hdf5Handle dataset_properties(const std::vector<hsize_t>& chunk, Compression compression) {
  Hdf5Handle properties(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
  H5Pset_obj_track_times(properties, false);  // the same content, the same bytes
  if (!chunk.empty()) H5Pset_chunk(properties, static_cast<int>(chunk.size()), chunk.data());
  if (compression != Compression::none) {
    H5Pset_shuffle(properties);
    H5Pset_deflate(properties, compression == Compression::small ? 9 : 1);
  }
  return properties;
}

}  // namespace

void Hdf5Column::extend(const void* rows, std::size_t count, hid_t memory_type) {
  if (count == 0) return;
  const int rank = width_ == 1 ? 1 : 2;
  const hsize_t extent[2] = {count_ + count, width_};
  const hsize_t start[2] = {count_, 0};
  const hsize_t block[2] = {count, width_};
  if (H5Dset_extent(dataset_, extent) < 0) throw_write_error(where_);
  const Hdf5Handle file_space(H5Dget_space(dataset_), H5Sclose);
  const Hdf5Handle memory_space(H5Screate_simple(rank, block, nullptr), H5Sclose);
  H5Sselect_hyperslab(file_space, H5S_SELECT_SET, start, nullptr, block, nullptr);
  if (H5Dwrite(dataset_, memory_type, memory_space, file_space, H5P_DEFAULT, rows) < 0)
    throw_write_error(where_);
  count_ += count;
}

void Hdf5Chunks::write(int row, int col, const double* numbers) {
  const hsize_t first[2] = {static_cast<hsize_t>(row), static_cast<hsize_t>(col)};
  // Writes past HDF5's cache of chunks, because nothing has to be converted.
  if (H5Dwrite_chunk(dataset_, H5P_DEFAULT, 0, first, size() * sizeof(double), numbers) < 0)
    throw_write_error(where_);
}

Hdf5Writer::Hdf5Writer(const std::filesystem::path& path, const OutputKind& kind, Begins begins)
    : path_(path), kind_(kind), lock_(take_part(path, kind)) {
  prepare_hdf5();
  if (begins == Begins::from_part) {
    file_ = Hdf5Handle(H5Fopen(part_path(path).c_str(), H5F_ACC_RDWR, part_access()), H5Fclose);
    flushed_ = true;  // it is never dropped
    check(file_.valid(), "");
    return;
  }
  file_ = Hdf5Handle(H5Fcreate(part_path(path).c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, part_access()), H5Fclose);
  try {
    check(file_.valid(), "");
    attribute("/", "written_by", std::string(build));
    if (!kind.mark.empty()) {
      attribute("/", "format", std::string(kind.mark));
      attribute("/", "format_version", kind.version);
      commit();  // from now on the file is known to be ours
    }
  } catch (const Error&) {
    drop();
    throw;
  }
}

Hdf5Writer::~Hdf5Writer() {
  if (!flushed_) drop();
  // Closing would write what came after the last flush, on a full disk only half of it. So the file stays as
  // it was flushed.
  file_.release();
}

void Hdf5Writer::drop() {
  file_.close();
  drop_part(path_);
}

void Hdf5Writer::check(bool done, const std::string& object) const {
  if (!done) throw_write_error(object.empty() ? path_.string() : path_.string() + ": " + object);
}

Hdf5Handle Hdf5Writer::create(const std::string& dataset, hid_t type, const Hdf5Handle& space,
                              const Hdf5Handle& properties, hid_t access) {
  const Hdf5Handle links(H5Pcreate(H5P_LINK_CREATE), H5Pclose);
  H5Pset_create_intermediate_group(links, 1);
  Hdf5Handle created(H5Dcreate2(file_, dataset.c_str(), type, space, links, properties, access), H5Dclose);
  check(created.valid(), dataset);
  return created;
}

void Hdf5Writer::put(const std::string& dataset, hid_t type, const std::vector<hsize_t>& shape,
                     const void* values, Compression compression) {
  const bool empty = std::find(shape.begin(), shape.end(), hsize_t{0}) != shape.end();
  std::vector<hsize_t> chunk;
  if (compression != Compression::none && !empty)
    for (const hsize_t side : shape)
      chunk.push_back(std::min(side, shape.size() == 1 ? row_chunk : chunk_side));
  const Hdf5Handle space = space_of(shape);
  const Hdf5Handle properties = dataset_properties(chunk, chunk.empty() ? Compression::none : compression);
  const Hdf5Handle created = create(dataset, type, space, properties);
  if (!empty) check(H5Dwrite(created, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values) >= 0, dataset);
}

void Hdf5Writer::write(const std::string& dataset, const std::vector<double>& values) {
  put(dataset, H5T_NATIVE_DOUBLE, {values.size()}, values.data());
}
void Hdf5Writer::write(const std::string& dataset, const std::vector<Eigen::Vector3d>& values) {
  put(dataset, H5T_NATIVE_DOUBLE, {values.size(), 3}, values.data());
}
void Hdf5Writer::write(const std::string& dataset, const std::vector<Eigen::Vector4d>& values) {
  put(dataset, H5T_NATIVE_DOUBLE, {values.size(), 4}, values.data());
}
void Hdf5Writer::write(const std::string& dataset, const std::vector<std::uint32_t>& values) {
  put(dataset, H5T_NATIVE_UINT32, {values.size()}, values.data());
}
void Hdf5Writer::write(const std::string& dataset, const std::vector<std::uint8_t>& values) {
  put(dataset, H5T_NATIVE_UINT8, {values.size()}, values.data());
}
void Hdf5Writer::write(const std::string& dataset, const HeightGrid& heights, Compression compression) {
  put(dataset, H5T_NATIVE_DOUBLE,
      {static_cast<hsize_t>(heights.rows()), static_cast<hsize_t>(heights.cols())}, heights.data(),
      compression);
}
void Hdf5Writer::write_whole_numbers(const std::string& dataset, const HeightGrid& numbers) {
  constexpr hsize_t cols_per_chunk = 16384;
  const std::vector<hsize_t> shape = {static_cast<hsize_t>(numbers.rows()),
                                      static_cast<hsize_t>(numbers.cols())};
  const Hdf5Handle properties =
      dataset_properties({shape[0], std::min(shape[1], cols_per_chunk)}, Compression::small);
  const Hdf5Handle created = create(dataset, H5T_STD_U64LE, space_of(shape), properties);
  check(H5Dwrite(created, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, numbers.data()) >= 0, dataset);
}
void Hdf5Writer::write(const std::string& dataset, const std::string& text) {
  put(dataset, string_type(text.size()), {}, text.c_str());
}
void Hdf5Writer::write(const std::string& dataset, const std::vector<std::string>& texts) {
  std::size_t longest = 0;
  for (const std::string& text : texts) longest = std::max(longest, text.size());
  const Hdf5Handle type = string_type(longest);
  std::string block;
  for (const std::string& text : texts) block += text + std::string(H5Tget_size(type) - text.size(), '\0');
  put(dataset, type, {texts.size()}, block.data());
}

void Hdf5Writer::put_attribute(const std::string& object, const std::string& attribute, hid_t type,
                               const std::vector<hsize_t>& shape, const void* values) {
  const Hdf5Handle space = space_of(shape);
  const Hdf5Handle owner(H5Oopen(file_, object.c_str(), H5P_DEFAULT), H5Oclose);
  if (H5Aexists(owner, attribute.c_str()) > 0) H5Adelete(owner, attribute.c_str());
  const Hdf5Handle created(H5Acreate2(owner, attribute.c_str(), type, space, H5P_DEFAULT, H5P_DEFAULT),
                           H5Aclose);
  check(created.valid() && H5Awrite(created, type, values) >= 0, object);
}

void Hdf5Writer::attribute(const std::string& object, const std::string& attribute,
                           const std::string& value) {
  put_attribute(object, attribute, string_type(value.size()), {}, value.c_str());
}

void Hdf5Writer::describe(const std::string& dataset, const std::string& units, const std::string& meaning) {
  attribute(dataset, "long_name", meaning);
  if (!units.empty()) attribute(dataset, "units", units);
}

Hdf5Column Hdf5Writer::growing(const std::string& dataset, hid_t type, int width) {
  const int rank = width == 1 ? 1 : 2;
  const hsize_t shape[2] = {0, static_cast<hsize_t>(width)};
  const hsize_t most[2] = {H5S_UNLIMITED, static_cast<hsize_t>(width)};
  std::vector<hsize_t> chunk = {rows_per_chunk};
  if (rank == 2) chunk.push_back(width);
  const Hdf5Handle space(H5Screate_simple(rank, shape, most), H5Sclose);
  Hdf5Column column;
  column.dataset_ = create(dataset, type, space, dataset_properties(chunk, Compression::none), row_by_row());
  column.where_ = path_.string() + ": " + dataset;
  column.width_ = width;
  return column;
}

Hdf5Column Hdf5Writer::shortened(const std::string& dataset, std::uint64_t rows) {
  Hdf5Column column;
  column.dataset_ = Hdf5Handle(H5Dopen2(file_, dataset.c_str(), row_by_row()), H5Dclose);
  column.where_ = path_.string() + ": " + dataset;
  const Hdf5Handle space(column.dataset_.valid() ? H5Dget_space(column.dataset_) : -1, H5Sclose);
  hsize_t extent[2] = {0, 1};
  const int rank = space.valid() ? H5Sget_simple_extent_ndims(space) : 0;
  if (rank < 1 || rank > 2 || H5Sget_simple_extent_dims(space, extent, nullptr) != rank || extent[0] < rows)
    throw_input_error("{}: has fewer rows than when the run's state was kept", column.where_);
  column.width_ = extent[1];
  column.count_ = extent[0] = rows;
  check(H5Dset_extent(column.dataset_, extent) >= 0, dataset);
  return column;
}

bool Hdf5Writer::has(const std::string& object) const {
  return H5Lexists(file_, object.c_str(), H5P_DEFAULT) > 0;  // negative: a group on the way is missing
}

void Hdf5Writer::remove(const std::string& object) {
  if (has(object)) check(H5Ldelete(file_, object.c_str(), H5P_DEFAULT) >= 0, object);
}

Hdf5Chunks Hdf5Writer::chunks(const std::string& dataset, std::array<int, 2> shape, std::array<int, 2> chunk,
                              double fill) {
  Hdf5Chunks chunks;
  chunks.rows_ = std::clamp(shape[0], 1, chunk[0]);
  chunks.cols_ = std::clamp(shape[1], 1, chunk[1]);
  chunks.where_ = path_.string() + ": " + dataset;
  const hsize_t extent[2] = {static_cast<hsize_t>(shape[0]), static_cast<hsize_t>(shape[1])};
  const Hdf5Handle space(H5Screate_simple(2, extent, nullptr), H5Sclose);
  const Hdf5Handle properties = dataset_properties({chunks.rows_, chunks.cols_}, Compression::none);
  check(H5Pset_fill_value(properties, H5T_NATIVE_DOUBLE, &fill) >= 0 &&
            H5Pset_alloc_time(properties, H5D_ALLOC_TIME_INCR) >= 0 &&
            H5Pset_fill_time(properties, H5D_FILL_TIME_IFSET) >=
                0,  // with "never", missing chunks would not read as the fill value
        dataset);
  chunks.dataset_ = create(dataset, H5T_NATIVE_DOUBLE, space, properties);
  return chunks;
}

void Hdf5Writer::make_group(const std::string& group) {
  const Hdf5Handle links(H5Pcreate(H5P_LINK_CREATE), H5Pclose);
  H5Pset_create_intermediate_group(links, 1);
  const Hdf5Handle made(H5Gcreate2(file_, group.c_str(), links, H5P_DEFAULT, H5P_DEFAULT), H5Gclose);
  check(made.valid(), group);
}

void Hdf5Writer::commit() { check(H5Fflush(file_, H5F_SCOPE_GLOBAL) >= 0 && commit_part(file_), ""); }

void Hdf5Writer::flush() {
  commit();
  flushed_ = true;
}

void Hdf5Writer::finish() {
  flush();
  check(file_.close(), "");
  finish_part(path_, kind_);
}

}  // namespace sandstroke
