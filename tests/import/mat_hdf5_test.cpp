#include <gmock/gmock-matchers.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>

#include "complaint.h"
#include "flipped.h"
#include "hdf5/hdf5_handle.h"
#include "import/mat.h"
#include "sanitized.h"
#include "test_folder.h"

namespace sandstroke {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;

/// A file of MATLAB 7.3, or of a stranger who writes such files.
class MatlabHdf5 {
 public:
  explicit MatlabHdf5(const fs::path& path, bool latest = false) : path_(path) {
    prepare_hdf5();
    const Hdf5Handle made(H5Pcreate(H5P_FILE_CREATE), H5Pclose);
    H5Pset_userblock(made, 512);
    const Hdf5Handle access = without_locks();
    if (latest) H5Pset_libver_bounds(access, H5F_LIBVER_LATEST, H5F_LIBVER_LATEST);
    file_ = Hdf5Handle(H5Fcreate(path.c_str(), H5F_ACC_TRUNC, made, access), H5Fclose);
  }
  ~MatlabHdf5() {
    file_.close();
    std::string header = "MATLAB 7.3 MAT-file";
    header.resize(124, ' ');
    header += std::string_view("\0\2IM", 4);
    std::fstream(path_, std::ios::binary | std::ios::in | std::ios::out) << header;
  }
  hid_t file() const { return file_; }

  void text(const char* object, const char* attribute, const std::string& value, H5T_str_t padding,
            hsize_t count = 1) {
    const Hdf5Handle type(H5Tcopy(H5T_C_S1), H5Tclose);
    H5Tset_size(type, value.size());
    H5Tset_strpad(type, padding);
    const Hdf5Handle space(count == 1 ? H5Screate(H5S_SCALAR) : H5Screate_simple(1, &count, nullptr),
                           H5Sclose);
    const Hdf5Handle made(
        H5Acreate_by_name(file_, object, attribute, type, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT),
        H5Aclose);
    std::string values;
    for (hsize_t i = 0; i < count; ++i) values += value;
    H5Awrite(made, type, values.data());
  }
  void matlab_class(const char* object, const std::string& name) {
    text(object, "MATLAB_class", name, H5T_STR_NULLPAD);
  }
  void mark(const char* object, const char* attribute, int value) {
    const Hdf5Handle space(H5Screate(H5S_SCALAR), H5Sclose);
    const Hdf5Handle made(H5Acreate_by_name(file_, object, attribute, H5T_STD_I32LE, space, H5P_DEFAULT,
                                            H5P_DEFAULT, H5P_DEFAULT),
                          H5Aclose);
    H5Awrite(made, H5T_NATIVE_INT, &value);
  }
  void group(const char* name, const std::string& type = "struct") {
    Hdf5Handle(H5Gcreate2(file_, name, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT), H5Gclose);
    if (!type.empty()) matlab_class(name, type);
  }
  /// A variable of MATLAB's size rows x columns, whose numbers are given column by column.
  template <class Number = double>
  void variable(const char* name, hsize_t rows, hsize_t columns, const std::vector<Number>& values,
                hid_t type = H5T_IEEE_F64LE, const std::string& of = "double") {
    const hsize_t shape[] = {columns, rows};
    const Hdf5Handle space(H5Screate_simple(2, shape, nullptr), H5Sclose);
    const Hdf5Handle made(H5Dcreate2(file_, name, type, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT),
                          H5Dclose);
    hid_t memory = H5T_NATIVE_DOUBLE;
    if constexpr (std::is_same_v<Number, std::int64_t>) memory = H5T_NATIVE_INT64;
    H5Dwrite(made, memory, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data());
    if (!of.empty()) matlab_class(name, of);
  }

