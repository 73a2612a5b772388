#include "io/table.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

#include "hdf5/hdf5_reader.h"
#include "test_folder.h"

namespace sandstroke {
namespace {

const double none = std::nan("");

Table small_table() {
  return {{{"name", "Name", "", std::vector<std::string>{"a", "b, \"c\""}},
           {"time", "Time", "s", std::vector<double>{0.1, none}},
           {"count", "Count", "", std::vector<double>{512.0, 1e-7}}}};
}

std::vector<std::string> fixed_length_texts(const std::filesystem::path& path, const char* name) {
  const Hdf5Handle file(H5Fopen(path.c_str(), H5F_ACC_RDONLY, without_locks()), H5Fclose);
  const Hdf5Handle dataset(H5Dopen2(file, name, H5P_DEFAULT), H5Dclose);
  const Hdf5Handle type(H5Dget_type(dataset), H5Tclose);
  const std::size_t length = H5Tget_size(type);
  std::vector<char> block(H5Dget_storage_size(dataset));
  H5Dread(dataset, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, block.data());
  std::vector<std::string> texts;
  for (std::size_t i = 0; i < block.size(); i += length)
    texts.emplace_back(block.data() + i, strnlen(block.data() + i, length));
  return texts;
}

TEST(Table, QuotesWhatNeedsItAsCsvAndLeavesEmptyWhatIsNotThere) {
  EXPECT_EQ(csv_text(small_table()), "name,time,count\na,0.1,512\n\"b, \"\"c\"\"\",,1e-07\n");
}

TEST(Table, HasNullWhereThereIsNoNumberAsJson) {
  const nlohmann::ordered_json row = row_json(small_table(), 1), columns = columns_json(small_table());
  EXPECT_EQ(row["name"], "b, \"c\"");
  EXPECT_TRUE(row["time"].is_null());
  EXPECT_EQ(row["count"], 1e-7);
  EXPECT_EQ(columns[1].dump(), R"({"name":"time","title":"Time","unit":"s"})");
}

TEST(Table, NoughtIsANumber) {
  EXPECT_EQ(number_or_null(0.0), nlohmann::ordered_json(0.0));
  for (const double value : {none, HUGE_VAL, -HUGE_VAL}) EXPECT_TRUE(number_or_null(value).is_null());
}

TEST(Table, HasADatasetPerColumnWithItsUnitAsHdf5) {
  const TestFolder folder;
  {
    Hdf5Writer file(folder / "table.h5");
    write_table(file, "/runs", small_table());
    file.finish();
  }
  const Hdf5Reader file(folder / "table.h5");
  EXPECT_EQ(file.shape("/runs/name"), std::vector<hsize_t>{2});
  EXPECT_EQ(fixed_length_texts(folder / "table.h5", "/runs/name"),
            (std::vector<std::string>{"a", "b, \"c\""}));
  EXPECT_EQ(file.doubles("/runs/time")[0], 0.1);
  EXPECT_TRUE(std::isnan(file.doubles("/runs/time")[1]));
  EXPECT_EQ(file.text_attribute("/runs/time", "units"), "s");
  EXPECT_EQ(file.text_attribute("/runs/count", "title"), "Count");
  EXPECT_FALSE(file.has_attribute("/runs/count", "units"));
}

TEST(Table, IsAlignedAsTextNumbersToTheRight) {
  EXPECT_EQ(aligned_text(small_table(), 3),
            "Name    Time [s]  Count\n"
            "a            0.1    512\n"
            "b, \"c\"         -  1e-07\n");
}

TEST(Table, IsItsNamesWithoutRows) {
  const Table empty{{{"a", "A", "", std::vector<double>{}}, {"b", "B", "", std::vector<std::string>{}}}};
  EXPECT_EQ(csv_text(empty), "a,b\n");
  const TestFolder folder;
  Hdf5Writer file(folder / "table.h5");
  EXPECT_NO_THROW(write_table(file, "/runs", empty));
}

}  // namespace
}  // namespace sandstroke
