#include "sweep/collect.h"

#include <gtest/gtest.h>
#include <hdf5_hl.h>
#include <unistd.h>

#include <cmath>
#include <fstream>
#include <functional>

#include "core/input_file.h"
#include "core/output_file.h"
#include "dataset_shape.h"
#include "hdf5/hdf5_file.h"
#include "sand/initial_surface.h"
#include "sweep/sweep_file.h"
#include "test_folder.h"

namespace sandstroke {
namespace {

namespace fs = std::filesystem;
using Numbers = std::vector<double>;

constexpr double none = PointResult::none;
constexpr int rows = 70, cols = 90;
constexpr double cell = 0.25;

/// talus angle x preset, 3 x 2 points.
SweepManifest grid_manifest() {
  SweepManifest m;
  m.scene = "/somewhere/scene.toml";
  m.design = {true,
              {{"relaxation.talus_angle", "deg", false, {"20", "27.5", "35"}},
               {"model.preset", "", false, {"\"paper\"", "\"accurate\""}}}};
  m.metrics = {"max_force", "wall_seconds", "furrow_depth"};
  m.inputs = {{"scene.toml", "0123"}};
  m.version = "1";
  m.commit = "abc";
  return m;
}

SweepManifest latin_manifest() {
  SweepManifest m = grid_manifest();
  m.design = {false,
              {{"force.k_s", "N", true, {"800", "1200.5", "900"}},
               {"model.preset", "", false, {"\"paper\"", "\"accurate\"", "\"paper\""}}}};
  return m;
}

HeightField surface_of(std::size_t point) {
  HeightField bed(rows, cols, cell);
  for (int i = 0; i < 20; ++i) bed.set(3 * i, 4 * i, 0.01 * static_cast<double>(point + 1) + 1e-3 * i);
  return bed;
}

PointResult result_of(std::size_t point) {
  const auto p = static_cast<double>(point);
  return {point % 2 ? PointVerdict::active : PointVerdict::at_rest, "", {1.0 / (3.0 + p), 17.0 * p, 0.1 * p}};
}

/// Any dataset of numbers.
Numbers read_all(const fs::path& path, const std::string& dataset) {
  const Hdf5Handle file(H5Fopen(path.c_str(), H5F_ACC_RDONLY, without_locks()), H5Fclose);
  const Hdf5Handle opened(H5Dopen2(file, dataset.c_str(), H5P_DEFAULT), H5Dclose);
  const Hdf5Handle space(H5Dget_space(opened), H5Sclose);
  Numbers values(static_cast<std::size_t>(std::max<hssize_t>(0, H5Sget_simple_extent_npoints(space))));
  EXPECT_GE(H5Dread(opened, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()), 0) << dataset;
  return values;
}

/// Names of the scales of each of its dimensions; "" where there is none.
std::vector<std::string> scales_of(const fs::path& path, const std::string& dataset) {
  const Hdf5Handle file(H5Fopen(path.c_str(), H5F_ACC_RDONLY, without_locks()), H5Fclose);
  const Hdf5Handle opened(H5Dopen2(file, dataset.c_str(), H5P_DEFAULT), H5Dclose);
  const Hdf5Handle space(H5Dget_space(opened), H5Sclose);
  std::vector<std::string> names;
  for (int i = 0; i < H5Sget_simple_extent_ndims(space); ++i) {
    names.emplace_back();
    const auto keep = [](hid_t, unsigned, hid_t scale, void* name) -> herr_t {
      char text[100] = "";
      H5Iget_name(scale, text, sizeof text);
      *static_cast<std::string*>(name) = std::string(text);
      return H5DSis_scale(scale) > 0 ? 1 : -1;
    };
    if (H5DSget_num_scales(opened, static_cast<unsigned>(i)) == 1)
      H5DSiterate_scales(opened, static_cast<unsigned>(i), nullptr, keep, &names.back());
  }
  return names;
}

bool same_bits(double a, double b) { return (std::isnan(a) && std::isnan(b)) || a == b; }

void expect_numbers(const Numbers& values, const Numbers& expected) {
  ASSERT_EQ(values.size(), expected.size());
  for (std::size_t i = 0; i < values.size(); ++i) EXPECT_TRUE(same_bits(values[i], expected[i])) << i;
}

class Collect : public testing::Test {
 protected:
  SweepFolder make(const SweepManifest& manifest) { return SweepFolder::make(parent / "sweep", manifest); }
  fs::path file() const { return parent / "sweep/sweep.h5"; }

