#include "import/mat.h"

#include <gmock/gmock-matchers.h>
#include <gtest/gtest.h>
#include <matio.h>

#include <filesystem>
#include <limits>
#include <numeric>

#include "complaint.h"
#include "flipped.h"
#include "import/import_stroke.h"
#include "test_folder.h"

namespace sandstroke {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

/// A file as MATLAB saves it.
class MatlabFile {
 public:
  explicit MatlabFile(const std::filesystem::path& path, mat_ft version = MAT_FT_MAT5)
      : file_(Mat_CreateVer(path.c_str(), nullptr, version)) {}
  ~MatlabFile() { Mat_Close(file_); }

  /// Counts from `first`, column by column.
  static matvar_t* matrix(const char* name, std::size_t rows, std::size_t columns, double first) {
    std::vector<double> values(rows * columns);
    std::iota(values.begin(), values.end(), first);
    return of(name, MAT_C_DOUBLE, MAT_T_DOUBLE, rows, columns, values.data());
  }
  static matvar_t* of(const char* name, matio_classes kind, matio_types type, std::size_t rows,
                      std::size_t columns, void* values, int options = 0) {
    std::size_t dims[] = {rows, columns};
    return Mat_VarCreate(name, kind, type, 2, dims, values, options);
  }
  void save(matvar_t* variable, matio_compression compression = MAT_COMPRESSION_NONE) {
    EXPECT_EQ(Mat_VarWrite(file_, variable, compression), 0);
    Mat_VarFree(variable);
  }

