// The files that export writes, read by the programs they are for.
#include <gtest/gtest.h>
#include <signal.h>
#include <spdlog/fmt/fmt.h>

#include <cstring>
#include <optional>
#include <regex>

#include "cli/program.h"
#include "io/png_file.h"
#include "io/png_map.h"
#include "io/run_file.h"
#include "io/stroke_file.h"
#include "map_values.h"
#include "real_client.h"

namespace sandstroke {
namespace {

namespace fs = std::filesystem;
using Words = std::vector<std::string>;

/// A folder with a run, a.h5.
fs::path folder_with_run() {
  const fs::path folder = test_folder();
  const ProgramResult made = run_program({"run", "scene.toml", "-o", "a.h5", "--frames", "4"}, folder);
  EXPECT_EQ(made.exit_code, 0) << made.err;
  return folder;
}

ProgramResult export_to(const fs::path& folder, const std::string& output, const Words& options = {},
                        const std::string& run = "a.h5") {
  Words words = {"export", run, "-o", output};
  words.insert(words.end(), options.begin(), options.end());
  return run_program(words, folder);
}

void expect_export(const fs::path& folder, const std::string& output, const Words& options = {},
                   const std::string& run = "a.h5") {
  const ProgramResult result = export_to(folder, output, options, run);
  EXPECT_EQ(result.exit_code, 0) << output << result.err;
  EXPECT_EQ(result.out, output + "\n");
}

void expect_refused(const ProgramResult& result, const std::string& sentence, int exit_code = 2) {
  EXPECT_EQ(result.exit_code, exit_code) << result.err;
  EXPECT_NE(result.err.find(sentence), std::string::npos) << result.err;
}

std::string bytes_of(const HeightGrid& heights) {
  std::string bytes(static_cast<std::size_t>(heights.size()) * sizeof(double), '\0');
  std::memcpy(bytes.data(), heights.data(), bytes.size());
  return bytes;
}

TEST(CliExport, NumPyLoadsTheHeightsToTheBit) {
  SANDSTROKE_NEEDS(python_has("numpy"), "python3-numpy");
  const fs::path folder = folder_with_run();
  expect_export(folder, "a.npy");
  expect_export(folder, "a.asc");
  expect_export(folder, "a.csv");
  const auto read =
      run_child({python, "-c",
                 "import sys, numpy as np\n"
                 "folder = sys.argv[1] + '/'\n"
                 "a = np.load(folder + 'a.npy')\n"
                 "assert a.dtype == np.float64 and a.flags['C_CONTIGUOUS']\n"
                 "open(folder + 'heights', 'wb').write(a.tobytes())\n"
                 "asc = np.loadtxt(folder + 'a.asc', skiprows=6)\n"
                 "assert (asc[::-1] == a).all()\n"
                 "t = np.genfromtxt(folder + 'a.csv', delimiter=',', names=True, deletechars='')\n"
                 "open(folder + 'depths', 'wb').write(t['depth_[m]'].tobytes())\n"
                 "print(*a.shape)\n",
                 folder.string()});
  ASSERT_EQ(read->exit_code, 0) << read->err;
  EXPECT_EQ(read->out, "100 150");
  const RunFile run(folder / "a.h5");
  EXPECT_EQ(read_file(folder / "heights"), bytes_of(run.final()));
  std::string depths;
  for (const TickRecord& tick : run.trace()) {
    depths.resize(depths.size() + sizeof(double));
    std::memcpy(&depths[depths.size() - sizeof(double)], &tick.depth, sizeof(double));
  }
  EXPECT_EQ(read_file(folder / "depths"), depths);
}

TEST(CliExport, AdMeshFindsNothingToRepairInAnStl) {
  SANDSTROKE_NEEDS(run_child({"admesh", "--version"}), "admesh");
  const fs::path folder = folder_with_run();
  expect_export(folder, "a.stl", {"--base", "5"});
  const std::string found = run_child({"admesh", (folder / "a.stl").string()})->out;
  for (const char* fault : {"Total disconnected facets", "Degenerate facets", "Edges fixed", "Facets removed",
                            "Facets added", "Facets reversed", "Backwards edges", "Normals fixed"})
    EXPECT_TRUE(std::regex_search(found, std::regex(std::string(fault) + " *: *0\\b"))) << fault << found;
  EXPECT_NE(found.find("Number of parts       :     1 "), std::string::npos) << found;
  const auto value_of = [&](const std::string& name) {
    std::smatch value;
    EXPECT_TRUE(std::regex_search(found, value, std::regex(name + " *[:=] *([-0-9.]+)"))) << name << found;
    return std::stod(value[1]);
  };
  // The mesh has, in mm, the bed's size, and the sand above a floor that is 5 mm below the lowest of it.
  EXPECT_NEAR(value_of("Min X"), -150.0, 1e-3);
  EXPECT_NEAR(value_of("Max Y"), 100.0, 1e-3);
  const HeightGrid heights = 1e3 * RunFile(folder / "a.h5").final();
  EXPECT_NEAR(value_of("Min Z"), heights.minCoeff() - 5.0, 1e-3);
  EXPECT_NEAR(value_of("Max Z"), heights.maxCoeff(), 1e-3);
  const double sand = (heights - heights.minCoeff() + 5.0).sum() * 4.0;
  EXPECT_NEAR(value_of("Volume"), sand, 1e-4 * sand);
}

TEST(CliExport, AssimpReadsThePlyAndTheObj) {
  SANDSTROKE_NEEDS(run_child({"assimp", "version"}), "assimp-utils");
  const fs::path folder = folder_with_run();
  for (const char* file : {"a.ply", "a.obj"}) {
    expect_export(folder, file, {"--surface-only"});
    const std::string found = run_child({"assimp", "info", (folder / file).string()})->out;
    EXPECT_TRUE(std::regex_search(found, std::regex("Faces: +30502\\b"))) << found;  // 2 x 151 x 101
    EXPECT_NE(found.find("Minimum point      (-150.000000 -100.000000 "), std::string::npos) << found;
    EXPECT_NE(found.find("Maximum point      (150.000000 100.000000 "), std::string::npos) << found;
  }
}

TEST(CliExport, SurfacesAreThoseThatTheRunHolds) {
  const fs::path folder = folder_with_run();
  const RunFile run(folder / "a.h5");
  RunFrames frames(run);
  for (const auto& [name, surface] : {std::pair<std::string, HeightGrid>{"initial", run.initial()},
                                      {"final", run.final()},
                                      {"0", frames.surface(0).grid()},
                                      {"2", frames.surface(2).grid()}}) {
    expect_export(folder, name + ".npy", {"--frame", name});
    EXPECT_TRUE(read_file(folder / (name + ".npy")).ends_with(bytes_of(surface))) << name;
  }
  EXPECT_NE(read_file(folder / "0.npy"), read_file(folder / "2.npy"));
  expect_refused(export_to(folder, "x.npy", {"--frame", "99"}), "a.h5: has no frame 99; take 0 to 5");
  expect_refused(export_to(folder, "x.npy", {"--frame", "all"}),
                 "--frame all is not a frame; take final, initial, floor or a number");
}

/// Runs a scene that begins as this PNG; --set ... as given.
void run_from_png(const fs::path& folder, const std::string& png, const std::string& output,
                  const Words& settings = {}) {
  Words words = {
      "run", "flat.toml", "-o", output, "--set", "bed.surface.kind=file", "--set", "bed.surface.file=" + png};
  for (const std::string& setting : settings) words.insert(words.end(), {"--set", setting});
  const ProgramResult made = run_program(words, folder);
  EXPECT_EQ(made.exit_code, 0) << made.err;
}

TEST(CliExport, APngThatABedBeganAsComesOutAsItWentIn) {
  const fs::path folder = test_folder();
  write_file(folder / "flat.toml", "[bed]\nsize = [0.3, 0.2]\ncells = [150, 100]\n");
  ASSERT_EQ(run_program({"run", "flat.toml", "-o", "a.h5", "--set", "bed.surface.kind=noise", "--set",
                         "bed.surface.amplitude=0.0007", "--set", "bed.surface.wavelength=0.05"},
                        folder)
                .exit_code,
            0);
  // The range is in the file: nobody has to say it again.
  expect_export(folder, "a.png");
  run_from_png(folder, "a.png", "b.h5");
  expect_export(folder, "b.png", {}, "b.h5");
  EXPECT_EQ(read_file(folder / "b.png"), read_file(folder / "a.png"));
  const RunFile a(folder / "a.h5"), b(folder / "b.h5");
  const double step = (a.final().maxCoeff() - a.final().minCoeff()) / 65535.0;
  EXPECT_LE((a.final() - b.final()).abs().maxCoeff(), 0.5000001 * step);
  EXPECT_EQ(b.final().minCoeff(), a.final().minCoeff());
  EXPECT_EQ(b.final().maxCoeff(), a.final().maxCoeff());

  // Also one with neither black nor white in it, whether it says its range or the scene does.
  expect_export(folder, "wide.png", {"--range", "-0.02,0.03"});
  run_from_png(folder, "wide.png", "c.h5");
  expect_export(folder, "c.png", {"--frame", "initial"}, "c.h5");
  EXPECT_EQ(read_file(folder / "c.png"), read_file(folder / "wide.png"));
  std::string silent = read_file(folder / "wide.png");
  const std::size_t chunk = silent.find("tEXtHeights") - 4;
  silent.erase(chunk, silent.find("IDAT") - 4 - chunk);
  write_file(folder / "silent.png", silent);
  run_from_png(folder, "silent.png", "d.h5", {"bed.surface.low=1.0", "bed.surface.high=1.002"});
  expect_export(folder, "d.png", {}, "d.h5");
  EXPECT_TRUE(
      (values_of(*open_png_map(folder / "d.png")) == values_of(*open_png_map(folder / "silent.png"))).all());
  expect_refused(
      run_program({"run", "flat.toml", "-o", "e.h5", "--set", "bed.surface.kind=file", "--set",
                   "bed.surface.file=silent.png"},
                  folder),
      "silent.png: the picture does not say its heights, and bed.surface.low and high are both 0 m");
}

TEST(CliExport, ARangeThatIsAskedForCutsWhatIsBeyondAndSaysSo) {
  const fs::path folder = folder_with_run();
  const ProgramResult cut = export_to(folder, "a.png", {"--range", "-0.001,0.001"});
  EXPECT_EQ(cut.exit_code, 0) << cut.err;
  const HeightGrid heights = RunFile(folder / "a.h5").final();
  EXPECT_NE(
      cut.err.find(fmt::format("{} of 15000 cells are outside the range", (heights.abs() > 0.001).count())),
      std::string::npos)
      << cut.err;
  const HeightGrid gray = -0.001 + 0.002 * values_of(*open_png_map(folder / "a.png"));
  EXPECT_LE((gray - heights.max(-0.001).min(0.001)).abs().maxCoeff(), 0.002 / 65535.0);
  expect_refused(export_to(folder, "a.png", {"--range", "1,1"}), "--range 1,1 is empty");
}

TEST(CliExport, ATraceBecomesAStrokeAgain) {
  const fs::path folder = folder_with_run();
  expect_export(folder, "a.csv");
  const ProgramResult convert = run_program(
      {"stroke", "convert", "a.csv", "s.h5", "--time", "time [s]", "--time-unit", "s", "--position",
       "hand_position_x [m],hand_position_y [m],hand_position_z [m]", "--position-unit", "m", "--force",
       "device_force_x [N],device_force_y [N],device_force_z [N]", "--force-unit", "N"},
      folder);
  ASSERT_EQ(convert.exit_code, 0) << convert.err;
  const Stroke stroke = read_stroke_file(folder / "s.h5");
  const std::vector<TickRecord> ticks = RunFile(folder / "a.h5").trace();
  ASSERT_EQ(stroke.size(), ticks.size());
  for (std::size_t i = 0; i < ticks.size(); ++i) {
    ASSERT_EQ(stroke.time[i], ticks[i].time);
    ASSERT_EQ(stroke.position[i], ticks[i].hand.position);
    ASSERT_EQ(stroke.force[i], ticks[i].device_force);
  }
}

TEST(CliExport, RefusesWhatItCannotWriteOrWouldIgnore) {
  const fs::path folder = folder_with_run();
  for (const char* name : {"a", "a.txt", "a.h5x", "a.tif"})
    expect_refused(export_to(folder, name),
                   std::string(name) +
                       ": unknown file name ending; use one of .png, .npy, .asc, .stl, .ply, .obj, .csv");
  expect_refused(export_to(folder, "a.npy", {"--base", "2"}), "--base works only for triangles");
  expect_refused(export_to(folder, "a.png", {"--surface-only"}), "--surface-only works only for triangles");
  expect_refused(export_to(folder, "a.csv", {"--frame", "initial"}), "--frame works only for surfaces");
  expect_refused(export_to(folder, "a.stl", {"--range", "0,1"}), "--range works only for PNG files");
  expect_refused(export_to(folder, "a.stl", {"--base", "0"}), "--base");
  expect_refused(export_to(folder, "a.stl", {}, "scene.toml"), "scene.toml: is a scene, not a run file");
  write_file(folder / "still.toml", "[bed]\ncells = [20, 20]\n");
  ASSERT_EQ(run_program({"run", "still.toml", "-o", "still.h5"}, folder).exit_code, 0);
  expect_refused(export_to(folder, "still.csv", {}, "still.h5"), "still.h5: has no trace; run a scene");
  // A picture is no height map, nor the other way round.
  ASSERT_EQ(run_program({"render", "a.h5", "-o", "p.png"}, folder).exit_code, 0);
  expect_refused(export_to(folder, "p.png"), "p.png: already exists and is not a height map");
  expect_export(folder, "P.PNG");
  expect_refused(run_program({"render", "a.h5", "-o", "P.PNG"}, folder),
                 "already exists and is not a picture");
}

TEST(CliExport, MoreThanAFormatCanCountIsRefusedAtOnce) {
  const fs::path folder = test_folder();
  write_file(folder / "huge.toml", "[bed]\nsize = [65.536, 65.536]\ncells = [65536, 65536]\n");
  ASSERT_EQ(run_program({"run", "huge.toml", "-o", "a.h5"}, folder).exit_code, 0);
  expect_refused(export_to(folder, "a.stl"),
                 "a.stl: 65536 x 65536 cells need 8590983182 triangles, but an STL file holds at most "
                 "4294967295; export heights (.npy)");
  expect_refused(export_to(folder, "a.ply"), "vertices, but a PLY file holds at most 2147483647");
  EXPECT_EQ(std::distance(fs::directory_iterator(folder), fs::directory_iterator()), 5);  // and the XDMF file
}

TEST(CliExport, WhatIsStoppedLeavesNothing) {
  const fs::path folder = test_folder();
  write_file(folder / "large.toml", "[bed]\nsize = [1.0, 1.0]\ncells = [1000, 1000]\n");
  ASSERT_EQ(run_program({"run", "large.toml", "-o", "a.h5"}, folder).exit_code, 0);
  for (const char* name : {"a.obj", "a.asc"}) {
    const fs::path part = folder / (std::string(name) + ".part");
    const ProgramResult stopped = run_program(
        {"export", "a.h5", "-o", name}, folder,
        {.signal = SIGINT, .when = [&] { return fs::exists(part) && fs::file_size(part) > 10'000; }});
    EXPECT_EQ(stopped.exit_code, 128 + SIGINT) << stopped.err;
    EXPECT_FALSE(fs::exists(part) || fs::exists(folder / name));
  }
}

}  // namespace
}  // namespace sandstroke
