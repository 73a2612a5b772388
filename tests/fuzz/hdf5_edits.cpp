#include "hdf5_edits.h"

#include <algorithm>
#include <array>
#include <fstream>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include "hdf5/hdf5_handle.h"

namespace sandstroke {
namespace {

namespace fs = std::filesystem;

/// The input, taken from its beginning; zeros after its end.
class Bytes {
 public:
  Bytes(const std::uint8_t* data, std::size_t size) : data_(data), left_(size) {}

  bool empty() const { return left_ == 0; }
  std::uint8_t next() {
    if (left_ == 0) return 0;
    --left_;
    return *data_++;
  }
  template <class List>
  auto one_of(const List& list) {
    return list[next() % std::size(list)];
  }
  std::string text() {
    std::string text(next() % 16, '\0');
    for (char& c : text) c = static_cast<char>(next());
    return text;
  }

 private:
  const std::uint8_t* data_;
  std::size_t left_;
};

using Dimensions = std::vector<hsize_t>;

constexpr hsize_t sides[] = {1,
                             0,
                             2,
                             3,
                             4,
                             7,
                             16,
                             4096,
                             65535,
                             65536,
                             65537,
                             hsize_t{1} << 31,
                             hsize_t{1} << 32,
                             hsize_t{1} << 33,
                             hsize_t{1} << 61,
                             hsize_t{1} << 62};
constexpr double numbers[] = {0.0,
                              1.0,
                              -1.0,
                              0.5,
                              2.0,
                              1e300,
                              -1e300,
                              5e-324,
                              4294967296.0,
                              std::numeric_limits<double>::quiet_NaN(),
                              std::numeric_limits<double>::infinity(),
                              -std::numeric_limits<double>::infinity()};

Dimensions shape(Bytes& bytes) {
  Dimensions shape(bytes.next() % 5);
  for (hsize_t& side : shape) side = bytes.one_of(sides);
  return shape;
}

/// A datatype of any class, sometimes of large elements.
Hdf5Handle type(Bytes& bytes) {
  const auto own = [](hid_t id) { return Hdf5Handle(id, H5Tclose); };
  const std::size_t size = std::array<std::size_t, 6>{1, 2, 8, 100, 60000, 3000000000}[bytes.next() % 6];
  switch (bytes.next() % 16) {
    case 0:
      return own(H5Tcopy(H5T_IEEE_F32BE));
    case 1:
      return own(H5Tcopy(H5T_STD_I8LE));
    case 2:
      return own(H5Tcopy(H5T_STD_U64BE));
    case 3:
      return own(H5Tcopy(H5T_STD_U32LE));
    case 4: {  // text, of fixed length
      const hid_t text = H5Tcopy(H5T_C_S1);
      H5Tset_size(text, size);
      H5Tset_strpad(text, bytes.one_of(std::array{H5T_STR_NULLTERM, H5T_STR_NULLPAD, H5T_STR_SPACEPAD}));
      H5Tset_cset(text, bytes.one_of(std::array{H5T_CSET_ASCII, H5T_CSET_UTF8}));
      return own(text);
    }
    case 5: {  // ... and of any
      const hid_t text = H5Tcopy(H5T_C_S1);
      H5Tset_size(text, H5T_VARIABLE);
      return own(text);
    }
    case 6: {
      const hid_t pair = H5Tcreate(H5T_COMPOUND, 16);
      H5Tinsert(pair, "x", 0, H5T_NATIVE_DOUBLE);
      H5Tinsert(pair, "y", 8, H5T_NATIVE_DOUBLE);
      return own(pair);
    }
    case 7:
      return own(H5Tcreate(H5T_OPAQUE, size));
    case 8:
      return own(H5Tvlen_create(H5T_NATIVE_DOUBLE));
    case 9: {
      const hsize_t three = 3;
      return own(H5Tarray_create2(H5T_NATIVE_DOUBLE, 1, &three));
    }
    case 10: {
      const hid_t yes_or_no = H5Tenum_create(H5T_NATIVE_INT8);
      const std::int8_t values[] = {0, 1};
      H5Tenum_insert(yes_or_no, "FALSE", &values[0]);
      H5Tenum_insert(yes_or_no, "TRUE", &values[1]);
      return own(yes_or_no);
    }
    case 11:
      return own(H5Tcopy(H5T_STD_REF_OBJ));
    case 12: {  // a number of few bits
      const hid_t bits = H5Tcopy(H5T_STD_U32LE);
      H5Tset_precision(bits, 1 + bytes.next() % 32);
      return own(bits);
    }
    default:
      return own(H5Tcopy(H5T_IEEE_F64LE));
  }
}

Hdf5Handle space(const Dimensions& shape) {
  return {shape.empty() ? H5Screate(H5S_SCALAR)
                        : H5Screate_simple(static_cast<int>(shape.size()), shape.data(), nullptr),
          H5Sclose};
}

/// Layout, filters and fill value.
Hdf5Handle properties(Bytes& bytes, const Dimensions& shape) {
  Hdf5Handle made(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
  const int rank = static_cast<int>(shape.size());
  Dimensions chunk = shape;
  switch (bytes.next() % 8) {
    case 0:
      H5Pset_layout(made, H5D_COMPACT);
      break;
    case 1:
      H5Pset_external(made, bytes.one_of(std::array{"/dev/zero", "/dev/tty", "edited.h5", "none"}), 0,
                      H5F_UNLIMITED);
      break;
    case 2: {
      const Hdf5Handle whole = space(shape);
      H5Pset_virtual(made, whole, bytes.one_of(std::array{".", "edited.h5", "none.h5", "/dev/zero"}),
                     bytes.one_of(std::array{"/stroke/time", "/surface/final", "/none"}), whole);
      break;
    }
    case 3:
    case 4:
    case 5:
      for (hsize_t& side : chunk) side = bytes.one_of(sides);
      H5Pset_chunk(made, rank, chunk.data());
      if (bytes.next() % 2) H5Pset_shuffle(made);
      if (bytes.next() % 2) H5Pset_deflate(made, 1);
      if (bytes.next() % 4 == 1) H5Pset_fletcher32(made);
      if (bytes.next() % 8 == 1) H5Pset_scaleoffset(made, H5Z_SO_FLOAT_DSCALE, 3);
      if (bytes.next() % 8 == 1) H5Pset_nbit(made);
      break;
    default:
      break;
  }
  if (bytes.next() % 2) {
    const double fill = bytes.one_of(numbers);
    H5Pset_fill_value(made, H5T_NATIVE_DOUBLE, &fill);
  }
  if (bytes.next() % 8 == 1) H5Pset_fill_time(made, H5D_FILL_TIME_NEVER);
  return made;
}

/// Puts something in, where that is not much. write: gets the type in memory, and the elements.
template <class Write>
void write_values(const Hdf5Handle& type, const Hdf5Handle& space, Bytes& bytes, const Write& write) {
  const hssize_t count = H5Sget_simple_extent_npoints(space);
  constexpr hssize_t most = 1 << 16;
  if (count <= 0 || count > most) return;
  const auto elements = static_cast<std::size_t>(count);
  if (H5Tis_variable_str(type) > 0) {
    const std::string text = bytes.text();
    write(type, std::vector<const char*>(elements, text.c_str()).data());
  } else if (H5Tget_class(type) == H5T_STRING) {
    if (H5Tget_size(type) * elements > most) return;
    write(type, std::vector<char>(elements * H5Tget_size(type), static_cast<char>(bytes.next())).data());
  } else {
    // A few numbers, over and over, on the rise or not.
    std::vector<double> few(1 + bytes.next() % 4), all(elements);
    for (double& value : few) value = bytes.one_of(numbers) + (bytes.next() % 4) * 0.125;
    const double rise = bytes.one_of(numbers);
    for (std::size_t i = 0; i < elements; ++i)
      all[i] = few[i % few.size()] + rise * static_cast<double>(i / few.size());
    write(H5T_NATIVE_DOUBLE, all.data());
  }
}

bool has_filter(const Hdf5Handle& properties, H5Z_filter_t filter) {
  unsigned flags, config;
  std::size_t parameters = 0;
  return H5Pget_filter_by_id2(properties, filter, &flags, &parameters, nullptr, 0, nullptr, &config) >= 0;
}

/// Writes neither into other files, nor, through them, into itself; nor through filters that HDF5 1.10.8
/// itself falls over when they pack (which only writing does, and what is fuzzed is reading).
void write_dataset(const Hdf5Handle& dataset, Bytes& bytes) {
  const Hdf5Handle properties(H5Dget_create_plist(dataset), H5Pclose);
  if (H5Pget_layout(properties) == H5D_VIRTUAL || H5Pget_external_count(properties) > 0 ||
      has_filter(properties, H5Z_FILTER_SCALEOFFSET) || has_filter(properties, H5Z_FILTER_NBIT))
    return;
  const Hdf5Handle type(H5Dget_type(dataset), H5Tclose), space(H5Dget_space(dataset), H5Sclose);
  write_values(type, space, bytes, [&](hid_t memory_type, const auto* values) {
    H5Dwrite(dataset, memory_type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values);
  });
}

/// Groups and datasets of the file, and what is not there.
std::vector<std::string> objects(hid_t file) {
  std::vector<std::string> names = {"/", "/none"};
  const auto add = [](hid_t, const char* name, const auto*, void* list) -> herr_t {
    if (*name != '.') static_cast<std::vector<std::string>*>(list)->push_back(std::string("/") + name);
    return 0;
  };
  H5Ovisit2(file, H5_INDEX_NAME, H5_ITER_INC, add, &names, H5O_INFO_BASIC);
  return names;
}

double chunk_bytes(const Hdf5Handle& properties, const Hdf5Handle& type) {
  if (H5Pget_layout(properties) != H5D_CHUNKED) return 0.0;
  Dimensions chunk(H5S_MAX_RANK);
  chunk.resize(static_cast<std::size_t>(std::max(0, H5Pget_chunk(properties, H5S_MAX_RANK, chunk.data()))));
  double bytes = static_cast<double>(H5Tget_size(type));
  for (const hsize_t side : chunk) bytes *= static_cast<double>(side);
  return bytes;
}

void make_dataset(hid_t file, const std::string& name, Bytes& bytes) {
  const Dimensions dimensions = shape(bytes);
  const Hdf5Handle made_type = type(bytes), made_space = space(dimensions),
                   made_properties = properties(bytes, dimensions);
  H5Ldelete(file, name.c_str(), H5P_DEFAULT);
  const Hdf5Handle made(
      H5Dcreate2(file, name.c_str(), made_type, made_space, H5P_DEFAULT, made_properties, H5P_DEFAULT),
      H5Dclose);
  if (made.valid() && chunk_bytes(made_properties, made_type) < 1e6 && bytes.next() % 4)
    write_dataset(made, bytes);
}

/// One of an object's attributes anew, or a new one.
void make_attribute(hid_t file, const std::string& object, Bytes& bytes) {
  constexpr std::size_t longest = 64;
  char name[longest] = {};
  if (H5Aget_name_by_idx(file, object.c_str(), H5_INDEX_NAME, H5_ITER_INC, bytes.next() % 16, name, longest,
                         H5P_DEFAULT) < 0)
    bytes.text().copy(name, longest - 1);
  const Dimensions dimensions = bytes.next() % 2 ? shape(bytes) : Dimensions{};
  const Hdf5Handle made_type = type(bytes), made_space = space(dimensions);
  H5Adelete_by_name(file, object.c_str(), name, H5P_DEFAULT);
  const Hdf5Handle made(H5Acreate_by_name(file, object.c_str(), name, made_type, made_space, H5P_DEFAULT,
                                          H5P_DEFAULT, H5P_DEFAULT),
                        H5Aclose);
  if (made.valid())
    write_values(made_type, made_space, bytes,
                 [&](hid_t memory_type, const auto* values) { H5Awrite(made, memory_type, values); });
}

void edit(hid_t file, Bytes& bytes) {
  const std::vector<std::string> names = objects(file);
  const std::string name = names[bytes.next() % names.size()], other = names[bytes.next() % names.size()];
  switch (bytes.next() % 9) {
    case 0:
      H5Ldelete(file, name.c_str(), H5P_DEFAULT);
      break;
    case 1:
      H5Ldelete(file, name.c_str(), H5P_DEFAULT);
      H5Lcreate_hard(file, other.c_str(), file, name.c_str(), H5P_DEFAULT, H5P_DEFAULT);
      break;
    case 2:
      H5Ldelete(file, name.c_str(), H5P_DEFAULT);
      H5Lcreate_soft(other.c_str(), file, name.c_str(), H5P_DEFAULT, H5P_DEFAULT);
      break;
    case 3:
      H5Ldelete(file, name.c_str(), H5P_DEFAULT);
      H5Lcreate_external(bytes.one_of(std::array{"edited.h5", "good.h5", "/dev/zero", "none"}), other.c_str(),
                         file, name.c_str(), H5P_DEFAULT, H5P_DEFAULT);
      break;
    case 4:  // a member of a group, of any name
      H5Lcreate_hard(file, other.c_str(), file, (name + "/" + bytes.text()).c_str(), H5P_DEFAULT,
                     H5P_DEFAULT);
      break;
    case 5:
    case 6:
      make_dataset(file, name, bytes);
      break;
    case 7:
      make_attribute(file, name, bytes);
      break;
    default: {
      const Hdf5Handle dataset(H5Dopen2(file, name.c_str(), H5P_DEFAULT), H5Dclose);
      if (dataset.valid()) write_dataset(dataset, bytes);
    }
  }
}

}  // namespace

void write_edited(const fs::path& good, const fs::path& edited, const std::uint8_t* data, std::size_t size) {
  constexpr std::string_view signature = "\x89HDF";
  if (std::string_view(reinterpret_cast<const char*>(data), size).starts_with(signature)) {
    std::ofstream(edited, std::ios::binary)
        .write(reinterpret_cast<const char*>(data), static_cast<std::streamsize>(size));
    return;
  }
  prepare_hdf5();
  // copy_file would not do: libFuzzer's clock interrupts it.
  std::ofstream(edited, std::ios::binary) << std::ifstream(good, std::ios::binary).rdbuf();
  Hdf5Handle file(H5Fopen(edited.c_str(), H5F_ACC_RDWR, without_locks()), H5Fclose);
  constexpr int most_edits = 8;
  Bytes bytes(data, size);
  for (int i = 0; i < most_edits && !bytes.empty(); ++i) edit(file, bytes);
}

}  // namespace sandstroke
