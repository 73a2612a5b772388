#include <gmock/gmock-matchers.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <cstring>
#include <fstream>

#include "complaint.h"
#include "flipped.h"
#include "import/import_stroke.h"
#include "import/npy.h"
#include "import/npz.h"
#include "real_client.h"
#include "test_folder.h"
#include "zip_writer.h"

namespace sandstroke {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;

/// The bytes of a .npy file.
std::string npy(const std::string& descr, const std::string& shape, const std::string& data,
                const std::string& order = "False", int version = 1) {
  std::string header = "{'descr': " + descr + ", 'fortran_order': " + order + ", 'shape': (" + shape + "), }";
  while ((header.size() + 11) % 64 != 0) header += ' ';
  header += '\n';
  std::string bytes = std::string("\x93NUMPY") + static_cast<char>(version) + '\0';
  for (int i = 0; i < (version == 1 ? 2 : 4); ++i) bytes += static_cast<char>(header.size() >> 8 * i);
  return bytes + header + data;
}

template <class Number>
std::string bytes_of(std::initializer_list<Number> numbers) {
  std::string bytes(numbers.size() * sizeof(Number), '\0');
  std::memcpy(bytes.data(), std::data(numbers), bytes.size());
  return bytes;
}

std::string doubles(std::initializer_list<double> numbers) { return bytes_of(numbers); }

SampleTable numpy_table(const std::string& bytes) {
  const TestFolder folder;
  put_text(folder / "a.npy", bytes);
  return read_npy(folder / "a.npy");
}
SampleTable table_of_archive(const ZipWriter& zip, const std::string& part = "") {
  const TestFolder folder;
  put_text(folder / "a.npz", zip.archive());
  return read_npz(folder / "a.npz", part);
}

TEST(Npy, RowsAreSamplesInEitherOrder) {
  for (const int version : {1, 2, 3}) {
    const SampleTable rows = numpy_table(npy("'<f8'", "3, 2", doubles({1, 2, 3, 4, 5, 6}), "False", version));
    const SampleTable columns =
        numpy_table(npy("'<f8'", "3, 2", doubles({1, 3, 5, 2, 4, 6}), "True", version));
    for (const SampleTable* table : {&rows, &columns}) {
      ASSERT_EQ(table->columns.size(), 2u);
      EXPECT_THAT(column(*table, "1").values, ElementsAre(1, 3, 5));
      EXPECT_THAT(column(*table, "2").values, ElementsAre(2, 4, 6));
    }
  }
  EXPECT_THAT(column(numpy_table(npy("'<f8'", "3,", doubles({1, 2, 3}))), "1").values, ElementsAre(1, 2, 3));
}

TEST(Npy, NumbersOfAllKindsAreRead) {
  const auto read = [](const char* descr, const std::string& bytes) {
    return numpy_table(npy(descr, "2,", bytes)).columns[0].values;
  };
  EXPECT_THAT(read("'<f4'", bytes_of({0.5f, -2.0f})), ElementsAre(0.5, -2));
  EXPECT_THAT(read("'>f4'", std::string("\x3F\0\0\0\xC0\0\0\0", 8)), ElementsAre(0.5, -2));
  EXPECT_THAT(read("'<f2'", std::string("\x00\x3C\x01\x80", 4)), ElementsAre(1.0, -0x1p-24));
  EXPECT_THAT(read("'<i2'", bytes_of<std::int16_t>({-300, 7})), ElementsAre(-300, 7));
  EXPECT_THAT(read("'>u2'", std::string("\xFF\xFF\0\1", 4)), ElementsAre(65535, 1));
  EXPECT_THAT(read("'|i1'", "\xFF\x01"), ElementsAre(-1, 1));
  EXPECT_THAT(read("'|b1'", std::string("\1\0", 2)), ElementsAre(1, 0));
}

TEST(Npy, FieldsHaveTheirNames) {
  const std::string descr =
      "[('t', '<f8'), ('name', '<U1'), ('tip', [('pos', '<f4', (3,)), ('on', '?')]), (('title', 'n'), "
      "'|u1')]";
  const std::string fixed = std::string(descr).replace(descr.find("'?'"), 3, "'|b1'");
  std::string data;
  for (const float i : {1.0f, 2.0f})
    data += doubles({static_cast<double>(i)}) + "abcd" + bytes_of({i, 2 * i, 3 * i}) + '\1' +
            static_cast<char>(10 * i);
  const SampleTable table = numpy_table(npy(fixed, "2,", data));
  ASSERT_EQ(table.columns.size(), 6u);
  EXPECT_THAT(column(table, "t").values, ElementsAre(1, 2));
  EXPECT_THAT(column(table, "tip.pos.3").values, ElementsAre(3, 6));
  EXPECT_THAT(column(table, "tip.on").values, ElementsAre(1, 1));
  EXPECT_THAT(column(table, "n").values, ElementsAre(10, 20));
}

TEST(Npy, TimesKeepTheirUnitAndAllDigits) {
  const std::int64_t first = 1700000000123456789, none = std::numeric_limits<std::int64_t>::min();
  const std::string data = bytes_of<std::int64_t>({none, 1, first, 2, first + 1, 3});
  const SampleTable table = numpy_table(npy("[('t', '<M8[ns]'), ('d', '<m8[ms]')]", "3,", data));
  EXPECT_EQ(column(table, "t").unit, "ns");
  EXPECT_EQ(column(table, "t").origin, first);
  EXPECT_THAT(column(table, "t").values, ElementsAre(testing::IsNan(), 0, 1));
  EXPECT_EQ(column(table, "d").unit, "ms");
  EXPECT_FALSE(column(table, "d").origin);
  const SampleTable whole = numpy_table(npy("'<i8'", "2,", bytes_of<std::int64_t>({first, first - 1})));
  EXPECT_EQ(whole.columns[0].origin, first);
  EXPECT_THAT(whole.columns[0].values, ElementsAre(0, -1));
}

TEST(Npy, FieldsWithoutEndAreRefused) {
  const std::string empty = "[('b', '|S0')]", side = "(10000,)";
  for (const std::string& descr :
       {"[('a', " + empty + ", 99999999999999999)]", "[('a', " + empty + ", (10001,))]",
        "[('a', [('b', [('c', '|S0', " + side + ")], " + side + ")], " + side + ")]",
        "[('a', [('b', [('c', '<f8', 0)], " + side + ")], " + side + ")]",
        "[('a', [('b', [], " + side + ")], " + side + ")]",
        "[('" + std::string(2000, 'a') + "', '<f8', (9000,))]"})
    EXPECT_THAT(complaint_of([&] { numpy_table(npy(descr, "0,", "")); }), HasSubstr("has a damaged header"))
        << descr;
}

TEST(Npy, SaysWhatIsWrong) {
  const std::string three = doubles({1, 2, 3});
  const struct {
    std::string bytes;
    const char *what, *way_out;
  } files[] = {
      {npy("'<f8'", "1, 3", three), "1 rows and 3 columns", "a.T"},
      {npy("'|O'", "3,", three), "Python objects", "allow_pickle=False"},
      {npy("[('a', '<f8'), ('b', '|O')]", "1,", three), "Python objects", "allow_pickle=False"},
      {npy("'<c16'", "1,", doubles({1, 2})), "no real numbers", "astype"},
      {npy("'<f16'", "1,", doubles({1, 2})), "no real numbers", "astype"},
      {npy("'<U2'", "3,", three), "no real numbers", "astype"},
      {npy("'<f8'", "0, 3", ""), "no real numbers", ""},
      {npy("'<f8'", "", doubles({1})), "single number", "one row per sample"},
      {npy("'<f8'", "3, 1, 1", three), "3 dimensions", "reshape"},
      {npy("'<f8'", "4,", three), "cut off", "save it again"},
      {npy("'<f8'", "2,", three), "8 bytes more", "numpy.savez"},
      {npy("'<f8'", "4000000000, 4000000000", three), "cut off", "save it again"},
      {npy("'<q8'", "3,", three), "no real numbers", ""},
      {npy("'f8'", "3,", three), "damaged", "numpy.save"},
      {npy("'<f8'", "-3,", three), "damaged", "numpy.save"},
      {npy("'<f8'", "3,", three, "Maybe"), "damaged", "numpy.save"},
      {npy("[('a', '<f8', (100000000, 100000000))]", "3,", three), "damaged", "numpy.save"},
      {npy(std::string(10000, '['), "3,", three), "damaged", "numpy.save"},
      {npy("'<f8'", "3,", three, "False", 9), "damaged", "numpy.save"},
      {std::string("\x93NUMPY\1\0\xFF\xFF{", 11), "damaged", "numpy.save"},
  };
  for (const auto& file : files)
    EXPECT_THAT(complaint_of([&] { numpy_table(file.bytes); }),
                AllOf(HasSubstr("a.npy"), HasSubstr(file.what), HasSubstr(file.way_out)));
}

TEST(Npz, ArraysOfOneLengthAreOneTable) {
  for (const bool deflated : {false, true})
    for (const bool zip64 : {false, true}) {
      ZipWriter zip(deflated, zip64);
      zip.add("t.npy", npy("'<f8'", "2,", doubles({0, 1})));
      zip.add("pos.npy", npy("'<f8'", "2, 2", doubles({1, 2, 3, 4})));
      zip.add("log.npy", npy("[('fx', '<f8')]", "2,", doubles({5, 6})));
      zip.add("rate.npy", npy("'<f8'", "", doubles({1000})));
      zip.add("note.npy", npy("'|O'", "1,", "pickle"));
      zip.add("read.me", "hello");
      const SampleTable table = table_of_archive(zip);
      ASSERT_EQ(table.columns.size(), 4u);
      EXPECT_THAT(column(table, "t").values, ElementsAre(0, 1));
      EXPECT_THAT(column(table, "pos.2").values, ElementsAre(2, 4));
      EXPECT_THAT(column(table, "log.fx").values, ElementsAre(5, 6));
      EXPECT_THAT(complaint_of([&] { table_of_archive(zip, "note"); }), HasSubstr("Python objects"));
    }
}

TEST(Npz, PartChoosesByLength) {
  ZipWriter zip;
  zip.add("t.npy", npy("'<f8'", "2,", doubles({0, 1})));
  zip.add("x.npy", npy("'<f8'", "2,", doubles({5, 6})));
  zip.add("wide.npy", npy("'<f8'", "2, 3", doubles({1, 2, 3, 4, 5, 6})));
  zip.add("other.npy", npy("'<f8'", "3,", doubles({1, 2, 3})));
  EXPECT_THAT(complaint_of([&] { table_of_archive(zip); }),
              AllOf(HasSubstr("differ in length"), HasSubstr("x (2 x 1)"), HasSubstr("wide (2 x 3)")));
  EXPECT_EQ(table_of_archive(zip, "x").columns.size(), 2u);
  EXPECT_EQ(table_of_archive(zip, "other").size(), 3u);
  EXPECT_THAT(complaint_of([&] { table_of_archive(zip, "wide"); }), HasSubstr("save it transposed"));
  EXPECT_THAT(complaint_of([&] { table_of_archive(zip, "no"); }), HasSubstr("no array 'no'"));
}

TEST(Npz, DamageIsFound) {
  const TestFolder folder;
  ZipWriter stored, deflated(true);
  for (ZipWriter* zip : {&stored, &deflated}) zip->add("t.npy", npy("'<f8'", "4,", doubles({0, 1, 2, 3})));
  std::string archive = stored.archive();
  archive[150] ^= 1;
  put_text(folder / "a.npz", archive);
  EXPECT_THAT(complaint_of([&] { read_npz(folder / "a.npz"); }), HasSubstr("checksum"));
  put_text(folder / "a.npz", archive.substr(0, 100));
  EXPECT_THAT(complaint_of([&] { read_npz(folder / "a.npz"); }), HasSubstr("cut off"));
  put_text(folder / "a.npz", "");
  EXPECT_THAT(complaint_of([&] { read_npz(folder / "a.npz"); }), HasSubstr("cut off"));
  put_text(folder / "a.npz", ZipWriter().archive());
  EXPECT_THAT(complaint_of([&] { read_npz(folder / "a.npz"); }), HasSubstr("no arrays"));
  for (const ZipWriter* zip : {&stored, &deflated}) {
    put_text(folder / "a.npz", zip->archive());
    expect_answers_to_flips(folder / "a.npz", [](const fs::path& path) { return read_npz(path); });
  }
  put_text(folder / "a.npy", npy("[('a', '<f8'), ('b', '<f4', (2,))]", "1,", doubles({1, 2})));
  expect_answers_to_flips(folder / "a.npy", [](const fs::path& path) { return read_npy(path); });
}

TEST(Npz, EntriesThatShareAMemberAreRefused) {
  ZipWriter zip(true);
  zip.add("a.npy", npy("'|O'", "125000,", std::string(1'000'000, '\0')));
  for (int i = 0; i < 400; ++i) zip.add_entry();
  EXPECT_THAT(complaint_of([&] { table_of_archive(zip); }), HasSubstr("a.npy is damaged"));
}

TEST(Npz, APositionIsFoundByItsName) {
  const TestFolder folder;
  ZipWriter zip(true);
  zip.add("pos.npy", npy("'<f8'", "3, 2", doubles({0, 0, 1, 0, 1, 1})));
  put_text(folder / "a.npz", zip.archive());
  TableSettings settings;
  settings.rate = 10.0;
  settings.position_unit = "mm";
  EXPECT_EQ(import_stroke(folder / "a.npz", settings).stroke.position[1], Eigen::Vector3d(0.001, 0, 0));
}

/// What NumPy saves is what NumPy holds, to the last bit.
TEST(Numpy, ItsOwnFilesAreReadExactly) {
  SANDSTROKE_NEEDS(python_has("numpy"), "python3-numpy");
  const TestFolder folder;
  put_text(folder / "save.py", R"(
import numpy, sys
random = numpy.random.default_rng(1)
arrays = {}
for kind in ["<f8", ">f8", "<f4", ">f4", "<f2", "<i8", ">i8", "<i4", "<u4", "<i2", ">u2", "|i1", "|u1", "|b1"]:
    arrays["v_" + kind.strip("<>|") + str(len(arrays))] = (random.normal(size=50) * 50).astype(kind)
arrays["c"] = random.normal(size=(50, 4))
arrays["f"] = numpy.asfortranarray(random.normal(size=(50, 4)))
numpy.savez(sys.argv[1] + "/stored.npz", **arrays)
numpy.savez_compressed(sys.argv[1] + "/packed.npz", **arrays)
record = numpy.zeros(50, [("t", ">f8"), ("p", "<f4", (2, 2)), ("n", [("k", "<i2")])], )
record["t"], record["p"], record["n"]["k"] = random.normal(size=50), random.normal(size=(50, 2, 2)), range(50)
numpy.save(sys.argv[1] + "/record.npy", record)
with open(sys.argv[1] + "/archive.txt", "w") as out:
    for name, array in arrays.items():
        for k, column in enumerate(array.reshape(50, -1).T):
            print(name if array.ndim == 1 else f"{name}.{k + 1}", *[float(v).hex() for v in column], file=out)
with open(sys.argv[1] + "/record.txt", "w") as out:
    print("t", *[float(v).hex() for v in record["t"]], file=out)
    for k in range(4):
        print(f"p.{k + 1}", *[float(v).hex() for v in record["p"].reshape(50, 4)[:, k]], file=out)
    print("n.k", *[float(v).hex() for v in record["n"]["k"]], file=out)
)");
  const auto saved = run_child({python, folder / "save.py", folder.path()});
  ASSERT_TRUE(saved && saved->exit_code == 0);
  const auto expect_equal = [&](const SampleTable& table, const char* list) {
    std::ifstream lines(folder / list);
    std::size_t count = 0;
    for (std::string line; std::getline(lines, line); ++count) {
      std::istringstream words(line);
      std::string name, word;
      words >> name;
      std::vector<double> values;
      while (words >> word) values.push_back(std::strtod(word.c_str(), nullptr));
      EXPECT_EQ(column(table, name).values, values) << name;
    }
    EXPECT_EQ(table.columns.size(), count);
  };
  expect_equal(read_npz(folder / "stored.npz"), "archive.txt");
  expect_equal(read_npz(folder / "packed.npz"), "archive.txt");
  expect_equal(read_npy(folder / "record.npy"), "record.txt");
}

}  // namespace
}  // namespace sandstroke
