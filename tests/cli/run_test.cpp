#include <fcntl.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <spdlog/fmt/fmt.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cmath>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <thread>
#include <utility>

#include "cli/program.h"
#include "core/output_file.h"
#include "hdf5/hdf5_reader.h"
#include "io/run_file.h"
#include "io/stroke_file.h"
#include "sanitized.h"
#include "test_folder.h"

namespace sandstroke {
namespace {

namespace fs = std::filesystem;

TEST(CliRun, WritesARunFileXdmfAndPicture) {
  const fs::path folder = test_folder();
  const ProgramResult run = run_program({"run", "scene.toml", "-o", "a.h5", "--png", "a.png"}, folder);
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_TRUE(RunFile(folder / "a.h5").complete());
  EXPECT_TRUE(fs::exists(folder / "a.xdmf"));
  EXPECT_GT(fs::file_size(folder / "a.png"), 1000u);
  EXPECT_NE(run.out.find("volume drift"), std::string::npos);
  EXPECT_NE(run.out.find("for ParaView       a.xdmf\n"), std::string::npos) << run.out;
  EXPECT_NE(run.out.find("picture            a.png\n"), std::string::npos) << run.out;
}

TEST(CliRun, GoesOnFromItsOwnRunInOneCommand) {
  const fs::path folder = test_folder();
  fs::create_directory(folder / "rippled");
  write_file(folder / "rippled/line.toml", read_file(folder / "line.toml"));
  write_file(folder / "rippled/scene.toml", read_file(folder / "scene.toml") +
                                                "[bed.surface]\nkind = \"ripples\"\namplitude = 0.002\n"
                                                "wavelength = 0.05\n");
  ASSERT_EQ(run_program({"run", "rippled/scene.toml", "-o", "a.h5"}, folder).exit_code, 0);
  // The run file is in this folder, not beside the scene.
  const ProgramResult next = run_program({"run", "rippled/scene.toml", "--set", "bed.surface.kind=file",
                                          "--set", "bed.surface.file=a.h5", "-o", "b.h5"},
                                         folder);
  ASSERT_EQ(next.exit_code, 0) << next.err;
  EXPECT_NE(next.err.find("rippled/scene.toml: bed.surface.amplitude, bed.surface.wavelength are left out, "
                          "because they apply only where bed.surface.kind is noise or ripples"),
            std::string::npos)
      << next.err;
  EXPECT_TRUE((RunFile(folder / "b.h5").initial() == RunFile(folder / "a.h5").final()).all());
  // Its own scene has what was read.
  EXPECT_EQ(run_program({"info", "--scene", "b.h5"}, folder).out.find("amplitude"), std::string::npos);
  const ProgramResult bare = run_program({"run", "scene.toml", "--unset", "stroke", "-o", "c.h5"}, folder);
  EXPECT_EQ(bare.exit_code, 0) << bare.err;
  EXPECT_FALSE(RunFile(folder / "c.h5").has_trace());
  const ProgramResult wrong = run_program({"run", "scene.toml", "--unset", "strike"}, folder);
  EXPECT_EQ(wrong.exit_code, 2);
  EXPECT_NE(wrong.err.find("--unset strike: scene.toml has no such key"), std::string::npos) << wrong.err;
}

TEST(CliRun, ARunThatOnlyRelaxesSaysThatItKeepsNoFrames) {
  const fs::path folder = test_folder();
  write_file(folder / "scene.toml", "[bed]\nsize = [0.3, 0.2]\ncells = [60, 40]\n");
  const auto run = [&](std::vector<std::string> words) {
    words.insert(words.begin(), {"run", "scene.toml"});
    return run_program(words, folder);
  };
  const ProgramResult result = run({"-o", "a.h5", "--frames", "20"});
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_NE(result.err.find("no source, so the run keeps no frames"), std::string::npos) << result.err;
  EXPECT_TRUE(RunFile(folder / "a.h5").frame_times().empty());
  EXPECT_EQ(run({"-o", "b.h5"}).err.find("frames"), std::string::npos);
  const ProgramResult film = run({"-o", "c.h5", "--frames", "20", "--video", "c.mp4"});
  EXPECT_EQ(film.exit_code, 2);
  EXPECT_NE(film.err.find("this scene has none: it has no stroke"), std::string::npos) << film.err;
  EXPECT_FALSE(fs::exists(folder / "c.h5"));
}

TEST(CliRun, StrictEndsWithCode3WhereThereIsAWarningWhoseWordJsonGives) {
  const fs::path folder = test_folder();
  struct Doubt {
    std::vector<std::string> settings;
    std::string word, section;
  };
  for (const Doubt& doubt :
       {Doubt{{"stroke.offset=[0, 0, 0.02]"}, "nothing-touched", "stroke"},
        Doubt{{"bed.surface.kind=cliff", "relaxation.max_passes=1"}, "not-at-rest", "relaxation"},
        Doubt{{"force.law=rft", "force.friction_angle=50"}, "force-theory", "force"},
        Doubt{{"stroke.offset=[0, 0, -0.5]"}, "stroke-deep", "stroke"}}) {
    std::vector<std::string> arguments = {"run", "scene.toml", "--json"};
    for (const std::string& setting : doubt.settings) {
      arguments.emplace_back("--set");
      arguments.push_back(setting);
    }
    const nlohmann::json json = nlohmann::json::parse(run_program(arguments, folder).out);
    const auto found = std::find_if(json["warnings"].begin(), json["warnings"].end(),
                                    [&](const nlohmann::json& one) { return one["code"] == doubt.word; });
    ASSERT_NE(found, json["warnings"].end()) << json["warnings"];
    EXPECT_EQ((*found)["section"], doubt.section);
    arguments.emplace_back("--strict");
    const ProgramResult strict = run_program(arguments, folder);
    EXPECT_EQ(strict.exit_code, 3);
    EXPECT_NE(strict.err.find(" [" + doubt.section + ": " + doubt.word + "]\n"), std::string::npos)
        << strict.err;
    EXPECT_NE(strict.err.find(doubt.word + " ([" + doubt.section + "])"), std::string::npos) << strict.err;
    EXPECT_NE(strict.err.find((*found)["text"].get<std::string>()), std::string::npos) << strict.err;
  }
  const ProgramResult fine =
      run_program({"run", "scene.toml", "--json", "--strict", "--set", "model.preset=accurate"}, folder);
  EXPECT_EQ(fine.exit_code, 0) << fine.err;
  EXPECT_TRUE(nlohmann::json::parse(fine.out)["warnings"].empty()) << fine.out;
  // What was left out makes no result doubtful.
  write_file(folder / "rippled.toml",
             read_file(folder / "scene.toml") +
                 "[bed.surface]\nkind = \"ripples\"\namplitude = 0.001\nwavelength = 0.05\n");
  const ProgramResult flat = run_program(
      {"run", "rippled.toml", "--strict", "--set", "model.preset=accurate", "--set", "bed.surface.kind=flat"},
      folder);
  EXPECT_EQ(flat.exit_code, 0) << flat.err;
  EXPECT_NE(flat.err.find("are left out"), std::string::npos) << flat.err;
}

/// Pipes without an end to wait for: each has a writer that gives it a file.
TEST(CliRun, TakesPipesInPlaceOfFilesOrSaysThatItCannot) {
  const fs::path folder = test_folder();
  std::string table = "time [s],x [m],y [m],z [m]\n";
  for (int i = 0; i <= 200; ++i) table += fmt::format("{},{},0,-0.004\n", 0.002 * i, 0.0005 * i - 0.05);
  write_file(folder / "table.csv", table);
  ASSERT_EQ(run_program({"run", "scene.toml", "--stroke", "table.csv", "-o", "plain.h5"}, folder).exit_code,
            0);
  const RunFile plain(folder / "plain.h5");
  const auto with_pipe = [&](const std::string& name, const std::string& content,
                             std::vector<std::string> arguments) {
    const fs::path pipe = folder / name;
    fs::remove(pipe);
    EXPECT_EQ(mkfifo(pipe.c_str(), 0600), 0);
    std::jthread writer([&] {
      const int end = open(pipe.c_str(), O_WRONLY | O_CLOEXEC);
      for (std::size_t at = 0; end >= 0 && at < content.size();) {
        const ssize_t count = write(end, content.data() + at, content.size() - at);
        if (count <= 0) break;
        at += static_cast<std::size_t>(count);
      }
      if (end >= 0) close(end);
    });
    const ProgramResult result = run_program(arguments, folder);
    close(open(pipe.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC));  // so that a writer whom nobody heard ends
    return result;
  };
  for (const std::string name : {"pipe", "pipe.csv"}) {
    const ProgramResult run =
        with_pipe(name, table, {"run", "scene.toml", "--stroke", name, "-o", "piped.h5"});
    ASSERT_EQ(run.exit_code, 0) << run.err;
    EXPECT_TRUE((RunFile(folder / "piped.h5").final() == plain.final()).all());
  }
  ProgramResult run = with_pipe("script.toml", read_file(folder / "line.toml"),
                                {"run", "scene.toml", "--stroke", "script.toml", "-o", "piped.h5"});
  EXPECT_EQ(run.exit_code, 0) << run.err;
  run = with_pipe("scene-pipe", read_file(folder / "scene.toml"), {"run", "scene-pipe", "-o", "piped.h5"});
  EXPECT_EQ(run.exit_code, 0) << run.err;
  // Pipes without a name, as of a shell's <(command): the files of a scene are in the current folder.
  const auto through_stdin = [&](const std::string& content) {
    return Conditions{.in_child = [content] {
      int ends[2];
      if (pipe(ends) != 0) return;
      dup2(ends[0], STDIN_FILENO);
      if (write(ends[1], content.data(), content.size()) < 0) return;  // it fits into the pipe
      close(ends[1]);
    }};
  };
  run = run_program({"run", "scene.toml", "--stroke", "/dev/stdin", "-o", "piped.h5"}, folder,
                    through_stdin(table));
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_TRUE((RunFile(folder / "piped.h5").final() == plain.final()).all());
  run = run_program({"run", "/dev/stdin", "-o", "piped.h5"}, folder,
                    through_stdin(read_file(folder / "scene.toml")));
  EXPECT_EQ(run.exit_code, 0) << run.err;
  for (const std::vector<std::string>& settings :
       std::vector<std::vector<std::string>>{{"bed.surface.kind=file", "bed.surface.file=p.h5"},
                                             {"tool.shape=mesh", "tool.file=p.h5"},
                                             {"model.plugin=p.h5", "model.force=f"}}) {
    std::vector<std::string> arguments = {"run", "scene.toml", "--set", "displacement.deposit=outward"};
    for (const std::string& setting : settings) arguments.insert(arguments.end(), {"--set", setting});
    run = with_pipe("p.h5", "", arguments);
    EXPECT_TRUE(run.exit_code == 2 || run.exit_code == 4) << run.exit_code;
    EXPECT_NE(run.err.find("p.h5: "), std::string::npos) << run.err;
  }
}

TEST(CliRun, JsonIsOneObjectWithTheDesignsNames) {
  const fs::path folder = test_folder();
  const ProgramResult run = run_program({"run", "scene.toml", "--json", "--threads", "2"}, folder);
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const nlohmann::json json = nlohmann::json::parse(run.out);
  for (const char* name : {"wall_seconds", "ticks", "real_time_factor", "passes", "residual",
                           "volume_initial", "volume_final", "volume_drift", "moved_volume", "max_force",
                           "cells_visited", "tiles_active_max", "converged", "threads"})
    EXPECT_TRUE(json.contains(name)) << name;
  EXPECT_TRUE(json["converged"]);
  EXPECT_EQ(json["threads"], std::min(2u, std::thread::hardware_concurrency()));
  EXPECT_LE(json["volume_drift"], 1e-12);
  EXPECT_TRUE(fs::exists(folder / "scene.h5"));  // the default name
}

TEST(CliRun, JsonSaysWhatTheRunFileHolds) {
  const fs::path folder = test_folder();
  const ProgramResult run =
      run_program({"run", "scene.toml", "-o", "a.h5", "--json", "--set", "device.model=dynamic", "--set",
                   "device.delay=3", "--set", "device.max_force=2", "--set", "stroke.depth=0.004"},
                  folder);
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const nlohmann::json json = nlohmann::json::parse(run.out);
  const RunFile file(folder / "a.h5");
  double max_force = 0.0, contact_force = 0.0, max_depth = 0.0, displaced = 0.0, least_margin = HUGE_VAL;
  std::int64_t contact = 0, saturated = 0;
  const std::vector<TickRecord> trace = file.trace();
  for (const TickRecord& tick : trace) {
    max_force = std::max(max_force, tick.device_force.norm());
    displaced += tick.displaced_volume;
    saturated += tick.saturated;
    if (!tick.contact) continue;
    ++contact;
    contact_force += tick.device_force.norm();
    max_depth = std::max(max_depth, tick.depth);
    least_margin = std::min(least_margin, tick.passivity_margin);
  }
  ASSERT_GT(saturated, 0);
  EXPECT_EQ(json["output"], "a.h5");
  EXPECT_EQ(json["preset"], "paper");
  EXPECT_EQ(json["ticks"], trace.size());
  EXPECT_NEAR(json["simulated_seconds"], trace.back().time + 1e-3, 1e-9);
  EXPECT_NEAR(json["real_time_factor"].get<double>() * json["wall_seconds"].get<double>(),
              json["simulated_seconds"].get<double>(), 1e-9);
  EXPECT_NEAR(json["process_real_time_factor"].get<double>() * json["process_seconds"].get<double>(),
              json["simulated_seconds"].get<double>(), 1e-9);
  EXPECT_GT(json["process_seconds"], json["wall_seconds"]);
  EXPECT_EQ(json["contact_ticks"], contact);
  EXPECT_EQ(json["saturated_ticks"], saturated);
  EXPECT_EQ(json["gaps"], 0);
  EXPECT_NEAR(json["max_force"], max_force, 1e-12);
  EXPECT_NEAR(json["mean_force"], contact_force / static_cast<double>(contact), 1e-12);
  EXPECT_EQ(json["max_depth"], max_depth);
  EXPECT_EQ(json["least_passivity_margin"], least_margin);
  EXPECT_NEAR(json["displaced_volume"], displaced, 1e-12 * displaced);

  const Hdf5Reader plain(folder / "a.h5");
  double passes = 0.0, relaxed = 0.0;
  for (const double one : plain.doubles("/relaxation/passes")) passes += one;
  for (const double one : plain.doubles("/relaxation/moved_volume")) relaxed += one;
  EXPECT_EQ(json["passes"], passes);
  EXPECT_EQ(json["relaxations"], plain.doubles("/relaxation/time").size());
  EXPECT_EQ(json["residual"], plain.doubles("/relaxation/residual").back());
  EXPECT_NEAR(json["moved_volume"], relaxed + displaced, 1e-12 * relaxed);
  const double area = file.cell_size() * file.cell_size();
  EXPECT_NEAR(json["volume_initial"], file.initial().sum() * area, 1e-12);
  EXPECT_NEAR(json["volume_final"], file.final().sum() * area, 1e-12);
  EXPECT_EQ(json["furrow_depth"], plain.number_attribute("/surface/final", "furrow_depth"));
  EXPECT_EQ(json["asked_depth"], plain.number_attribute("/surface/final", "asked_depth"));
  EXPECT_EQ(json["instruction_set"], plain.text_attribute("/provenance", "instruction_set"));
  EXPECT_EQ(json["threads"], plain.number_attribute("/provenance", "threads"));
  EXPECT_FALSE(json["interrupted"]);
  EXPECT_FALSE(json.contains("recorded_force"));
  EXPECT_FALSE(json.contains("error_estimate"));
}

TEST(CliRun, SaysHowDeepAFurrowWasAskedForAndIsLeft) {
  const fs::path folder = test_folder();
  const auto run = [&](const std::string& preset, const std::string& name) {
    return run_program(
        {"run", "scene.toml", "-o", name, "--set", "model.preset=" + preset, "--set", "stroke.depth=0.004"},
        folder);
  };
  const ProgramResult paper = run("paper", "paper.h5"), accurate = run("accurate", "accurate.h5");
  ASSERT_EQ(paper.exit_code, 0) << paper.err;
  ASSERT_EQ(accurate.exit_code, 0) << accurate.err;
  EXPECT_NE(paper.out.find("model              preset paper\n"), std::string::npos) << paper.out;
  EXPECT_NE(paper.err.find("model.preset = \"accurate\" does"), std::string::npos) << paper.err;
  EXPECT_NE(accurate.out.find("model              preset accurate\n"), std::string::npos) << accurate.out;
  EXPECT_NE(accurate.out.find("furrow  "), std::string::npos) << accurate.out;
  EXPECT_EQ(accurate.err.find("the stroke asked for"), std::string::npos) << accurate.err;
  const Hdf5Reader file(folder / "accurate.h5");
  const double asked = file.number_attribute("/surface/final", "asked_depth"),
               left = file.number_attribute("/surface/final", "furrow_depth");
  EXPECT_NEAR(asked, 0.008, 1e-6);
  EXPECT_GT(left, 0.5 * asked);
  EXPECT_LT(left, asked);
}

TEST(CliRun, TheDefaultNameNeverCostsAnotherScenesRun) {
  const fs::path folder = test_folder();
  fs::create_directory(folder / "other");
  fs::copy_file(folder / "line.toml", folder / "other/line.toml");
  write_file(folder / "other/scene.toml", read_file(folder / "scene.toml") + "[force]\nk_s = 500\n");
  ASSERT_EQ(run_program({"run", "scene.toml"}, folder).exit_code, 0);
  const std::string first = read_file(folder / "scene.h5");

  const ProgramResult other = run_program({"run", "other/scene.toml"}, folder);
  EXPECT_EQ(other.exit_code, 2);
  EXPECT_EQ(
      other.err,
      "sandstroke: scene.h5: holds the run of another scene (scene.toml); choose another file with -o, or "
      "name this one with -o to replace it\n");
  EXPECT_EQ(read_file(folder / "scene.h5"), first);

  // Again, with other settings, and from elsewhere: the same scene.
  EXPECT_EQ(run_program({"run", "scene.toml", "--set", "force.k_s=600"}, folder).exit_code, 0);
  EXPECT_EQ(run_program({"run", fs::absolute(folder / "scene.toml").string()}, folder).exit_code, 0);
  fs::create_directory(folder / "moved");
  for (const char* name : {"scene.toml", "line.toml", "scene.h5"})
    fs::rename(folder / name, folder / "moved" / name);
  EXPECT_EQ(run_program({"run", "scene.toml", "--set", "force.k_s=700"}, folder / "moved").exit_code, 0);
  // Asked for by name.
  EXPECT_EQ(run_program({"run", "../other/scene.toml", "-o", "scene.h5"}, folder / "moved").exit_code, 0);
}

TEST(CliRun, TheDefaultNameNeverCostsAFileThatIsNoRun) {
  const fs::path folder = test_folder();
  ASSERT_EQ(run_program({"stroke", "script", "line.toml", "scene.h5"}, folder).exit_code, 0);
  const std::string stroke = read_file(folder / "scene.h5");
  EXPECT_EQ(run_program({"run", "scene.toml"}, folder).exit_code, 2);
  EXPECT_EQ(read_file(folder / "scene.h5"), stroke);
}

TEST(CliRun, SetOverridesSceneKeys) {
  const fs::path folder = test_folder();
  const ProgramResult run =
      run_program({"run", "scene.toml", "-o", "a.h5", "--set", "relaxation.law=isotropic", "--set",
                   "force.k_s=500", "--frames", "10"},
                  folder);
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const RunFile file(folder / "a.h5");
  EXPECT_NE(file.scene_text().find("law = \"isotropic\""), std::string::npos);
  EXPECT_NE(file.scene_text().find("k_s = 500.0"), std::string::npos);
  EXPECT_GT(file.frame_times().size(), 3u);
}

TEST(CliRun, AnotherStrokeCanBePlayed) {
  const fs::path folder = test_folder();
  write_file(folder / "other.toml",
             "start = [0.0, -0.05]\n[[segment]]\nkind = \"line\"\nto = [0.0, 0.05]\ndepth = 0.002\n");
  ASSERT_EQ(run_program({"run", "scene.toml", "-o", "a.h5", "--stroke", "other.toml"}, folder).exit_code, 0);
  for (const TickRecord& tick : RunFile(folder / "a.h5").trace())
    EXPECT_NEAR(tick.hand.position.x(), 0.0, 1e-12);
}

TEST(CliRun, ARunThatIsNotAtRestSaysSoAndExitsWith3) {
  const fs::path folder = test_folder();
  const ProgramResult run =
      run_program({"run", "scene.toml", "-o", "a.h5", "--set", "relaxation.max_passes=0"}, folder);
  EXPECT_EQ(run.exit_code, 3);
  EXPECT_NE(run.err.find("not at rest"), std::string::npos);
  EXPECT_TRUE(RunFile(folder / "a.h5").complete());
}

/// A folder with a stroke that takes minutes: slow, and with a tool that covers many cells.
fs::path folder_with_slow_stroke() {
  const fs::path folder = test_folder();
  write_file(folder / "scene.toml",
             "[bed]\nsize = [0.3, 0.2]\ncells = [1200, 800]\n[tool]\nradius = 0.02\n[stroke]\nfile = "
             "\"line.toml\"\n");
  write_file(folder / "long.toml",
             "start = [-0.05, 0.0]\nspeed = 0.0001\n[[segment]]\nkind = \"line\"\nto = [0.05, 0.0]\ndepth = "
             "0.004\n");
  return folder;
}

/// Sends the signal once ticks have been written: between two flushes, for within one HDF5 writes over its
/// own bookkeeping, and what a kill leaves then may be unreadable.
Conditions stopped_on_its_way(int signal, const fs::path& folder) {
  Conditions stopped{signal};
  stopped.when = [part = folder / "a.h5.part", bytes = std::uintmax_t{0}, unchanged = 0]() mutable {
    const std::uintmax_t now = fs::exists(part) ? fs::file_size(part) : 0;
    unchanged = std::exchange(bytes, now) == now ? unchanged + 1 : 0;
    return bytes > 1'000'000 && unchanged > 20;
  };
  return stopped;
}

TEST(CliRun, StoppedBySignalItKeepsWhatIsCompleteAndMarksItSo) {
  for (const int signal : {SIGINT, SIGTERM}) {
    const fs::path folder = folder_with_slow_stroke();
    const ProgramResult run =
        run_program({"run", "scene.toml", "-o", "a.h5", "--stroke", "long.toml", "--json"}, folder,
                    stopped_on_its_way(signal, folder));
    EXPECT_EQ(run.exit_code, 128 + signal) << run.err;
    EXPECT_FALSE(fs::exists(folder / "a.h5"));
    EXPECT_EQ(nlohmann::json::parse(run.out)["output"], "a.h5.part");
    const RunFile part(folder / "a.h5.part");
    EXPECT_FALSE(part.complete());
    EXPECT_GT(part.trace().size(), 100u);
    const ProgramResult render = run_program({"render", "a.h5.part", "-o", "a.png"}, folder);
    EXPECT_EQ(render.exit_code, 2);
    EXPECT_NE(render.err.find("cut off"), std::string::npos) << render.err;
    EXPECT_EQ(render.err.find("take a frame"), std::string::npos) << "there is none: " << render.err;
    const ProgramResult report = run_program({"report", "a.h5.part", "-o", "a.html"}, folder);
    EXPECT_EQ(report.exit_code, 0) << report.err;
    EXPECT_NE(read_file(folder / "a.html").find("was cut off; the page shows its initial surface"),
              std::string::npos);
  }
}

TEST(CliRun, ASceneThatNobodyWritesIsNotWaitedForAfterASignal) {
  const fs::path folder = test_folder();
  ASSERT_EQ(mkfifo((folder / "fifo").c_str(), 0600), 0);
  int writer = -1;
  Conditions stopped{SIGTERM};
  stopped.when = [&] {  // there is somebody to read it
    writer = open((folder / "fifo").c_str(), O_WRONLY | O_NONBLOCK | O_CLOEXEC);
    return writer >= 0;
  };
  stopped.in_child = [] { alarm(600); };  // one that would wait for ever
  EXPECT_EQ(run_program({"run", "fifo", "-o", "a.h5"}, folder, stopped).exit_code, 128 + SIGTERM);
  close(writer);
}

/// The standard output or error is a pipe that nobody reads.
std::function<void()> nobody_reads(int descriptor) {
  return [descriptor] {
    int ends[2];
    if (pipe(ends) == 0) {
      dup2(ends[1], descriptor);
      close(ends[0]);
      close(ends[1]);
    }
  };
}

TEST(CliRun, WhoseWarningsNobodyReadsItIsDoneAllTheSame) {
  const fs::path folder = test_folder();
  const std::vector<std::string> too_deep = {"run",  "scene.toml", "-o",
                                             "a.h5", "--set",      "stroke.offset=[0, 0, -0.1]"};
  ASSERT_NE(run_program(too_deep, folder).err, "");
  fs::remove(folder / "a.h5");
  const ProgramResult run = run_program(too_deep, folder, {.in_child = nobody_reads(STDERR_FILENO)});
  EXPECT_EQ(run.exit_code, 0);
  EXPECT_TRUE(RunFile(folder / "a.h5").complete());
}

TEST(CliRun, WhoseOutputNobodyReadsItEndsQuietlyAsOthersDo) {
  const fs::path folder = test_folder();
  for (const std::vector<std::string>& command :
       {std::vector<std::string>{"help", "scene"}, {"run", "--help"}, {"run", "scene.toml", "-o", "a.h5"}}) {
    const ProgramResult result = run_program(command, folder, {.in_child = nobody_reads(STDOUT_FILENO)});
    EXPECT_EQ(result.exit_code, 128 + SIGPIPE) << command.back();
    EXPECT_EQ(result.err, "");
  }
  EXPECT_TRUE(RunFile(folder / "a.h5").complete());
}

TEST(CliRun, KilledItLeavesWhatWasFlushedAndNothingThatLooksComplete) {
  const fs::path folder = folder_with_slow_stroke();
  run_program({"run", "scene.toml", "-o", "a.h5", "--stroke", "long.toml"}, folder,
              stopped_on_its_way(SIGKILL, folder));
  EXPECT_FALSE(fs::exists(folder / "a.h5"));
  const RunFile part(folder / "a.h5.part");
  EXPECT_FALSE(part.complete());
  EXPECT_GT(part.trace().size(), 100u);
}

TEST(CliRun, ASecondRunCannotWriteTheSameFile) {
  const fs::path folder = folder_with_slow_stroke();
  const fs::path other = folder / "other";
  fs::create_directory(other);
  ProgramResult second;
  Conditions meanwhile = stopped_on_its_way(SIGINT, folder);
  meanwhile.when = [&, going_on = meanwhile.when] {
    if (!going_on()) return false;
    second = run_program({"run", "../scene.toml", "-o", "../a.h5"}, other);
    return true;
  };
  const ProgramResult first =
      run_program({"run", "scene.toml", "-o", "a.h5", "--stroke", "long.toml"}, folder, meanwhile);
  EXPECT_EQ(second.exit_code, 4);
  EXPECT_NE(second.err.find("another process"), std::string::npos) << second.err;
  EXPECT_EQ(first.exit_code, 130);
  EXPECT_GT(RunFile(folder / "a.h5.part").trace().size(), 100u);
}

TEST(CliRun, AFullDiskIsAnErrorAndLeavesNothingThatLooksComplete) {
  if (threads_sanitized) GTEST_SKIP() << "the sanitizer's own memory is a file";
  const fs::path folder = test_folder();
  for (const std::size_t kilobytes : {1, 30, 100, 200, 250}) {
    const ProgramResult run =
        run_program({"run", "scene.toml", "-o", "a.h5"}, folder, {0, 0, kilobytes * 1024});
    EXPECT_EQ(run.exit_code, 4) << kilobytes << " kB: " << run.err;
    EXPECT_NE(run.err.find("a.h5"), std::string::npos) << run.err;
    EXPECT_FALSE(fs::exists(folder / "a.h5"));
    EXPECT_FALSE(fs::exists(folder / "a.xdmf"));
  }
}

TEST(CliRun, ResultsThatCannotBePrintedAreAnError) {
  const fs::path folder = test_folder();
  EXPECT_EQ(
      run_program({"run", "scene.toml", "-o", "a.h5", "--json"}, folder, {0, 0, 0, "/dev/full"}).exit_code,
      4);
  for (const std::vector<std::string>& command :
       {std::vector<std::string>{"info", "a.h5"}, {"help", "scene"}, {"run", "--help"}}) {
    const ProgramResult result = run_program(command, folder, {.out = "/dev/full"});
    EXPECT_EQ(result.exit_code, 4) << command.back();
    EXPECT_NE(result.err.find("standard output"), std::string::npos) << result.err;
  }
}

TEST(CliRun, AGapOfYearsIsToldAndTakesNeitherTimeNorRoom) {
  const fs::path folder = test_folder();
  Stroke stroke;
  for (const double begin : {0.0, 1e9})
    for (int i = 0; i < 4; ++i) {
      stroke.time.push_back(begin + 0.05 * i);
      stroke.position.emplace_back(0.01 * i, 0.0, -0.004);
    }
  write_stroke_file(folder / "years.h5", stroke);
  const std::vector<std::string> years = {"run", "scene.toml", "--stroke", "years.h5", "-o", "a.h5"};
  const ProgramResult run = run_program(years, folder);
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_NE(run.err.find("samples cover"), std::string::npos) << run.err;
  EXPECT_LT(fs::file_size(folder / "a.h5"), 3'000'000u);
  EXPECT_NE(run_program({"stroke", "info", "years.h5"}, folder).err.find("samples cover"), std::string::npos);

  // A device that still swings has no ticks to leave out: they have no room.
  std::vector<std::string> swinging = years;
  swinging.insert(swinging.end(), {"--set", "device.model=dynamic"});
  fs::remove(folder / "a.h5");
  const ProgramResult refused = run_program(swinging, folder);
  EXPECT_EQ(refused.exit_code, 4) << refused.err;
  EXPECT_NE(refused.err.find("a.h5: takes about"), std::string::npos) << refused.err;
  EXPECT_FALSE(fs::exists(folder / "a.h5.part"));
}

TEST(CliRun, NoOutputMayBeAnInputOrAnotherOutput) {
  const fs::path folder = test_folder();
  ASSERT_EQ(run_program({"stroke", "script", "line.toml", "scene.h5"}, folder).exit_code, 0);
  const std::string recording = read_file(folder / "scene.h5"), scene = read_file(folder / "scene.toml");
  const std::vector<std::vector<std::string>> attempts = {
      {"run", "scene.toml", "--stroke", "scene.h5"},  // the default output's name
      {"run", "scene.toml", "-o", "scene.toml"},
      {"run", "scene.toml", "-o", "line.toml"},
      {"run", "scene.toml", "-o", "a.h5", "--png", "scene.toml"},
      {"run", "scene.toml", "-o", "a.h5", "--png", "./a.h5"},
      {"run", "scene.toml", "-o", "a.h5", "--png", "a.xdmf"},
      {"render", "scene.h5", "-o", "scene.h5"},
      {"stroke", "script", "line.toml", "line.toml"}};
  for (const auto& attempt : attempts) EXPECT_EQ(run_program(attempt, folder).exit_code, 2) << attempt.back();
  EXPECT_EQ(read_file(folder / "scene.h5"), recording);
  EXPECT_EQ(read_file(folder / "scene.toml"), scene);
  EXPECT_FALSE(fs::exists(folder / "a.h5"));
}

TEST(CliRun, ADottedNameKeepsItsDots) {
  const fs::path folder = test_folder();
  ASSERT_EQ(run_program({"run", "scene.toml", "-o", "run-27.5"}, folder).exit_code, 0);
  EXPECT_TRUE(fs::exists(folder / "run-27.5.xdmf"));
}

TEST(CliRun, ALoopThatDivergesSaysWhereAndExitsWith3) {
  const fs::path folder = test_folder();
  const ProgramResult device =
      run_program({"run", "scene.toml", "-o", "a.h5", "--set", "device.model=dynamic", "--set",
                   "device.preset=ideal", "--set", "force.k_f=1e6"},
                  folder);
  EXPECT_EQ(device.exit_code, 3) << device.err;
  EXPECT_NE(device.err.find("diverged"), std::string::npos) << device.err;
  const ProgramResult force = run_program(
      {"run", "scene.toml", "-o", "a.h5", "--set", "force.k_c=1e6", "--set", "device.max_force=0"}, folder);
  EXPECT_EQ(force.exit_code, 3) << force.err;
  EXPECT_NE(force.err.find("force.k_c"), std::string::npos) << force.err;
  EXPECT_FALSE(fs::exists(folder / "a.h5"));
}

TEST(CliRun, NumbersBeyondAnyEndItAlsoWhereTheDevicesForceIsLimited) {
  const fs::path folder = test_folder();
  const ProgramResult run =
      run_program({"run", "scene.toml", "-o", "a.h5", "--set", "force.k_c=1e6"}, folder);
  EXPECT_EQ(run.exit_code, 3) << run.err;
  EXPECT_NE(run.err.find("too large for a number; lower force.k_s, force.k_c"), std::string::npos) << run.err;
  EXPECT_FALSE(fs::exists(folder / "a.h5"));
}

TEST(CliRun, ALateLoopThatReturnsEnergySaysSoAndAPassiveOneDoesNot) {
  const fs::path folder = test_folder();
  const auto run = [&](const char* delay) {
    return run_program({"run", "scene.toml", "-o", "a.h5", "--set", "device.model=dynamic", "--set",
                        "force.k_f=0.0", "--set", "stroke.depth=0.012", "--set", delay},
                       folder);
  };
  const ProgramResult late = run("device.delay=60"), on_time = run("device.delay=0");
  EXPECT_EQ(late.exit_code, 3) << late.err;
  EXPECT_NE(late.err.find("returned up to"), std::string::npos) << late.err;
  EXPECT_NE(late.err.find("device.delay"), std::string::npos) << late.err;
  EXPECT_EQ(on_time.exit_code, 0);
  EXPECT_EQ(on_time.err.find("returned"), std::string::npos) << on_time.err;
}

TEST(CliRun, AnEstimateFromAnUnstableSolutionIsNoneButTheRunStands) {
  // K = 13 kN/m: stable at 1 kHz, not at 500 Hz, where the unlimited force throws the device off.
  const fs::path folder = test_folder();
  const ProgramResult run = run_program({"run",
                                         "scene.toml",
                                         "-o",
                                         "a.h5",
                                         "--png",
                                         "a.png",
                                         "--estimate-error=coarser",
                                         "--json",
                                         "--set",
                                         "device.model=dynamic",
                                         "--set",
                                         "device.max_force=0",
                                         "--set",
                                         "force.k_f=0.0",
                                         "--set",
                                         "force.k_s=1",
                                         "--set",
                                         "force.k_c=2000",
                                         "--set",
                                         "stroke.depth=0.015"},
                                        folder);
  EXPECT_EQ(run.exit_code, 3) << run.out;
  EXPECT_NE(run.err.find("the coarser solution is unstable"), std::string::npos) << run.err;
  ASSERT_FALSE(run.out.empty()) << run.err;
  EXPECT_FALSE(nlohmann::json::parse(run.out).contains("error_estimate"));
  EXPECT_TRUE(RunFile(folder / "a.h5").complete());
  EXPECT_TRUE(fs::exists(folder / "a.png"));
}

TEST(CliRun, StoppedWhileItEstimatesItsErrorIsStopped) {
  const fs::path folder = test_folder();  // the run takes a moment, its finer solution seconds
  const ProgramResult run = run_program({"run", "scene.toml", "-o", "a.h5", "--estimate-error=finer", "--set",
                                         "device.servo_rate=100000", "--set", "relaxation.rate=100000"},
                                        folder, {SIGINT, 1500});
  EXPECT_EQ(run.exit_code, 130) << run.out << run.err;
}

TEST(CliRun, AToolThatNeverTouchesTheSandIsPointedOut) {
  const fs::path folder = test_folder();
  const ProgramResult run =
      run_program({"run", "scene.toml", "-o", "a.h5", "--set", "stroke.depth=-0.1"}, folder);
  EXPECT_EQ(run.exit_code, 0);
  EXPECT_NE(run.err.find("never touched"), std::string::npos) << run.err;
}

TEST(CliRun, AToolBesideTheBedIsToldHowFar) {
  const fs::path folder = test_folder();
  std::string rows = "t [s],x [m],y [m],z [m]\n";
  for (int i = 0; i <= 10; ++i) rows += fmt::format("{},3,{},0.01\n", 0.01 * i, 3.0 + 0.01 * i);
  write_file(folder / "corner.csv", rows);
  const auto said = [&](const std::vector<std::string>& keys) {
    std::vector<std::string> words = {"run", "scene.toml", "-o", "a.h5", "--stroke", "corner.csv"};
    for (const std::string& key : keys) words.insert(words.end(), {"--set", key});
    return run_program(words, folder);
  };
  const std::vector<std::string> rectangle = {"bed.size=[8, 8]", "bed.cells=[100, 100]", "tool.radius=0.1"};
  std::vector<std::string> round = rectangle;
  round.push_back("bed.shape=round");
  EXPECT_EQ(said(rectangle).err.find("beyond its edge"), std::string::npos);
  const ProgramResult above = said(round);  // |(3, 3)| = 4.243, and the wall is at 4
  EXPECT_EQ(above.exit_code, 0);
  EXPECT_NE(above.err.find("242.6 mm or more beyond its edge"), std::string::npos) << above.err;
  round.push_back("stroke.depth=0.02");
  const ProgramResult inside = said(round);
  EXPECT_EQ(inside.exit_code, 2);
  EXPECT_NE(inside.err.find("242.6 mm beyond the bed's edge, at x = 3 m"), std::string::npos) << inside.err;
}

TEST(CliRun, AStrokeInMillimetresIsPointedOut) {
  const fs::path folder = test_folder();
  const auto said = [&](const char* depth) {
    return run_program({"run", "scene.toml", "-o", "a.h5", "--quiet", "--set", depth}, folder).err;
  };
  const std::string warning = said("stroke.depth=5");  // 5 mm and the script's 4 mm were meant
  EXPECT_NE(warning.find("line.toml: goes 5.004 m deep into the sand"), std::string::npos) << warning;
  EXPECT_NE(warning.find("500 times the tool's reach of 0.01 m"), std::string::npos) << warning;
  EXPECT_NE(warning.find("stroke.depth"), std::string::npos) << warning;
  EXPECT_EQ(said("stroke.depth=0.19").find("times the tool"), std::string::npos);
  EXPECT_NE(said("stroke.depth=0.2").find("20 times the tool"), std::string::npos);
}

/// A circle of 40 mm that is reached from 30 mm above, and left again.
TEST(CliRun, AnApproachThatPullsThePlaneIsPointedOutUntilItIsCutOff) {
  const fs::path folder = test_folder();
  std::string table = "t_s,x_m,y_m,z_m\n";
  for (int i = 0; i <= 400; ++i) {
    const double angle = 0.03 * std::clamp(i, 50, 350),
                 above = 6e-4 * (std::max(50 - i, 0) + std::max(i - 350, 0));
    table += fmt::format("{},{},{},{}\n", 0.01 * i, 0.04 * std::cos(angle), 0.04 * std::sin(angle), above);
  }
  put_text(folder / "approach.csv", table);
  const auto said = [&](const char* start, const char* stop) {
    return run_program({"run", "scene.toml", "-o", "a.h5", "--quiet", "--stroke", "approach.csv", "--set",
                        "stroke.plane=fit", "--set", start, "--set", stop},
                       folder)
        .err;
  };
  constexpr const char* warning = "begins or ends up to 30 mm off the plane of its middle";
  const std::string whole = said("stroke.start=0", "stroke.stop=0");
  EXPECT_NE(whole.find(warning), std::string::npos) << whole;
  EXPECT_EQ(said("stroke.start=0.5", "stroke.stop=3.5").find("off the plane"), std::string::npos);
}

TEST(CliRun, EstimatesItsErrorOnRequest) {
  const fs::path folder = test_folder();
  const ProgramResult plain = run_program({"run", "scene.toml", "--json"}, folder);
  EXPECT_FALSE(nlohmann::json::parse(plain.out).contains("error_estimate"));
  const ProgramResult run = run_program({"run", "--estimate-error", "scene.toml", "--json"}, folder);
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const nlohmann::json estimate = nlohmann::json::parse(run.out)["error_estimate"];
  EXPECT_GT(estimate["height_share"], 0.0);
  EXPECT_LT(estimate["height_share"], 1.0);
  EXPECT_GE(estimate["height_max"], estimate["height_rms"]);
  EXPECT_GE(estimate["force_max"], estimate["force_rms"]);
}

TEST(CliRun, RefusesToEstimateTheErrorOfABedWithoutCoarserCellsBeforeAnyWork) {
  const fs::path folder = test_folder();
  const ProgramResult run =
      run_program({"run", "scene.toml", "--estimate-error=coarser", "--set", "bed.cells=[15,16]", "--set",
                   "bed.size=[0.15,0.16]", "-o", "odd.h5"},
                  folder);
  EXPECT_EQ(run.exit_code, 2);
  EXPECT_NE(run.err.find("bed.cells = [15, 16]"), std::string::npos) << run.err;
  EXPECT_FALSE(fs::exists(folder / "odd.h5.part"));
}

TEST(CliInfo, ShowsARunAndTheSceneKeys) {
  const fs::path folder = test_folder();
  ASSERT_EQ(run_program({"run", "scene.toml", "-o", "a.h5"}, folder).exit_code, 0);
  const nlohmann::json json = nlohmann::json::parse(run_program({"info", "a.h5", "--json"}, folder).out);
  EXPECT_EQ(json["cells"][0], 150);
  EXPECT_TRUE(json["complete"]);
  EXPECT_TRUE(json["provenance"].contains("version"));
  const std::string table = run_program({"info", "a.h5"}, folder).out;
  for (const char* line : {"cell_size                   0.002 m\n", "initial/lowest              0.0 m\n"})
    EXPECT_NE(table.find(line), std::string::npos) << table;
  for (const char* unit : {" s\ntrace/max_force", " N\ntrace/max_depth"})
    EXPECT_NE(table.find(unit), std::string::npos) << table;
  EXPECT_NE(run_program({"info", "--scene-keys"}, folder).out.find("relaxation.talus_angle"),
            std::string::npos);
  const ProgramResult scene = run_program({"info", "a.h5", "--scene"}, folder);
  write_file(folder / "again.toml", scene.out);
  EXPECT_EQ(run_program({"run", "again.toml", "-o", "b.h5"}, folder).exit_code, 0);
  EXPECT_EQ(run_program({"compare", "a.h5", "b.h5"}, folder).exit_code, 0);
}

TEST(CliHelp, EveryCommandExplainsItself) {
  const fs::path folder = test_folder();
  for (const char* command : {"run", "render", "compare", "golden", "stroke", "record", "info"}) {
    const ProgramResult help = run_program({command, "--help"}, folder);
    EXPECT_EQ(help.exit_code, 0);
    EXPECT_GT(help.out.size(), 200u) << command;
  }
  EXPECT_EQ(run_program({"--version"}, folder).exit_code, 0);
}

}  // namespace
}  // namespace sandstroke
