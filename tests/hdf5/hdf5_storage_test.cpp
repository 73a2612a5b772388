#include "hdf5/hdf5_storage.h"

#include <gtest/gtest.h>
#include <zlib.h>

#include <fstream>
#include <iterator>
#include <numeric>

#include "core/error.h"
#include "hdf5/hdf5_file.h"
#include "test_folder.h"

namespace sandstroke {
namespace {

namespace fs = std::filesystem;

using Extent = std::vector<hsize_t>;
using Filters = std::vector<H5Z_filter_t>;

/// Files as other programs, and enemies, write them: "/x" is a dataset of doubles.
class Hdf5Storage : public testing::Test {
 protected:
  /// Makes a dataset that is not written yet.
  void make(const Extent& shape, const Extent& chunk = {}, const Filters& filters = {}) {
    const Hdf5Handle properties(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
    if (!chunk.empty()) H5Pset_chunk(properties, static_cast<int>(chunk.size()), chunk.data());
    for (const H5Z_filter_t filter : filters) {
      if (filter == H5Z_FILTER_SHUFFLE) H5Pset_shuffle(properties);
      if (filter == H5Z_FILTER_DEFLATE) H5Pset_deflate(properties, 1);
      if (filter == H5Z_FILTER_FLETCHER32) H5Pset_fletcher32(properties);
      if (filter == H5Z_FILTER_SCALEOFFSET) H5Pset_scaleoffset(properties, H5Z_SO_FLOAT_DSCALE, 3);
    }
    make(shape, properties);
  }
  void make(const Extent& shape, const Hdf5Handle& properties, hid_t type = H5T_NATIVE_DOUBLE) {
    dataset_.close();
    file_.close();
    prepare_hdf5();
    file_ = Hdf5Handle(H5Fcreate(path_.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT), H5Fclose);
    const Hdf5Handle space(shape.empty()
                               ? H5Screate(H5S_SCALAR)
                               : H5Screate_simple(static_cast<int>(shape.size()), shape.data(), nullptr),
                           H5Sclose);
    dataset_ =
        Hdf5Handle(H5Dcreate2(file_, "x", type, space, H5P_DEFAULT, properties, H5P_DEFAULT), H5Dclose);
    ASSERT_TRUE(dataset_.valid());
  }
  void write(const std::vector<double>& values) {
    ASSERT_GE(H5Dwrite(dataset_, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()), 0);
  }
  /// The first chunk, as it is to be in the file; skipped: bit i, that filter i has not packed it.
  void write_chunk(const std::string& bytes, std::uint32_t skipped = 0) {
    const hsize_t start[2] = {0, 0};
    ASSERT_GE(H5Dwrite_chunk(dataset_, H5P_DEFAULT, skipped, start, bytes.size(), bytes.data()), 0);
  }
  template <class Read>
  std::string refusal(const Read& read) {
    dataset_.close();
    file_.close();
    try {
      read(Hdf5Reader(path_));
    } catch (const Error& failure) {
      EXPECT_EQ(failure.kind(), ErrorKind::input);
      return failure.what();
    }
    return {};
  }
  std::string refusal() {
    return refusal([](const Hdf5Reader& file) { file.doubles("/x"); });
  }
  std::vector<double> read() {
    dataset_.close();
    file_.close();
    return Hdf5Reader(path_).doubles("/x");
  }

  TestFolder folder_;
  const fs::path path_ = folder_ / "file.h5";
  Hdf5Handle file_, dataset_;
};

#define EXPECT_SAYS(said, part) EXPECT_NE((said).find(part), std::string::npos) << (said)

std::string deflated(const std::string& bytes) {
  std::string packed(compressBound(bytes.size()), '\0');
  uLongf size = packed.size();
  compress(reinterpret_cast<Bytef*>(packed.data()), &size, reinterpret_cast<const Bytef*>(bytes.data()),
           bytes.size());
  return packed.substr(0, size);
}

TEST_F(Hdf5Storage, ReadsWhatIsPackedByTheFiltersThatAreKnown) {
  std::vector<double> values(1000);
  std::iota(values.begin(), values.end(), 0.5);
  const H5Z_filter_t shuffle = H5Z_FILTER_SHUFFLE, deflate = H5Z_FILTER_DEFLATE, sum = H5Z_FILTER_FLETCHER32;
  for (const Filters& filters : {Filters{}, Filters{deflate}, Filters{shuffle, deflate}, Filters{sum},
                                 Filters{shuffle, deflate, sum}}) {
    make({1000}, {300}, filters);
    write(values);
    EXPECT_EQ(read(), values);
  }
  // A chunk that a filter could not make smaller is stored without it.
  make({4}, {4}, {deflate});
  write_chunk(std::string(32, '\0'), 1);
  EXPECT_EQ(read(), std::vector<double>(4, 0.0));
}

TEST_F(Hdf5Storage, RefusesChunksThatHoldLessOrMoreThanTheyShould) {
  const Filters plain, packed = {H5Z_FILTER_DEFLATE};
  for (const std::size_t bytes : {80u, 7992u, 8008u, 100'000u}) {
    const std::string zeros(bytes, '\0');
    make({1000}, {1000}, plain);
    write_chunk(zeros);
    EXPECT_SAYS(refusal(), "/x cannot be read; the file is damaged");
    make({1000}, {1000}, packed);
    write_chunk(deflated(zeros));
    EXPECT_SAYS(refusal(), "damaged");
    make({1000}, {1000}, packed);
    write_chunk(zeros, 1);
    EXPECT_SAYS(refusal(), "damaged");
    make({100, 10}, {100, 10}, packed);
    write_chunk(deflated(zeros));
    EXPECT_SAYS(refusal([](const Hdf5Reader& file) { file.bed("/x", 0.01); }), "damaged");
    EXPECT_SAYS(refusal([](const Hdf5Reader& file) { file.grid("/x"); }), "damaged");
  }
  make({1000}, {1000}, packed);
  write_chunk("this is not packed");
  EXPECT_SAYS(refusal(), "damaged");
}

TEST_F(Hdf5Storage, RefusesOtherFiltersAndSaysHowToPackAnew) {
  make({1000}, {1000}, {H5Z_FILTER_SCALEOFFSET});
  EXPECT_SAYS(refusal(), "h5repack -f GZIP=1");
}

TEST_F(Hdf5Storage, TakesNoMoreMemoryThanItsFileCanFill) {
  make({hsize_t{1} << 31}, {4096});
  EXPECT_SAYS(refusal(), "claims 2147483648 rows");
  make({hsize_t{1} << 31});
  EXPECT_SAYS(refusal(), "claims 2147483648 rows");
  make({hsize_t{1} << 28, 3});
  EXPECT_SAYS(refusal([](const Hdf5Reader& file) { file.vectors("/x"); }), "claims 268435456 rows");
  make({hsize_t{1} << 28}, {hsize_t{1} << 28}, {H5Z_FILTER_DEFLATE});
  EXPECT_SAYS(refusal(), "has chunks of 2147483648 bytes");
  make({60000, 60000}, {16384, 16384}, {H5Z_FILTER_DEFLATE});
  EXPECT_SAYS(refusal([](const Hdf5Reader& file) { file.bed("/x", 0.01); }),
              "has chunks of 2147483648 bytes");
  make({1000, 1000}, {1, 1});
  EXPECT_SAYS(refusal([](const Hdf5Reader& file) { file.grid("/x"); }), "has 1000000 chunks");

  const Hdf5Handle text(H5Tcopy(H5T_C_S1), H5Tclose), none(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
  H5Tset_size(text, 3'000'000'000);
  make({}, none, text);
  EXPECT_SAYS(refusal([](const Hdf5Reader& file) { file.text("/x"); }), "claims 3000000000 letters");
}

/// Some of them never answer: a pipe, a terminal.
TEST_F(Hdf5Storage, OpensNoOtherFile) {
  {
    Hdf5Writer other(folder_ / "other.h5");
    other.write("/x", std::vector<double>{1.0, 2.0});
    other.finish();
  }
  const Extent shape = {2};
  const Hdf5Handle outside(H5Pcreate(H5P_DATASET_CREATE), H5Pclose),
      virtually(H5Pcreate(H5P_DATASET_CREATE), H5Pclose),
      whole(H5Screate_simple(1, shape.data(), nullptr), H5Sclose);
  H5Pset_external(outside, "/dev/zero", 0, H5F_UNLIMITED);
  make(shape, outside);
  EXPECT_SAYS(refusal(), "other files");
  H5Pset_virtual(virtually, whole, "other.h5", "/x", whole);
  make(shape, virtually);
  EXPECT_SAYS(refusal(), "other files");
  EXPECT_SAYS(refusal([](const Hdf5Reader& file) { file.shape("/x"); }), "other files");
  // Its own numbers by way of themselves: HDF5 looks for them until its stack is full.
  const Hdf5Handle itself(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
  H5Pset_virtual(itself, whole, ".", "/x", whole);
  make(shape, itself);
  EXPECT_SAYS(refusal(), "other files");

  make(shape);
  H5Lcreate_external("other.h5", "/x", file_, "y", H5P_DEFAULT, H5P_DEFAULT);
  EXPECT_SAYS(refusal([](const Hdf5Reader& file) { file.doubles("/y"); }), "/y is missing");
  EXPECT_FALSE(Hdf5Reader(path_).has("/y"));
  EXPECT_FALSE(Hdf5Reader(path_).has_attribute("/y", "unit"));
}

/// HDF5 1.10 itself would read what lies behind such a dataset.
TEST(Hdf5StorageOfStrangers, ADatasetWithoutRoomForItsNumbersIsRefused) {
  const TestFolder folder;
  for (const H5D_layout_t layout : {H5D_CONTIGUOUS, H5D_COMPACT}) {
    constexpr hsize_t count = 0x11E1;  // found nowhere else in the file
    {
      prepare_hdf5();
      const Hdf5Handle file(H5Fcreate((folder / "a.h5").c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT),
                            H5Fclose);
      const Hdf5Handle properties(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
      H5Pset_layout(properties, layout);
      const Hdf5Handle space(H5Screate_simple(1, &count, nullptr), H5Sclose);
      const Hdf5Handle dataset(
          H5Dcreate2(file, "x", H5T_STD_I8LE, space, H5P_DEFAULT, properties, H5P_DEFAULT), H5Dclose);
      const std::vector<double> numbers(count, 1.0);
      H5Dwrite(dataset, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, numbers.data());
    }
    EXPECT_EQ(Hdf5Reader(folder / "a.h5").doubles("/x").size(), count);
    std::ifstream whole(folder / "a.h5", std::ios::binary);
    std::string bytes{std::istreambuf_iterator<char>(whole), {}};
    const std::size_t shape = bytes.find(std::string("\xE1\x11\0\0\0\0\0\0", 8));
    ASSERT_NE(shape, std::string::npos);
    for (const std::size_t at : {shape, shape + 8}) bytes[at + 2] = 1;  // 65,536 more, also at most
    put_text(folder / "b.h5", bytes);
    EXPECT_THROW(Hdf5Reader(folder / "b.h5").doubles("/x"), Error) << layout;
  }
}

}  // namespace
}  // namespace sandstroke