 private:
  mat_t* file_;
};

TEST(Mat, VectorsAndMatricesBecomeColumns) {
  const TestFolder folder;
  for (const mat_ft version : {MAT_FT_MAT4, MAT_FT_MAT5, MAT_FT_MAT73}) {
    const std::filesystem::path path = folder / fmt::format("{}.mat", static_cast<int>(version));
    {
      MatlabFile file(path, version);
      file.save(MatlabFile::matrix("t", 1, 4, 0));       // a row
      file.save(MatlabFile::matrix("pos", 4, 3, 10));    // samples in rows
      file.save(MatlabFile::matrix("force", 2, 4, 30));  // samples in columns
      file.save(MatlabFile::matrix("rate", 1, 1, 1000));
    }
    const SampleTable table = read_mat(path);
    ASSERT_EQ(table.columns.size(), 6u);
    EXPECT_THAT(column(table, "t").values, ElementsAre(0, 1, 2, 3));
    EXPECT_THAT(column(table, "pos.1").values, ElementsAre(10, 11, 12, 13));
    EXPECT_THAT(column(table, "pos.3").values, ElementsAre(18, 19, 20, 21));
    EXPECT_THAT(column(table, "force.1").values, ElementsAre(30, 32, 34, 36));
    EXPECT_THAT(column(table, "force.2").values, ElementsAre(31, 33, 35, 37));
    EXPECT_THAT(table.description, HasSubstr("6 columns, 4 samples"));
  }
}

TEST(Mat, NumbersOfAnyKindAreRead) {
  const TestFolder folder;
  float single[] = {0.5f, -1.5f};
  std::int16_t whole[] = {-3, 300};
  std::uint8_t byte[] = {200, 255};
  char text[] = "ab";
  {
    MatlabFile file(folder / "kinds.mat");
    file.save(MatlabFile::of("single", MAT_C_SINGLE, MAT_T_SINGLE, 2, 1, single), MAT_COMPRESSION_ZLIB);
    file.save(MatlabFile::of("whole", MAT_C_INT16, MAT_T_INT16, 2, 1, whole));
    file.save(MatlabFile::of("byte", MAT_C_UINT8, MAT_T_UINT8, 2, 1, byte));
    file.save(MatlabFile::of("text", MAT_C_CHAR, MAT_T_UINT8, 1, 2, text));
  }
  const SampleTable table = read_mat(folder / "kinds.mat");
  EXPECT_EQ(table.columns.size(), 3u);
  EXPECT_THAT(column(table, "single").values, ElementsAre(0.5, -1.5));
  EXPECT_THAT(column(table, "whole").values, ElementsAre(-3, 300));
  EXPECT_THAT(column(table, "byte").values, ElementsAre(200, 255));
}

TEST(Mat, AMatrixOfVectorsIsFoundByItsName) {
  const TestFolder folder;
  TableSettings settings;
  settings.rate = 10.0;
  settings.position_unit = "mm";
  settings.force_unit = "N";
  for (const char* name : {"pos", "position", "xyz", "p", "tip_pos"}) {
    const std::filesystem::path path = folder / fmt::format("{}.mat", name);
    {
      MatlabFile file(path);
      file.save(MatlabFile::matrix(name, 5, 3, 0));
      file.save(MatlabFile::matrix("f", 5, 3, 100));
      file.save(MatlabFile::matrix("quat", 5, 4, 0));
      file.save(MatlabFile::matrix("joints", 5, 3, 200));
    }
    const Stroke stroke = import_stroke(path, settings).stroke;
    EXPECT_LT((stroke.position[1] - Eigen::Vector3d(0.001, 0.006, 0.011)).norm(), 1e-15) << name;
    EXPECT_EQ(stroke.force[1], Eigen::Vector3d(101, 106, 111));
    EXPECT_TRUE(stroke.orientation.empty());  // x, y, z, w or w, x, y, z?
  }
}

TEST(Mat, AMatrixThatIsNoVectorIsNot) {
  const TestFolder folder;
  for (const std::size_t width : {1u, 4u, 6u}) {
    const std::filesystem::path path = folder / fmt::format("{}.mat", width);
    {
      MatlabFile file(path);
      file.save(MatlabFile::matrix("pos", 9, width, 0));
    }
    EXPECT_THAT(complaint_of([&] { import_stroke(path, {}); }), HasSubstr("--position")) << width;
  }
}

void save_struct(MatlabFile& file) {
  const char* fields[] = {"x", "y"};
  std::size_t one[] = {1, 1};
  matvar_t* log = Mat_VarCreateStruct("log", 2, one, fields, 2);
  Mat_VarSetStructFieldByIndex(log, 0, 0, MatlabFile::matrix("x", 3, 1, 1));
  Mat_VarSetStructFieldByIndex(log, 1, 0, MatlabFile::matrix("y", 3, 1, 7));
  file.save(log);
}

TEST(Mat, FieldsOfAStructAreColumns) {
  const TestFolder folder;
  for (const mat_ft version : {MAT_FT_MAT5, MAT_FT_MAT73}) {
    const std::filesystem::path path = folder / fmt::format("{}.mat", static_cast<int>(version));
    {
      MatlabFile file(path, version);
      save_struct(file);
      file.save(MatlabFile::matrix("other", 5, 1, 0));
    }
    const SampleTable table = read_mat(path, "log");
    EXPECT_EQ(table.columns.size(), 2u);
    EXPECT_THAT(column(table, "log.x").values, ElementsAre(1, 2, 3));
    EXPECT_THAT(column(table, "log.y").values, ElementsAre(7, 8, 9));
    EXPECT_EQ(read_mat(path, "log.y").columns.size(), 2u);  // what is as long
    EXPECT_EQ(read_mat(path, "other").size(), 5u);
    EXPECT_THAT(complaint_of([&] { read_mat(path); }),
                AllOf(HasSubstr("differ in length"), HasSubstr("log.x (3 x 1)"), HasSubstr("other (5 x 1)")));
    EXPECT_THAT(complaint_of([&] { read_mat(path, "lo"); }), HasSubstr("no variable 'lo'"));
  }
}

TEST(Mat, NaNIsDeliveredButColumnsOfNaNAreLeftOut) {
  const TestFolder folder;
  double x[] = {1, std::nan(""), std::numeric_limits<double>::infinity()};
  double never[] = {std::nan(""), std::nan(""), std::nan("")};
  {
    MatlabFile file(folder / "nan.mat");
    file.save(MatlabFile::of("x", MAT_C_DOUBLE, MAT_T_DOUBLE, 3, 1, x));
    file.save(MatlabFile::of("never", MAT_C_DOUBLE, MAT_T_DOUBLE, 3, 1, never));
    file.save(MatlabFile::matrix("y", 3, 1, 7));
  }
  const SampleTable table = read_mat(folder / "nan.mat");
  EXPECT_EQ(table.columns.size(), 2u);
  EXPECT_THAT(column(table, "x").values, ElementsAre(1, testing::IsNan(), testing::IsNan()));
  EXPECT_THAT(column(table, "y").values, ElementsAre(7, 8, 9));
  EXPECT_THAT(table.description, HasSubstr("left out because all is NaN: never"));
}

TEST(Mat, ColumnsOfNaNAloneAreRefused) {
  const TestFolder folder;
  double never[] = {std::nan(""), std::nan("")};
  MatlabFile(folder / "nan.mat").save(MatlabFile::of("x", MAT_C_DOUBLE, MAT_T_DOUBLE, 2, 1, never));
  EXPECT_THAT(complaint_of([&] { read_mat(folder / "nan.mat"); }), HasSubstr("no finite number"));
}

TEST(Mat, SaysWhatIsWrong) {
  const TestFolder folder;
  put_text(folder / "text.mat", "x,y\n1,2\n");
  EXPECT_THAT(complaint_of([&] { read_mat(folder / "text.mat"); }), Not(""));
  {
    MatlabFile file(folder / "none.mat");
    file.save(MatlabFile::matrix("rate", 1, 1, 1000));
  }
  EXPECT_THAT(complaint_of([&] { read_mat(folder / "none.mat"); }), HasSubstr("no numeric vectors"));
}

/// Whatever is cut off, there is an answer.
TEST(Mat, FilesThatAreCutOffAreRefusedOrShorter) {
  const TestFolder folder;
  {
    MatlabFile file(folder / "whole.mat");
    file.save(MatlabFile::matrix("x", 50, 1, 0));
    save_struct(file);
    file.save(MatlabFile::matrix("y", 50, 1, 0), MAT_COMPRESSION_ZLIB);
  }
  const std::uintmax_t size = std::filesystem::file_size(folder / "whole.mat");
  for (std::uintmax_t kept = 0; kept < size; kept += 7) {
    std::filesystem::copy_file(folder / "whole.mat", folder / "cut.mat",
                               std::filesystem::copy_options::overwrite_existing);
    std::filesystem::resize_file(folder / "cut.mat", kept);
    complaint_of([&] { read_mat(folder / "cut.mat"); });
  }
}

TEST(Mat, BigEndianFilesAreRead) {
  const TestFolder folder;
  const auto word = [](std::uint32_t value) {
    std::string bytes;
    for (int shift = 24; shift >= 0; shift -= 8) bytes += static_cast<char>(value >> shift);
    return bytes;
  };
  const std::string number = std::string("\x3F\xF8", 2) + std::string(6, '\0');  // 1.5
  const std::string level4 = word(1000) + word(2) + word(1) + word(0) + word(2) + std::string("x", 2);
  put_text(folder / "four.mat", level4 + number + number);
  EXPECT_THAT(column(read_mat(folder / "four.mat"), "x").values, ElementsAre(1.5, 1.5));
  const std::string matrix = word(6) + word(8) + word(6) + word(0) +  // flags: double
                             word(5) + word(8) + word(2) + word(1) +  // 2 x 1
                             word(0x00010001) + std::string("x\0\0\0", 4) + word(9) + word(16) + number +
                             number;
  std::string header(124, ' ');
  put_text(folder / "five.mat", header + std::string("\1\0MI", 4) + word(14) +
                                    word(static_cast<std::uint32_t>(matrix.size())) + matrix);
  EXPECT_THAT(column(read_mat(folder / "five.mat"), "x").values, ElementsAre(1.5, 1.5));
}

TEST(Mat, FlippedBitsGiveSentences) {
  const TestFolder folder;
  for (const mat_ft version : {MAT_FT_MAT4, MAT_FT_MAT5}) {
    const std::filesystem::path path = folder / fmt::format("{}.mat", static_cast<int>(version));
    {
      MatlabFile file(path, version);
      file.save(MatlabFile::matrix("pos", 8, 3, 1));
      file.save(MatlabFile::matrix("t", 8, 1, 0), MAT_COMPRESSION_ZLIB);
      if (version == MAT_FT_MAT5) save_struct(file);
    }
    expect_answers_to_flips(path, [](const std::filesystem::path& flipped) { return read_mat(flipped); });
  }
}

}  // namespace
}  // namespace sandstroke
