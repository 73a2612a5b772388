#include "hdf5/hdf5_file.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <spdlog/fmt/fmt.h>
#include <sys/file.h>
#include <unistd.h>

#include <cmath>
#include <fstream>
#include <limits>

#include "any_hdf5.h"
#include "core/error.h"
#include "core/file_lock.h"
#include "core/output_file.h"
#include "core/version.h"
#include "test_folder.h"

namespace sandstroke {
namespace {

namespace fs = std::filesystem;

class Hdf5File : public testing::Test {
 protected:
  std::string error_of_reading(const std::function<void(const Hdf5Reader&)>& read) {
    try {
      read(Hdf5Reader(path_));
    } catch (const Error& failure) {
      return failure.what();
    }
    ADD_FAILURE() << "no error";
    return {};
  }
  TestFolder folder_;
  const fs::path path_ = folder_ / "file.h5";
};

TEST_F(Hdf5File, GivesBackWhatWasWritten) {
  HeightGrid grid(300, 200);
  for (int i = 0; i < grid.size(); ++i) grid.data()[i] = 0.1 * i;
  Hdf5Writer writer(path_, any_hdf5);
  writer.write("/a/b/doubles", std::vector<double>{1.0, 0.1, -1e300});
  writer.write("/a/vectors", std::vector<Eigen::Vector3d>{{1, 2, 3}, {4, 5, 6}});
  writer.write("/flags", std::vector<std::uint8_t>{0, 1, 255});
  for (const Compression compression : {Compression::none, Compression::fast, Compression::small})
    writer.write("/grid" + std::to_string(static_cast<int>(compression)), grid, compression);
  writer.write("/text", std::string("zwei Wörter"));
  writer.write("/empty", std::vector<double>{});
  writer.attribute("/a", "number", 2.5);
  writer.attribute("/a", "number", 3.5);
  writer.attribute("/", "word", "yes");
  writer.finish();

  EXPECT_FALSE(fs::exists(part_path(path_)));
  const Hdf5Reader reader(path_);
  EXPECT_EQ(reader.doubles("/a/b/doubles"), (std::vector<double>{1.0, 0.1, -1e300}));
  EXPECT_EQ(reader.vectors("/a/vectors")[1], Eigen::Vector3d(4, 5, 6));
  EXPECT_EQ(reader.integers("/flags"), (std::vector<std::uint32_t>{0, 1, 255}));
  for (const char* name : {"/grid0", "/grid1", "/grid2"}) EXPECT_TRUE((reader.grid(name) == grid).all());
  EXPECT_EQ(reader.text("/text"), "zwei Wörter");
  EXPECT_TRUE(reader.doubles("/empty").empty());
  EXPECT_EQ(reader.number_attribute("/a", "number"), 3.5);
  EXPECT_EQ(reader.text_attribute("/", "word"), "yes");
  EXPECT_EQ(reader.text_attribute("/", "written_by"), build);
  EXPECT_EQ(reader.members("/a"), (std::vector<std::string>{"b", "vectors"}));
  EXPECT_FALSE(reader.has("/a/none/deeper"));
}

TEST_F(Hdf5File, ACellSizeIsFiniteAndAboveZero) {
  const auto write = [&](double cell_size) {
    Hdf5Writer writer(path_, any_hdf5);
    writer.make_group("/surface");
    writer.attribute("/surface", "cell_size", cell_size);
    writer.finish();
  };
  write(0.25);
  EXPECT_EQ(Hdf5Reader(path_).cell_size("/surface"), 0.25);
  for (const double wrong : {0.0, -0.25, std::nan(""), HUGE_VAL}) {
    write(wrong);
    EXPECT_NE(error_of_reading([](const Hdf5Reader& file) { file.cell_size("/surface"); }).find("cell_size"),
              std::string::npos)
        << wrong;
  }
}

TEST_F(Hdf5File, ColumnsGrowAndCanBeReadAfterAFlushWithoutFinish) {
  {
    Hdf5Writer writer(path_, any_hdf5);
    Hdf5Column times = writer.column("/trace/time"), forces = writer.column("/trace/force", 3);
    Hdf5Column flags = writer.column<std::uint8_t>("/trace/contact");
    for (int i = 0; i < 10'000; i += 2) {
      const double time[2] = {0.5 * i, 0.5 * (i + 1)}, force[6] = {1.0 * i, 2, 3, 4, 5, 6.0 * i};
      const std::uint8_t flag[2] = {0, 1};
      times.append(time, 2);
      forces.append(force, 2);
      flags.append(flag, 2);
    }
    writer.flush();
  }
  EXPECT_FALSE(fs::exists(path_));  // never finished
  {
    const auto writing = FileLock::try_take(part_path(path_));
    EXPECT_THROW(Hdf5Reader(part_path(path_)), Error) << "somebody writes it";
  }
  const Hdf5Reader reader(part_path(path_));
  EXPECT_EQ(reader.doubles("/trace/time").size(), 10'000u);
  EXPECT_EQ(reader.doubles("/trace/time")[9'999], 4999.5);
  EXPECT_EQ(reader.vectors("/trace/force")[9'999], Eigen::Vector3d(4, 5, 6.0 * 9'998));
  EXPECT_EQ(reader.integers("/trace/contact")[3], 1u);
}

TEST_F(Hdf5File, IntegersThatDoNotFitAreRefused) {
  for (const auto& [value, fits] : {std::pair<std::int64_t, bool>{-1, false},
                                    {0, true},
                                    {0xffffffff, true},
                                    {0x100000000, false},
                                    {std::numeric_limits<std::int64_t>::min(), false}}) {
    {
      Hdf5Writer writer(path_, any_hdf5);
      writer.column<std::int64_t>("/tiles").append(&value, 1);
      writer.finish();
    }
    if (fits)
      EXPECT_EQ(Hdf5Reader(path_).integers("/tiles").front(), value);
    else
      EXPECT_NE(error_of_reading([](const Hdf5Reader& file) {
                  file.integers("/tiles");
                }).find(fmt::format("/tiles holds {}", value)),
                std::string::npos)
          << value;
  }
}

TEST_F(Hdf5File, AFileThatHdf5LocksForWritingIsRefused) {
  Hdf5Writer(path_).finish();
  const int other = open(path_.c_str(), O_RDONLY | O_CLOEXEC);
  ASSERT_EQ(flock(other, LOCK_EX), 0);
  EXPECT_THROW(Hdf5Reader{path_}, Error);
  close(other);
  EXPECT_NO_THROW(Hdf5Reader{path_});
}

TEST_F(Hdf5File, ErrorsNameFileAndDataset) {
  Hdf5Writer writer(path_, any_hdf5);
  writer.write("/line", std::vector<double>{1.0, 2.0});
  writer.write("/text", std::string("word"));
  writer.make_group("/group");
  writer.finish();
  const auto says = [&](const std::function<void(const Hdf5Reader&)>& read, const std::string& dataset,
                        const std::string& part) {
    const std::string said = error_of_reading(read);
    EXPECT_NE(said.find(path_.string()), std::string::npos) << said;
    EXPECT_NE(said.find(dataset), std::string::npos) << said;
    EXPECT_NE(said.find(part), std::string::npos) << said;
  };
  says([](const Hdf5Reader& r) { r.doubles("/none"); }, "/none", "missing");
  says([](const Hdf5Reader& r) { r.grid("/line"); }, "/line", "1 dimensions");
  says([](const Hdf5Reader& r) { r.doubles("/text"); }, "/text", "numbers");
  says([](const Hdf5Reader& r) { r.text("/line"); }, "/line", "string");
  says([](const Hdf5Reader& r) { r.doubles("/group"); }, "/group", "not a dataset");
  says([](const Hdf5Reader& r) { r.number_attribute("/line", "unit"); }, "/line", "unit");
  says([](const Hdf5Reader& r) { r.members("/line"); }, "/line", "not a group");
}

TEST_F(Hdf5File, RefusesWhatIsNoWholeHdf5File) {
  EXPECT_NE(error_of_reading([](const Hdf5Reader&) {}).find("cannot be opened"), std::string::npos);
  std::ofstream(path_) << "just text";
  EXPECT_NE(error_of_reading([](const Hdf5Reader&) {}).find("not an HDF5 file"), std::string::npos);
  fs::remove(path_);
  {
    Hdf5Writer writer(path_, any_hdf5);
    writer.write("/grid", HeightGrid(HeightGrid::Ones(200, 200)));
    writer.finish();
  }
  fs::resize_file(path_, fs::file_size(path_) / 2);
  EXPECT_NE(error_of_reading([](const Hdf5Reader& r) { r.grid("/grid"); }).find("truncated"),
            std::string::npos);
}

TEST_F(Hdf5File, ADiskThatTakesNothingIsAnError) {
  EXPECT_THROW(Hdf5Writer("/proc/nowhere/file.h5"), Error);
  EXPECT_THROW(Hdf5Writer(folder_ / "no-such-folder/file.h5"), Error);
}

/// A file whose datasets lie in others, each in another way.
class Hdf5OfOthers : public Hdf5File {
 protected:
  void SetUp() override {
    const fs::path secret = folder_ / "secret.h5";
    {
      Hdf5Writer writer(secret, any_hdf5);
      writer.write("/group/numbers", std::vector<double>(4, 42.0));
      writer.attribute("/group", "word", "secret");
      writer.finish();
    }
    std::ofstream(folder_ / "secret.bin") << std::string(32, 'x');
    {
      Hdf5Writer writer(path_, any_hdf5);
      writer.write("/own", std::vector<double>(4, 1.0));
      writer.finish();
    }
    file_ = Hdf5Handle(H5Fopen(path_.c_str(), H5F_ACC_RDWR, without_locks()), H5Fclose);
    space_ = Hdf5Handle(H5Screate_simple(1, &count_, nullptr), H5Sclose);
    properties_ = Hdf5Handle(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
  }
  void make(const char* dataset) {
    const Hdf5Handle made(
        H5Dcreate2(file_, dataset, H5T_NATIVE_DOUBLE, space_, H5P_DEFAULT, properties_, H5P_DEFAULT),
        H5Dclose);
    ASSERT_TRUE(made.valid());
  }
  void expect_refusal(const std::string& dataset, const std::string& reason) {
    ASSERT_TRUE(file_.close());
    const std::string sentence = error_of_reading([&](const Hdf5Reader& reader) { reader.doubles(dataset); });
    EXPECT_NE(sentence.find(dataset + " " + reason), std::string::npos) << sentence;
  }
  Hdf5Handle file_, space_, properties_;
  const hsize_t count_ = 4;
};

TEST_F(Hdf5OfOthers, LinksIntoAnotherFileAreNotFollowed) {
  H5Lcreate_external("secret.h5", "/group", file_, "/linked", H5P_DEFAULT, H5P_DEFAULT);
  H5Lcreate_soft("/linked/numbers", file_, "/detour", H5P_DEFAULT, H5P_DEFAULT);
  H5Lcreate_soft("/linked", file_, "/round", H5P_DEFAULT, H5P_DEFAULT);
  expect_refusal("/linked", "is missing");
  expect_refusal("/detour", "is missing");
  const Hdf5Reader reader(path_);
  EXPECT_EQ(reader.doubles("/own").size(), 4u);
  EXPECT_FALSE(reader.has("/round"));
  EXPECT_FALSE(reader.has("/round/numbers"));
  EXPECT_FALSE(reader.has("/linked/numbers"));
  EXPECT_THROW(reader.text_attribute("/linked", "word"), Error);
  EXPECT_THROW(reader.text_attribute("/round", "word"), Error);
  EXPECT_THROW(reader.members("/linked"), Error);
  EXPECT_THROW(reader.members("/round"), Error);
}

TEST_F(Hdf5OfOthers, NoCodeIsLoadedForAFilter) {
  const H5Z_class2_t filter = {
      H5Z_CLASS_T_VERS,
      300,
      1,
      1,
      "own",
      nullptr,
      nullptr,
      [](unsigned, std::size_t, const unsigned*, std::size_t bytes, std::size_t*, void**) { return bytes; }};
  H5Zregister(&filter);
  H5Pset_chunk(properties_, 1, &count_);
  H5Pset_filter(properties_, filter.id, 0, 0, nullptr);
  make("/packed");
  ASSERT_TRUE(file_.close());
  H5Zunregister(filter.id);
  expect_refusal("/packed", "has an unknown compression");
  unsigned loading = 1;
  H5PLget_loading_state(&loading);
  EXPECT_EQ(loading, 0u);
}

}  // namespace
}  // namespace sandstroke