 private:
  fs::path path_;
  Hdf5Handle file_;
};

TEST(MatHdf5, NumbersOfAllKindsBecomeColumns) {
  const TestFolder folder;
  {
    MatlabHdf5 file(folder / "a.mat");
    file.variable("t", 3, 1, {0.0, 0.5, std::nan("")});
    file.variable("pos", 3, 2, {1, 2, 3, 4, 5, 6});
    file.variable("force", 2, 3, {1, 2, 3, 4, 5, 6});
    file.variable("single", 1, 3, {0.5, 0.25, -1}, H5T_IEEE_F32BE, "single");
    file.variable("whole", 3, 1, {-1, 2, 300}, H5T_STD_I16LE, "int16");
    file.variable("on", 3, 1, {0, 1, 1}, H5T_STD_U8LE, "logical");
    file.variable<std::int64_t>("stamp", 3, 1,
                                {1700000000123456789, 1700000000123456790, 1700000000123456788},
                                H5T_STD_I64LE, "int64");
  }
  const SampleTable table = read_mat(folder / "a.mat");
  EXPECT_EQ(table.columns.size(), 9u);
  EXPECT_THAT(column(table, "pos.2").values, ElementsAre(4, 5, 6));
  EXPECT_THAT(column(table, "force.1").values, ElementsAre(1, 3, 5));  // samples along the longer side
  EXPECT_THAT(column(table, "single").values, ElementsAre(0.5, 0.25, -1));
  EXPECT_THAT(column(table, "whole").values, ElementsAre(-1, 2, 300));
  EXPECT_THAT(column(table, "on").values, ElementsAre(0, 1, 1));
  EXPECT_TRUE(std::isnan(column(table, "t").values[2]));
  EXPECT_THAT(column(table, "stamp").values, ElementsAre(0, 1, -1));
  EXPECT_EQ(column(table, "stamp").origin, 1700000000123456789);
}

TEST(MatHdf5, TheClassIsReadHoweverItIsPadded) {
  const TestFolder folder;
  {
    MatlabHdf5 file(folder / "a.mat");
    file.variable("a", 2, 1, {1, 2}, H5T_IEEE_F64LE, "");
    file.variable("b", 2, 1, {1, 2}, H5T_IEEE_F64LE, "");
    file.variable("c", 2, 1, {1, 2}, H5T_IEEE_F64LE, "");
    file.text("a", "MATLAB_class", "double", H5T_STR_NULLPAD);
    file.text("b", "MATLAB_class", std::string("double\0", 7), H5T_STR_NULLTERM);
    file.text("c", "MATLAB_class", std::string("double\0\0\0", 9), H5T_STR_NULLPAD);
  }
  EXPECT_EQ(read_mat(folder / "a.mat").columns.size(), 3u);
}

TEST(MatHdf5, FieldsOfStructsHaveTheirNames) {
  const TestFolder folder;
  {
    MatlabHdf5 file(folder / "a.mat");
    file.group("s");
    file.group("s/tip");
    file.variable("s/x", 3, 1, {1, 2, 3});
    file.variable("s/tip/y", 3, 1, {4, 5, 6});
    file.variable("other", 4, 1, {1, 2, 3, 4});
  }
  EXPECT_THAT(complaint_of([&] { read_mat(folder / "a.mat"); }), HasSubstr("s.tip.y (3 x 1)"));
  EXPECT_EQ(read_mat(folder / "a.mat", "s").columns.size(), 2u);
  EXPECT_EQ(read_mat(folder / "a.mat", "s.tip").columns.size(), 1u);
  EXPECT_THAT(column(read_mat(folder / "a.mat", "s.x"), "s.tip.y").values, ElementsAre(4, 5, 6));
}

TEST(MatHdf5, WhatIsNoVectorIsLeftOut) {
  const TestFolder folder;
  {
    MatlabHdf5 file(folder / "a.mat");
    file.variable("x", 3, 1, {1, 2, 3});
    file.variable("single", 1, 1, {7});
    file.variable("text", 1, 3, {65, 66, 67}, H5T_STD_U16LE, "char");
    file.variable("object", 1, 3, {1, 2, 3}, H5T_STD_U32LE, "table");
    file.variable("empty", 1, 2, {0, 3}, H5T_STD_U64LE);
    file.mark("empty", "MATLAB_empty", 1);
    file.group("sparse", "double");
    file.variable("sparse/data", 3, 1, {1, 2, 3});
    file.group("sparse_too", "");
    file.mark("sparse_too", "MATLAB_sparse", 3);
    file.variable("sparse_too/data", 3, 1, {1, 2, 3});
    file.group("#refs#", "");
    file.variable("#refs#/a", 3, 1, {1, 2, 3});
    H5Lcreate_soft("/x", file.file(), "soft", H5P_DEFAULT, H5P_DEFAULT);
    H5Lcreate_external("b.mat", "/x", file.file(), "external", H5P_DEFAULT, H5P_DEFAULT);
  }
  const SampleTable table = read_mat(folder / "a.mat");
  ASSERT_EQ(table.columns.size(), 1u);
  EXPECT_EQ(table.columns[0].name, "x");
}

TEST(MatHdf5, OtherProgramsFilesNeedNoClass) {
  const TestFolder folder;
  {
    MatlabHdf5 file(folder / "a.mat");
    file.group("g", "");
    file.variable("g/x", 3, 1, {1, 2, 3}, H5T_IEEE_F64LE, "");
    file.variable("square", 3, 3, {1, 2, 3, 4, 5, 6, 7, 8, 9}, H5T_IEEE_F64LE, "");
  }
  const SampleTable table = read_mat(folder / "a.mat");
  EXPECT_THAT(column(table, "g.x").values, ElementsAre(1, 2, 3));
  EXPECT_THAT(column(table, "square.1").values, ElementsAre(1, 4, 7));  // rows are samples
}

TEST(MatHdf5, AStructThatHoldsItselfIsRefused) {
  const TestFolder folder;
  for (const char* around : {"s", "s/in"}) {
    {
      MatlabHdf5 file(folder / "a.mat");
      file.group("s");
      file.group("s/in");
      H5Lcreate_hard(file.file(), around, file.file(), "s/in/loop", H5P_DEFAULT, H5P_DEFAULT);
    }
    EXPECT_THAT(complaint_of([&] { read_mat(folder / "a.mat"); }),
                AllOf(HasSubstr("struct s.in.loop"), HasSubstr("holds itself")));
  }
}

TEST(MatHdf5, DeepOrManyObjectsAreRefused) {
  const TestFolder folder;
  {
    MatlabHdf5 file(folder / "deep.mat");
    std::string name = "s";
    for (int i = 0; i < 40; ++i, name += "/s") file.group(name.c_str());
  }
  EXPECT_THAT(complaint_of([&] { read_mat(folder / "deep.mat"); }), HasSubstr("nested deeper than 16"));
  {
    MatlabHdf5 file(folder / "wide.mat");  // 3^11 ways to the innermost
    std::string name = "s";
    for (int i = 0; i < 12; ++i, name += "/a") {
      file.group(name.c_str());
      for (const char* more : {"/b", "/c", "/d"})
        if (i > 0)
          H5Lcreate_hard(file.file(), name.c_str(), file.file(),
                         (name.substr(0, name.size() - 2) + more).c_str(), H5P_DEFAULT, H5P_DEFAULT);
    }
  }
  EXPECT_THAT(complaint_of([&] { read_mat(folder / "wide.mat"); }), HasSubstr("more than 2000 variables"));
}

TEST(MatHdf5, DamagedFilesAreRefused) {
  const TestFolder folder;
  {
    MatlabHdf5 file(folder / "a.mat");
    file.variable("x", 3, 1, {1, 2, 3}, H5T_IEEE_F64LE, "");
    file.text("x", "MATLAB_class", "double", H5T_STR_NULLPAD, 100);
  }
  EXPECT_THAT(complaint_of([&] { read_mat(folder / "a.mat"); }), HasSubstr("'MATLAB_class'"));
  {
    MatlabHdf5 file(folder / "b.mat");
    const hsize_t shape[] = {1, hsize_t{1} << 40};
    const Hdf5Handle space(H5Screate_simple(2, shape, nullptr), H5Sclose);
    const Hdf5Handle made(
        H5Dcreate2(file.file(), "x", H5T_IEEE_F64LE, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT), H5Dclose);
  }
  EXPECT_THAT(complaint_of([&] { read_mat(folder / "b.mat"); }), HasSubstr("more than it can hold"));
  std::string none = "MATLAB 7.3 MAT-file";
  none.resize(600, ' ');
  put_text(folder / "c.mat", none);
  EXPECT_THAT(complaint_of([&] { read_mat(folder / "c.mat"); }), HasSubstr("without its HDF5 part"));
}

TEST(MatHdf5, FlippedBitsGiveSentences) {
  if (sanitized) GTEST_SKIP() << "HDF5 asks for all the memory that a damaged file names, and is refused";
  const TestFolder folder;
  for (const bool latest : {false, true}) {
    {
      MatlabHdf5 file(folder / "a.mat", latest);
      file.group("s");
      for (const char* name : {"a", "b", "c", "d", "e", "f", "g", "h", "i", "j"}) {
        file.variable(name, 8, 1, {1, 2, 3, 4, 5, 6, 7, 8});
        file.variable((std::string("s/") + name).c_str(), 8, 1, {1, 2, 3, 4, 5, 6, 7, 8});
      }
    }
    expect_answers_to_flips(folder / "a.mat", [](const fs::path& path) { return read_mat(path); });
  }
}

}  // namespace
}  // namespace sandstroke
