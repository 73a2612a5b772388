#include "hdf5/hdf5_grid_writer.h"

#include <gtest/gtest.h>
#include <hdf5_hl.h>
#include <spdlog/fmt/fmt.h>

#include <cmath>

#include "dataset_shape.h"
#include "hdf5/hdf5_reader.h"
#include "test_folder.h"

namespace sandstroke {
namespace {

using Shape = Hdf5GridWriter::Shape;

class AGrid : public testing::Test {
 protected:
  /// Reads a whole dataset as doubles.
  static std::vector<double> read(const std::filesystem::path& path, const std::string& dataset,
                                  std::size_t count) {
    const Hdf5Handle file(H5Fopen(path.c_str(), H5F_ACC_RDONLY, without_locks()), H5Fclose);
    const Hdf5Handle opened(H5Dopen2(file, dataset.c_str(), H5P_DEFAULT), H5Dclose);
    std::vector<double> values(count);
    EXPECT_GE(H5Dread(opened, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()), 0);
    return values;
  }

  const TestFolder folder;
  const std::filesystem::path path = folder / "grid.h5";
};

TEST_F(AGrid, HasArraysOfAnyRankOverNamedAxes) {
  const std::vector<double> values = {0.1, 0.2, 0.3, 0.4, 0.5, 0.6};
  {
    Hdf5GridWriter file(path);
    file.write("length", {2}, std::vector<double>{1.0, 2.0});
    file.write("name", {3}, std::vector<std::string>{"sand", "", "größer"});
    file.write("force", {2, 3, 1}, values);
    file.write("group/count", {2}, std::vector<std::uint32_t>{7, 8});
    file.make_scale("length");
    file.make_scale("name");
    file.attach_scales("force", {"length", "name"});
    file.attach_scales("group/count", {"length"});
    file.attribute("force", "flag_values", std::vector<std::uint8_t>{3, 4});
    file.finish();
  }
  EXPECT_EQ(Hdf5Reader(path).shape("force"), (std::vector<hsize_t>{2, 3, 1}));
  EXPECT_EQ(read(path, "force", 6), values);
  const Hdf5Handle file(H5Fopen(path.c_str(), H5F_ACC_RDONLY, without_locks()), H5Fclose);
  const auto open = [&](const char* name) { return Hdf5Handle(H5Dopen2(file, name, H5P_DEFAULT), H5Dclose); };
  const Hdf5Handle force = open("force"), name = open("name"), length = open("length"),
                   count = open("group/count");
  EXPECT_GT(H5DSis_scale(name), 0);
  EXPECT_EQ(H5DSis_scale(force), 0);
  EXPECT_GT(H5DSis_attached(force, length, 0), 0);
  EXPECT_GT(H5DSis_attached(force, name, 1), 0);
  EXPECT_GT(H5DSis_attached(count, length, 0), 0);
  EXPECT_EQ(H5DSget_num_scales(force, 2), 0);
  const Hdf5Handle type(H5Dget_type(name), H5Tclose);
  EXPECT_GT(H5Tis_variable_str(type), 0);
  char* texts[3];
  ASSERT_GE(H5Dread(name, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, texts), 0);
  EXPECT_STREQ(texts[0], "sand");
  EXPECT_STREQ(texts[1], "");
  EXPECT_STREQ(texts[2], "größer");
  for (char* text : texts) H5free_memory(text);
}

TEST_F(AGrid, ReadsTheNumbersOfOtherFilesAndNothingWhereThereAreNone) {
  for (const double part : {0.0, 1.0, 2.0}) {
    Hdf5Writer file(folder / fmt::format("part{}.h5", part));
    HeightGrid heights(2, 3);
    heights << 0, 1, 2, 3, 4, 5;
    file.write("/deep/h", HeightGrid(heights + 10.0 * part));
    file.finish();
  }
  {
    Hdf5GridWriter file(path);
    file.write_virtual("all", {2, 2}, 2, 3,
                       {{3, "part1.h5", "/deep/h"}, {0, "part2.h5", "/deep/h"}, {2, "lost.h5", "/deep/h"}});
    file.finish();
  }
  EXPECT_EQ(dataset_shape(path, "all"), (std::vector<hsize_t>{2, 2, 2, 3}));
  const std::vector<double> all = read(path, "all", 24);
  for (std::size_t i = 0; i < 6; ++i) {
    EXPECT_EQ(all[i], 20.0 + static_cast<double>(i));       // (0, 0)
    EXPECT_TRUE(std::isnan(all[6 + i]));                    // (0, 1)
    EXPECT_TRUE(std::isnan(all[12 + i]));                   // (1, 0)
    EXPECT_EQ(all[18 + i], 10.0 + static_cast<double>(i));  // (1, 1)
  }
}

}  // namespace
}  // namespace sandstroke
