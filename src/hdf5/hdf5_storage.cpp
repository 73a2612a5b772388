#include "hdf5/hdf5_storage.h"

#include <spdlog/fmt/fmt.h>
#include <zlib.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

namespace sandstroke {
namespace {

constexpr const char* damaged = "cannot be read; the file is damaged";

/// How a chunked dataset is stored.
struct Chunks {
  int rank = 0;
  std::array<hsize_t, H5S_MAX_RANK> sides{};
  double bytes = 0.0;                 // of one chunk, unpacked
  std::vector<H5Z_filter_t> filters;  // in the order in which they pack

  explicit Chunks(const Hdf5Handle& properties, const Hdf5Handle& dataset) {
    rank = std::max(0, H5Pget_chunk(properties, H5S_MAX_RANK, sides.data()));
    const Hdf5Handle type(H5Dget_type(dataset), H5Tclose);
    bytes = static_cast<double>(H5Tget_size(type));
    for (int i = 0; i < rank; ++i) bytes *= static_cast<double>(sides[i]);
    for (int i = 0; i < H5Pget_nfilters(properties); ++i) {
      unsigned flags, config;
      std::size_t parameters = 0;
      filters.push_back(H5Pget_filter2(properties, static_cast<unsigned>(i), &flags, &parameters, nullptr, 0,
                                       nullptr, &config));
    }
  }
};

Hdf5Handle properties_of(const Hdf5Handle& dataset) { return {H5Dget_create_plist(dataset), H5Pclose}; }

/// True if the filters are shuffle, deflate and Fletcher's checksum, each at most once and in this order.
bool are_known(const std::vector<H5Z_filter_t>& filters) {
  const std::array known = {H5Z_FILTER_SHUFFLE, H5Z_FILTER_DEFLATE, H5Z_FILTER_FLETCHER32};
  auto next = known.begin();
  return std::all_of(filters.begin(), filters.end(), [&](H5Z_filter_t filter) {
    next = std::find(next, known.end(), filter);
    if (next == known.end()) return false;
    ++next;
    return true;
  });
}

/// True if a dataset without chunks has room for all its numbers. HDF5 would copy what lies behind it, or
/// nothing at all. A dataset that was never written has no room, and reads as its fill value.
bool has_room(const Hdf5Handle& dataset, H5D_layout_t layout, const Hdf5Handle& space) {
  const Hdf5Handle type(H5Dget_type(dataset), H5Tclose);
  const double needed =
      static_cast<double>(H5Sget_simple_extent_npoints(space)) * static_cast<double>(H5Tget_size(type));
  const double room = static_cast<double>(H5Dget_storage_size(dataset));
  return room == needed || (layout == H5D_CONTIGUOUS && room == 0.0);
}

/// True if a zlib stream unpacks to exactly so many bytes.
bool inflates_to(double bytes, std::vector<Bytef>& packed, std::size_t packed_bytes) {
  z_stream stream{};
  if (inflateInit(&stream) != Z_OK) return false;
  std::vector<Bytef> unpacked(1 << 16);
  stream.next_in = packed.data();
  stream.avail_in = static_cast<uInt>(packed_bytes);
  double total = 0.0;
  int state = Z_OK;
  while (state == Z_OK && total <= bytes) {
    stream.next_out = unpacked.data();
    stream.avail_out = static_cast<uInt>(unpacked.size());
    state = inflate(&stream, Z_NO_FLUSH);
    total += static_cast<double>(unpacked.size() - stream.avail_out);
  }
  inflateEnd(&stream);
  return state == Z_STREAM_END && total == bytes;
}

/// True if a chunk unpacks to its full size. skipped: bit i is set if filter i did not pack it. stored:
/// bytes.
bool is_whole(const Hdf5Handle& dataset, const Chunks& chunks, const hsize_t* start, unsigned skipped,
              hsize_t stored, double file_bytes) {
  if (static_cast<double>(stored) > file_bytes) return false;
  bool deflated = false;
  std::size_t checksum = 0;  // bytes
  for (std::size_t i = 0; i < chunks.filters.size(); ++i) {
    if (skipped >> i & 1) continue;
    deflated = deflated || chunks.filters[i] == H5Z_FILTER_DEFLATE;
    checksum += chunks.filters[i] == H5Z_FILTER_FLETCHER32 ? 4 : 0;
  }
  if (!deflated) return static_cast<double>(stored) == chunks.bytes + static_cast<double>(checksum);
  std::vector<Bytef> packed(stored);
  std::uint32_t mask = 0;
  return stored >= checksum && H5Dread_chunk(dataset, H5P_DEFAULT, start, &mask, packed.data()) >= 0 &&
         inflates_to(chunks.bytes, packed, stored - checksum);
}

}  // namespace

double most_unpacked(double file_bytes) { return 1e6 + 1032.0 * file_bytes; }

std::string layout_fault(const Hdf5Handle& dataset, double file_bytes) {
  const Hdf5Handle properties = properties_of(dataset);
  const H5D_layout_t layout = H5Pget_layout(properties);
  if (layout == H5D_VIRTUAL || H5Pget_external_count(properties) > 0)
    return "is stored in other files; copy it into this one";
  if (layout != H5D_CHUNKED) return H5Pget_nfilters(properties) == 0 ? "" : damaged;
  const Chunks chunks(properties, dataset);
  if (!are_known(chunks.filters)) return "has an unknown compression; repack it: h5repack -f GZIP=1 OLD NEW";
  if (!(chunks.bytes > 0.0 && chunks.bytes <= most_unpacked(file_bytes)))
    return fmt::format("has chunks of {:.0f} bytes, more than its file can hold; it is damaged",
                       chunks.bytes);
  return "";
}

std::string storage_fault(const Hdf5Handle& dataset, double file_bytes,
                          const std::function<void(const hsize_t* start)>& visit) {
  const Hdf5Handle properties = properties_of(dataset), space(H5Dget_space(dataset), H5Sclose);
  const H5D_layout_t layout = H5Pget_layout(properties);
  if (layout != H5D_CHUNKED) return has_room(dataset, layout, space) ? "" : damaged;
  const Chunks chunks(properties, dataset);
  hsize_t written = 0;
  if (H5Dget_num_chunks(dataset, space, &written) < 0) return damaged;
  for (hsize_t i = 0; i < written; ++i) {
    std::array<hsize_t, H5S_MAX_RANK> start{};
    hsize_t stored = 0;
    unsigned skipped = 0;
    if (H5Dget_chunk_info(dataset, space, i, start.data(), &skipped, nullptr, &stored) < 0) return damaged;
    for (int axis = 0; axis < chunks.rank; ++axis)
      if (start[axis] % chunks.sides[axis] != 0) return damaged;
    if (!is_whole(dataset, chunks, start.data(), skipped, stored, file_bytes)) return damaged;
    visit(start.data());
  }
  return "";
}

double chunk_count(const Hdf5Handle& dataset) {
  const Hdf5Handle properties = properties_of(dataset), space(H5Dget_space(dataset), H5Sclose);
  if (H5Pget_layout(properties) != H5D_CHUNKED) return 0.0;
  const Chunks chunks(properties, dataset);
  std::array<hsize_t, H5S_MAX_RANK> extent{};
  H5Sget_simple_extent_dims(space, extent.data(), nullptr);
  double count = 1.0;
  for (int i = 0; i < chunks.rank; ++i)
    count *= static_cast<double>(extent[i] / chunks.sides[i] + (extent[i] % chunks.sides[i] != 0));
  return count;
}

}  // namespace sandstroke