  const TestFolder parent;
};

using Names = std::vector<std::string>;

TEST_F(Collect, AGridIsArraysOverScalesWithWhatIsMissingLeftOut) {
  const SweepFolder folder = make(grid_manifest());
  for (const std::size_t point : {0, 1, 4}) folder.write(point, result_of(point), "", {});
  folder.write(3, {PointVerdict::unstable, "it blew up", {none, none, none}}, "", {});
  std::ofstream(folder.point_file(5)) << "cut off";
  const CollectReport report = collect(folder);
  EXPECT_EQ(report.done, 3u);
  EXPECT_EQ(report.failed, 1u);
  EXPECT_EQ(report.missing, 1u);
  EXPECT_EQ(report.unreadable, 1u);
  ASSERT_EQ(report.sentences.size(), 3u);
  EXPECT_NE(report.sentences[0].find("1 point is missing"), std::string::npos) << report.sentences[0];
  EXPECT_NE(report.sentences[1].find("000005.h5"), std::string::npos) << report.sentences[1];
  EXPECT_NE(report.sentences[2].find("point 3: it blew up"), std::string::npos) << report.sentences[2];

  const Hdf5Reader opened(file());
  const Names axes = {"/relaxation.talus_angle", "/model.preset"};
  for (const std::string name :
       {"max_force", "furrow_depth", "verdict", "point", "reason", "timing/wall_seconds"}) {
    EXPECT_EQ(opened.shape(name), (std::vector<hsize_t>{3, 2})) << name;
    EXPECT_EQ(scales_of(file(), name), axes) << name;
  }
  expect_numbers(read_all(file(), "max_force"), {1.0 / 3.0, 1.0 / 4.0, none, none, 1.0 / 7.0, none});
  expect_numbers(read_all(file(), "timing/wall_seconds"), {0.0, 17.0, none, none, 68.0, none});
  expect_numbers(read_all(file(), "verdict"), {0, 2, 5, 3, 0, 5});
  expect_numbers(read_all(file(), "point"), {0, 1, 2, 3, 4, 5});
  expect_numbers(opened.doubles("relaxation.talus_angle"), {20.0, 27.5, 35.0});
  EXPECT_EQ(opened.text_attribute("relaxation.talus_angle", "units"), "deg");
  EXPECT_EQ(opened.text_attribute("max_force", "units"), "N");
  EXPECT_EQ(opened.text_attribute("max_force", "long_name"), "peak force");
  EXPECT_EQ(opened.text_attribute("verdict", "flag_meanings"),
            "at_rest not_at_rest active unstable refused missing");
  EXPECT_EQ(opened.text_attribute("/", "content_hash"), report.content_hash);
  EXPECT_FALSE(opened.has("wall_seconds"));

  EXPECT_EQ(read_text_file(parent / "sweep/sweep.csv"),
            "point,relaxation.talus_angle,model.preset,verdict,max_force,wall_seconds,furrow_depth,reason\n"
            "0,20,paper,at rest,0.3333333333333333,0,0,\n"
            "1,20,accurate,active,0.25,17,0.1,\n"
            "2,27.5,paper,missing,,,,\n"
            "3,27.5,accurate,unstable,,,,it blew up\n"
            "4,35,paper,at rest,0.14285714285714285,68,0.4,\n"
            "5,35,accurate,missing,,,,its file is cut off or damaged\n");
}

TEST_F(Collect, ALatinHypercubeIsArraysAlongItsPoints) {
  const SweepFolder folder = make(latin_manifest());
  for (const std::size_t point : {2, 0}) folder.write(point, result_of(point), "", {});
  collect(folder);
  const Hdf5Reader opened(file());
  expect_numbers(opened.doubles("max_force"), {1.0 / 3.0, none, 1.0 / 5.0});
  expect_numbers(opened.doubles("force.k_s"), {800.0, 1200.5, 900.0});
  for (const std::string name : {"max_force", "force.k_s", "model.preset", "verdict"})
    EXPECT_EQ(scales_of(file(), name), Names{"/point"}) << name;
  EXPECT_FALSE(opened.has("reason"));  // none failed
  EXPECT_EQ(opened.text_attribute("max_force", "coordinates"), "force.k_s model.preset");
}

/// Changes the working directory for as long as it lives.
class WorkingDirectory {
 public:
  explicit WorkingDirectory(const fs::path& path) : before_(fs::current_path()) { fs::current_path(path); }
  ~WorkingDirectory() { fs::current_path(before_); }

 private:
  fs::path before_;
};

TEST_F(Collect, SurfacesAreThoseOfThePointsFromAnywhereAndAfterAMove) {
  SweepManifest manifest = grid_manifest();
  manifest.keep_surface = true;
  {
    const SweepFolder folder = make(manifest);
    for (const std::size_t point : {0, 1, 2, 4, 5}) {
      const HeightField surface = surface_of(point);
      folder.write(point, result_of(point), "", {&surface});
    }
    EXPECT_EQ(collect(folder).surfaces_missing, 0u);
  }
  EXPECT_EQ(dataset_shape(file(), "surface"), (std::vector<hsize_t>{3, 2, rows, cols}));
  EXPECT_EQ(scales_of(file(), "surface"), (Names{"/relaxation.talus_angle", "/model.preset", "/y", "/x"}));
  const BedGeometry bed(rows, cols, cell);
  EXPECT_EQ(Hdf5Reader(file()).doubles("y")[69], bed.y_of(69));
  EXPECT_EQ(Hdf5Reader(file()).doubles("x")[0], bed.x_of(0));

  const auto expect_surfaces = [&](const fs::path& path) {
    const Numbers values = read_all(path, "surface");
    for (std::size_t point = 0; point < 6; ++point) {
      const HeightGrid expected =
          point == 3 ? HeightGrid::Constant(rows, cols, none) : surface_of(point).grid();
      for (Eigen::Index i = 0; i < expected.size(); ++i)
        ASSERT_TRUE(same_bits(values[point * rows * cols + static_cast<std::size_t>(i)], expected.data()[i]))
            << point << ' ' << i;
    }
  };
  expect_surfaces(file());
  // Another sweep in the working directory does not come in between.
  fs::create_directories(parent / "other");
  fs::rename(parent / "sweep", parent / "other/moved");
  const SweepFolder trap = make(manifest);
  const HeightField wrong = make_surface({}, rows, cols, cell);
  for (std::size_t point = 0; point < 6; ++point) trap.write(point, result_of(point), "", {&wrong});
  for (const fs::path& place : {fs::path("/"), parent / "sweep", parent / "other"}) {
    SCOPED_TRACE(place);
    const WorkingDirectory here(place);
    expect_surfaces(parent / "other/moved/sweep.h5");
  }
  const WorkingDirectory here(parent / "other");
  expect_surfaces("moved/sweep.h5");
}

TEST_F(Collect, ASurfaceThatSeveralPointsShareIsStoredOnce) {
  SweepManifest manifest = grid_manifest();
  manifest.keep_surface = true;
  const SweepFolder folder = make(manifest);
  HeightField surface(rows, cols, cell);  // of noise, which no compression makes small
  for (int row = 0; row < rows; ++row)
    for (int col = 0; col < cols; ++col) surface.set(row, col, 1e-3 * std::sin(1e5 * (row * cols + col)));
  folder.write(0, result_of(0), "", {&surface});
  for (const std::size_t point : {1, 2, 3, 4, 5}) folder.write(point, result_of(point), "", {&surface, 0});
  EXPECT_LT(5 * fs::file_size(folder.point_file(1)), fs::file_size(folder.point_file(0)));
  const CollectReport report = collect(folder);
  EXPECT_EQ(report.surfaces_missing, 0u);
  const Numbers values = read_all(file(), "surface");
  for (std::size_t point = 0; point < 6; ++point)
    for (int i = 0; i < rows * cols; ++i)
      ASSERT_EQ(values[point * rows * cols + static_cast<std::size_t>(i)], surface.grid().data()[i]) << point;
  // Who removes the file that holds it learns which points have none.
  fs::remove(folder.point_file(0));
  EXPECT_EQ(collect(folder).surfaces_missing, 5u);
}

TEST_F(Collect, SurfacesThatAreMissingOrDamagedAreReportedAndReadAsNothing) {
  SweepManifest manifest = grid_manifest();
  manifest.keep_surface = true;
  const SweepFolder folder = make(manifest);
  const HeightField surface = surface_of(0);
  folder.write(0, result_of(0), "", {&surface});
  folder.write(1, result_of(1), "", {});  // whoever wrote it did not keep it
  folder.write(2, {PointVerdict::refused, "no such preset", {none, none, none}}, "", {});
  const CollectReport report = collect(folder);
  EXPECT_EQ(report.done, 2u);
  EXPECT_EQ(report.surfaces_missing, 1u);  // of those that are done
  EXPECT_NE(report.sentences.back().find("1 surface is missing"), std::string::npos)
      << report.sentences.back();
  EXPECT_NE(report.sentences.back().find("000001.h5"), std::string::npos) << report.sentences.back();
  const Numbers values = read_all(file(), "surface");
  EXPECT_EQ(values[0], surface(0, 0));
  EXPECT_TRUE(std::isnan(values[rows * cols]));
}

TEST_F(Collect, BedsThatDifferAreNotJoined) {
  SweepManifest manifest = grid_manifest();
  manifest.keep_surface = true;
  const SweepFolder folder = make(manifest);
  const HeightField one = surface_of(0), smaller(50, 90, cell);
  folder.write(0, result_of(0), "", {&one});
  folder.write(1, result_of(1), "", {&smaller});
  folder.write(2, result_of(2), "", {&one});  // as the first one again
  const CollectReport report = collect(folder);
  EXPECT_FALSE(Hdf5Reader(file()).has("surface"));
  EXPECT_NE(report.sentences.back().find("differ"), std::string::npos);
  EXPECT_EQ(report.surfaces_missing, 0u);
}

TEST_F(Collect, HugeBedsCostWhatIsInThem) {
  SweepManifest manifest = grid_manifest();
  manifest.keep_surface = true;
  const SweepFolder folder = make(manifest);
  HeightField bed(65536, 65536, cell);
  bed.set(50000, 7, 0.5);
  for (const std::size_t point : {0, 1}) folder.write(point, result_of(point), "", {&bed});
  EXPECT_EQ(collect(folder).surfaces_missing, 0u);
  EXPECT_EQ(dataset_shape(file(), "surface"), (std::vector<hsize_t>{3, 2, 65536, 65536}));
  EXPECT_LT(fs::file_size(file()), 2'000'000u);
}

/// The hash of a new folder to which all points of the grid are written in this order.
std::string hash_of(const std::vector<std::size_t>& order,
                    const std::function<void(PointResult&)>& change = {}, double change_of_surface = 0.0) {
  const TestFolder parent;
  SweepManifest manifest = grid_manifest();
  manifest.keep_surface = true;
  const SweepFolder folder = SweepFolder::make(parent / "sweep", manifest);
  for (const std::size_t point : order) {
    PointResult result = result_of(point);
    if (change && point == 4) change(result);
    HeightField surface = surface_of(point);
    if (point == 4) surface.set(60, 80, surface(60, 80) + change_of_surface);
    folder.write(point, result, "", {&surface});
  }
  return collect(folder).content_hash;
}

TEST(ContentHashOfASweep, IsOfTheContentOnly) {
  const std::vector<std::size_t> order = {0, 1, 2, 3, 4, 5};
  const std::string hash = hash_of(order);
  EXPECT_EQ(hash_of({5, 3, 1, 4, 2, 0}), hash);
  EXPECT_EQ(hash_of(order, [](PointResult& result) { result.metrics[1] = 1e9; }), hash);  // a timing
  const auto last_bit = [](std::size_t metric) {
    return [metric](PointResult& result) {
      result.metrics[metric] = std::nextafter(result.metrics[metric], 9.0);
    };
  };
  EXPECT_NE(hash_of(order, last_bit(0)), hash);
  EXPECT_NE(hash_of(order, last_bit(2)), hash);
  EXPECT_NE(hash_of(order, [](PointResult& result) { result.metrics[0] = none; }), hash);
  EXPECT_NE(hash_of(order, [](PointResult& result) { result.verdict = PointVerdict::not_at_rest; }), hash);
  EXPECT_EQ(hash_of(order, [](PointResult& result) { result.reason += " in ../x.h5"; }), hash);
  EXPECT_NE(hash_of(order, {}, 1e-300), hash);  // of a surface
  EXPECT_NE(hash_of({0, 1, 2, 3, 4}), hash);
}

TEST(ContentHashOfASweep, CountsSurfacesByTheirHeights) {
  // A tile that was touched, but is as it was, is written by some runs and not by others.
  const TestFolder parent;
  HeightField surface(300, 300, cell);
  surface.set(5, 5, 0.1);
  SweepManifest manifest = grid_manifest();
  manifest.keep_surface = true;
  std::vector<std::string> hashes;
  for (const std::string name : {"untouched", "touched"}) {
    const SweepFolder folder = SweepFolder::make(parent / name, manifest);
    folder.write(0, result_of(0), "", {&surface});
    hashes.push_back(collect(folder).content_hash);
    surface.allocate(surface.tile_count() - 1);
  }
  EXPECT_EQ(hashes[0], hashes[1]);
}

}  // namespace
}  // namespace sandstroke
