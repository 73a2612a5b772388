// The whole way of a recording with the real program, from a stand-in: a script that is played in real time.
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "cli/program.h"
#include "io/run_file.h"
#include "io/stroke_file.h"
#include "record/journal.h"
#include "sanitized.h"

namespace sandstroke {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

// line.toml, as test_folder() makes it: down at 0.05 m/s, 0.1 m at 0.2 m/s, up again; 1.46 s in all.
constexpr double top_speed = 0.2;  // m/s
const std::vector<std::string> record_line = {"record",   "--max-skipped",     "100", "-o", "a.h5",
                                              "--device", "scripted:line.toml"};

std::vector<std::string> with(std::vector<std::string> arguments, const std::vector<std::string>& more) {
  arguments.insert(arguments.end(), more.begin(), more.end());
  return arguments;
}

/// The journal of a.h5 holds samples beside its header.
std::function<bool()> recording(const fs::path& folder, std::uintmax_t bytes = 20'000) {
  return [journal = folder / "a.h5.recording", bytes] {
    std::error_code not_there;
    return fs::exists(journal) && fs::file_size(journal, not_there) > bytes;
  };
}

/// A stroke so long that the recording ends before it, however late that comes.
fs::path folder_with_long_stroke() {
  const fs::path folder = test_folder();
  write_file(folder / "line.toml", read_file(folder / "line.toml") +
                                       "[[segment]]\nkind = \"move\"\nto = [0.06, 0.0]\nwait = 300.0\n");
  return folder;
}

double largest_spacing(const Stroke& stroke) {
  double largest = 0.0;
  for (std::size_t i = 1; i < stroke.size(); ++i)
    largest = std::max(largest, stroke.time[i] - stroke.time[i - 1]);
  return largest;
}

TEST(CliRecord, AccountsForEveryTick) {
  const fs::path folder = test_folder();
  const ProgramResult result = run_program(with(record_line, {"--json"}), folder);
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const json said = json::parse(result.out);
  const Stroke script = load_stroke(folder / "line.toml", {}), stroke = read_stroke_file(folder / "a.h5");
  EXPECT_EQ(said["stop_reason"], "the stroke played was over");
  EXPECT_TRUE(said["complete"]);
  EXPECT_EQ(said["ticks_elapsed"], std::llround(1000.0 * script.duration()) + 1);
  EXPECT_EQ(said["ticks_elapsed"].get<int>(),
            said["ticks_recorded"].get<int>() + said["ticks_skipped"].get<int>() +
                said["ticks_unread"].get<int>() + said["ticks_dropped"].get<int>());
  EXPECT_EQ(said["ticks_unread"], 0);
  EXPECT_EQ(said["ticks_dropped"], 0);
  EXPECT_EQ(said["ticks_recorded"], stroke.size());
  EXPECT_EQ(said["source"], "scripted:line.toml");
  EXPECT_EQ(said["force_limit"], 0.0);
  EXPECT_TRUE(stroke.complete);
  EXPECT_TRUE(stroke.force.empty());  // none was given
  EXPECT_FALSE(fs::exists(folder / "a.h5.recording"));
  EXPECT_EQ(run_program({"stroke", "info", "a.h5"}, folder).exit_code, 0);
}

TEST(CliRecord, TheRecordingDrawsWhatTheScriptDraws) {
  // A recorded sample is where the script is at its time, to rounding; between two samples both hands are
  // between these two places. So at any time they are no further apart than the script goes from sample to
  // sample: speed x spacing, with the spacing that this machine reached.
  const fs::path folder = test_folder();
  ASSERT_EQ(run_program(record_line, folder).exit_code, 0);
  const Stroke stroke = read_stroke_file(folder / "a.h5");
  const double apart = top_speed * largest_spacing(stroke) * (1.0 + 1e-6);
  ASSERT_EQ(run_program({"run", "scene.toml", "-o", "script.h5"}, folder).exit_code, 0);
  ASSERT_EQ(run_program({"run", "scene.toml", "-o", "recorded.h5", "--stroke", "a.h5"}, folder).exit_code, 0);
  const std::vector<TickRecord> script = RunFile(folder / "script.h5").trace(),
                                recorded = RunFile(folder / "recorded.h5").trace();
  for (std::size_t i = 0; i < std::min(script.size(), recorded.size()); ++i)
    ASSERT_LE((script[i].hand.position - recorded[i].hand.position).norm(), apart) << i;

  // Sand at rest slopes by tan(talus) at most, so a surface moved by so much changes by no more than this.
  const double height = apart * std::tan(30.0 * std::acos(-1.0) / 180.0);
  const HeightGrid difference =
      RunFile(folder / "script.h5").final() - RunFile(folder / "recorded.h5").final();
  EXPECT_LE(difference.abs().maxCoeff(), height);
}

TEST(CliRecord, SaysWhereTooManyTicksWereSkipped) {
  // Some ticks are skipped at 0 % allowed, or none are, on any machine: both are told truly.
  const fs::path folder = test_folder();
  const ProgramResult result =
      run_program({"record", "-o", "a.h5", "--device", "scripted:line.toml", "--duration", "0.2", "--rate",
                   "10000", "--priority", "0", "--max-skipped", "0", "--json"},
                  folder);
  const json said = json::parse(result.out);
  const double fraction = said["ticks_skipped"].get<double>() / said["ticks_elapsed"].get<double>();
  EXPECT_EQ(result.err.find("ticks were skipped") != std::string::npos, fraction > 0.0) << result.err;
  EXPECT_EQ(result.exit_code, fraction > 0.1 ? 1 : 0);
  EXPECT_EQ(read_stroke_file(folder / "a.h5").starved, fraction > 0.1);
  EXPECT_GT(said["ticks_recorded"], 0);
}

TEST(CliRecord, EndsWhenTheTimeIsUp) {
  const fs::path folder = test_folder();
  const ProgramResult result = run_program(with(record_line, {"--duration", "0.3", "--json"}), folder);
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(json::parse(result.out)["ticks_elapsed"], 300);
  EXPECT_EQ(json::parse(result.out)["stop_reason"], "the time was up");
  const ProgramResult slow =
      run_program(with(record_line, {"--duration", "0.3", "--rate", "200", "--overwrite"}), folder);
  ASSERT_EQ(slow.exit_code, 0) << slow.err;
  EXPECT_NE(slow.out.find("0.300 s at 200 Hz"), std::string::npos) << slow.out;
  EXPECT_LE(read_stroke_file(folder / "a.h5").size(), 60u);
}

TEST(CliRecord, SandIsFeltAtTheRateOfItsSceneUnlessAnotherIsGiven) {
  const fs::path folder = test_folder();
  const std::vector<std::string> feel =
      with(record_line, {"--overwrite", "--json", "--duration", "0.2", "--feel", "scene.toml"});
  const auto rate_with = [&](const std::vector<std::string>& more) {
    const ProgramResult result = run_program(with(feel, more), folder);
    EXPECT_EQ(result.exit_code, 0) << result.err;
    const json said = json::parse(result.out);
    EXPECT_EQ(said["ticks_elapsed"], 0.2 * said["nominal_rate"].get<double>());
    return said["nominal_rate"].get<double>();
  };
  EXPECT_EQ(rate_with({}), 1000.0);
  EXPECT_EQ(rate_with({"--set", "device.servo_rate=500"}), 500.0);
  EXPECT_EQ(rate_with({"--set", "device.servo_rate=500", "--rate", "250"}), 250.0);
  EXPECT_EQ(rate_with({"--set", "device.servo_rate=20", "--rate", "250"}), 250.0);
  const ProgramResult slow = run_program(with(feel, {"--set", "device.servo_rate=20"}), folder);
  EXPECT_EQ(slow.exit_code, 2);
  for (const char* part : {"device.servo_rate", "--rate"})
    EXPECT_NE(slow.err.find(part), std::string::npos) << slow.err;
}

TEST(CliRecord, ARecordingCanBePlayedAndRecordedAgain) {
  const fs::path folder = test_folder();
  ASSERT_EQ(run_program(with(record_line, {"--duration", "0.6"}), folder).exit_code, 0);
  const ProgramResult again = run_program(
      {"record", "--max-skipped", "100", "-o", "b.h5", "--device", "replay:a.h5", "--json"}, folder);
  ASSERT_EQ(again.exit_code, 0) << again.err;
  EXPECT_EQ(json::parse(again.out)["stop_reason"], "the stroke played was over");
  const Stroke first = read_stroke_file(folder / "a.h5"), second = read_stroke_file(folder / "b.h5");
  EXPECT_LE((first.position.front() - second.position.front()).norm(), 1e-12);
  EXPECT_EQ(second.frame, "bed");
}

TEST(CliRecord, AStrokeWithAGapIsPlayedToItsEnd) {
  const fs::path folder = test_folder();
  Stroke stroke;
  stroke.time = {0.0, 0.05, 0.35, 0.4};
  stroke.position.assign(4, {0.0, 0.0, -0.001});
  write_stroke_file(folder / "gap.h5", stroke);
  const ProgramResult result = run_program(
      {"record", "--max-skipped", "100", "-o", "a.h5", "--device", "replay:gap.h5", "--json"}, folder);
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const json said = json::parse(result.out);
  EXPECT_EQ(said["ticks_elapsed"], 401);
  EXPECT_GT(said["ticks_unread"], 0);
  EXPECT_GE(largest_spacing(read_stroke_file(folder / "a.h5")), 0.298);  // the gap is a gap again
}

TEST(CliRecord, StoppedBySignalItKeepsWhatThereIsAndMarksIt) {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGUSR1}) {
    const fs::path folder = folder_with_long_stroke();
    Conditions stopped{signal};
    stopped.when = recording(folder);
    const ProgramResult result = run_program(with(record_line, {"--json"}), folder, stopped);
    EXPECT_EQ(result.exit_code, 128 + signal) << result.err;
    EXPECT_NE(result.err.find("incomplete"), std::string::npos) << result.err;
    const json said = json::parse(result.out);
    EXPECT_FALSE(said["complete"]);
    EXPECT_EQ(said["stop_reason"], "a signal came");
    EXPECT_FALSE(fs::exists(folder / "a.h5.recording"));
    const json info = json::parse(run_program({"stroke", "info", "a.h5", "--json"}, folder).out);
    EXPECT_FALSE(info["complete"]);
    EXPECT_EQ(info["samples"], said["ticks_recorded"]);
  }
}

TEST(CliRecord, KilledItsJournalBecomesAStrokeThatRuns) {
  const fs::path folder = folder_with_long_stroke();
  Conditions killed{SIGKILL};
  killed.when = recording(folder, 4000 + 700 * journal_sample_bytes);  // the tool is in the sand
  EXPECT_EQ(run_program(record_line, folder, killed).exit_code, 128 + SIGKILL);
  EXPECT_FALSE(fs::exists(folder / "a.h5"));
  const ProgramResult again = run_program(record_line, folder);  // what was recorded is not written over
  EXPECT_EQ(again.exit_code, 4);
  EXPECT_NE(again.err.find("stroke repair a.h5.recording"), std::string::npos) << again.err;

  const ProgramResult repair = run_program({"stroke", "repair", "a.h5.recording", "--json"}, folder);
  ASSERT_EQ(repair.exit_code, 0) << repair.err;
  const Stroke stroke = read_stroke_file(folder / "a.h5");
  EXPECT_FALSE(stroke.complete);
  EXPECT_GE(stroke.size(), 700u);
  const ProgramResult run =
      run_program({"run", "scene.toml", "-o", "run.h5", "--stroke", "a.h5", "--json"}, folder);
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_GT(json::parse(run.out)["contact_ticks"], 0);
}

TEST(CliRecord, NothingIsWrittenOverUnasked) {
  const fs::path folder = test_folder();
  write_file(folder / "a.h5", "precious");
  const ProgramResult refused = run_program(record_line, folder);
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_NE(refused.err.find("--overwrite"), std::string::npos) << refused.err;
  EXPECT_EQ(read_file(folder / "a.h5"), "precious");
  ASSERT_EQ(run_program(with(record_line, {"--overwrite", "--duration", "0.2"}), folder).exit_code, 0);
  EXPECT_LE(read_stroke_file(folder / "a.h5").size(), 200u);

  const std::string script = read_file(folder / "line.toml"), scene = read_file(folder / "scene.toml");
  for (const char* input : {"line.toml", "scene.toml"}) {
    const ProgramResult own = run_program(
        {"record", "-o", input, "--overwrite", "--device", "scripted:line.toml", "--feel", "scene.toml"},
        folder);
    EXPECT_EQ(own.exit_code, 2) << own.err;
  }
  EXPECT_EQ(read_file(folder / "line.toml"), script);
  EXPECT_EQ(read_file(folder / "scene.toml"), scene);
}

TEST(CliRecord, AFileThatComesWhileItIsRecordedIsNotWrittenOver) {
  const fs::path folder = test_folder();
  Conditions meanwhile;
  meanwhile.signal = SIGTERM;
  meanwhile.when = [&folder, going_on = recording(folder)] {
    if (!going_on()) return false;
    write_file(folder / "a.h5", "precious");
    return true;
  };
  const ProgramResult result = run_program(record_line, folder, meanwhile);
  EXPECT_EQ(result.exit_code, 4) << result.err;
  EXPECT_NE(result.err.find("stroke repair"), std::string::npos) << result.err;
  EXPECT_EQ(read_file(folder / "a.h5"), "precious");
  ASSERT_EQ(run_program({"stroke", "repair", "a.h5.recording", "b.h5"}, folder).exit_code, 0);
  EXPECT_GT(read_stroke_file(folder / "b.h5").size(), 100u);
}

TEST(CliRecord, AJournalThatSomebodyRemovesIsToldAsLost) {
  const fs::path folder = test_folder();
  Conditions meanwhile;
  meanwhile.signal = SIGTERM;
  meanwhile.when = [&folder, going_on = recording(folder)] {
    return going_on() && fs::remove(folder / "a.h5.recording");
  };
  const ProgramResult result = run_program(record_line, folder, meanwhile);
  EXPECT_EQ(result.exit_code, 4) << result.err;
  EXPECT_NE(result.err.find("the file was removed or replaced"), std::string::npos) << result.err;
  EXPECT_EQ(result.err.find("stroke repair"), std::string::npos) << result.err;
}

TEST(CliRecord, WhatIsBeingRecordedIsNotToldAsCutOff) {
  const fs::path folder = test_folder();
  ProgramResult second;
  Conditions meanwhile;
  meanwhile.signal = SIGTERM;
  meanwhile.when = [&, going_on = recording(folder)] {
    if (!going_on()) return false;
    second = run_program(record_line, folder);
    return true;
  };
  EXPECT_EQ(run_program(record_line, folder, meanwhile).exit_code, 128 + SIGTERM);
  EXPECT_EQ(second.exit_code, 4);
  EXPECT_NE(second.err.find("is still being recorded"), std::string::npos) << second.err;
}

TEST(CliRecord, AFullDiskStopsItAndKeepsWhatTheDiskTook) {
  if (threads_sanitized) GTEST_SKIP() << "the sanitizer's own memory is a file";
  const fs::path folder = test_folder();
  const ProgramResult result = run_program(record_line, folder, {0, 0, 30'000});
  EXPECT_EQ(result.exit_code, 4) << result.err;
  EXPECT_NE(result.err.find("a.h5"), std::string::npos) << result.err;
  const fs::path kept = fs::exists(folder / "a.h5") ? folder / "a.h5" : folder / "a.h5.recording";
  ASSERT_TRUE(fs::exists(kept));
  if (kept.extension() == ".recording") {  // the stroke did not fit either
    EXPECT_NE(result.err.find("stroke repair"), std::string::npos) << result.err;
    ASSERT_EQ(run_program({"stroke", "repair", "a.h5.recording"}, folder).exit_code, 0);
  }
  const Stroke stroke = read_stroke_file(folder / "a.h5");
  EXPECT_FALSE(stroke.complete);
  EXPECT_GT(stroke.size(), 100u);
}

TEST(CliRecord, ADiskThatIsFullFromTheStartIsAnErrorBeforeAnything) {
  if (threads_sanitized) GTEST_SKIP() << "the sanitizer's own memory is a file";
  const fs::path folder = test_folder();
  const ProgramResult result = run_program(record_line, folder, {0, 0, 10});
  EXPECT_EQ(result.exit_code, 4) << result.err;
  EXPECT_FALSE(fs::exists(folder / "a.h5"));
  EXPECT_FALSE(fs::exists(folder / "a.h5.recording"));
}

TEST(CliRecord, WhatIsWrongIsSaidBeforeAnythingIsRecorded) {
  const fs::path folder = test_folder();
  write_file(folder / "dynamic.toml", read_file(folder / "scene.toml") + "[device]\nmodel = \"dynamic\"\n");
  write_file(
      folder / "press.toml",
      "start = [0.0, 0.0]\nspeed = 0.2\n[[segment]]\nkind = \"line\"\nto = [0.05, 0.0]\nforce = 2.0\n");
  struct Attempt {
    std::vector<std::string> arguments;
    int exit_code;
    std::string part;
  };
  const std::vector<std::string> to_a = {"record", "-o", "a.h5", "--device"};
  const std::vector<Attempt> attempts = {
      {{"record"}, 2, "--list"},
      {{"record", "-o", "a.h5"}, 2, "--device"},
      {with(to_a, {"mouse"}), 2, "scripted:FILE.toml"},
      {with(to_a, {"scripted:"}), 2, "the stroke is missing"},
      {with(to_a, {"chai3d:one"}), 2, "unknown device"},
      {with(to_a, {"chai3d:-1"}), 2, "unknown device"},
      {with(to_a, {"scripted:none.toml"}), 4, "none.toml"},
      {with(to_a, {"replay:scene.toml"}), 2, "scene.toml"},
      {with(to_a, {"scripted:press.toml"}), 2, "use depths"},
      {with(record_line, {"--duration", "-1"}), 2, "--duration"},
      {with(record_line, {"--duration", "nan"}), 2, "--duration"},
      {with(record_line, {"--rate", "0"}), 2, "--rate"},
      {with(record_line, {"--rate", "nan"}), 2, "--rate"},
      {with(record_line, {"--rate", "1e9"}), 2, "--rate"},
      {with(record_line, {"--priority", "99"}), 2, "--priority"},
      {with(record_line, {"--stop-switch", "32"}), 2, "--stop-switch"},
      {with(record_line, {"--start-switch", "-1"}), 2, "--start-switch"},
      {with(record_line, {"--countdown", "-1"}), 2, "--countdown"},
      {with(record_line, {"--start-at-contact"}), 2, "--feel"},
      {with(record_line, {"--max-force", "3"}), 2, "--feel"},
      {with(record_line, {"--set", "force.k_s=1"}), 2, "--feel"},
      {with(record_line, {"--feel", "none.toml"}), 4, "none.toml"},
      {with(record_line, {"--feel", "line.toml"}), 2, "line.toml"},
      {with(record_line, {"--feel", "dynamic.toml"}), 2, "device.model"},
      {with(record_line, {"--feel", "scene.toml", "--set", "force.k=1"}), 2, "force.k"},
      {with(record_line, {"--feel", "scene.toml", "--max-force", "nan"}), 2, "--max-force"},
      {with(record_line, {"--feel", "scene.toml", "--max-force", "-1"}), 2, "--max-force"},
      {with(record_line, {"--feel", "scene.toml", "--force-rate", "0"}), 2, "--force-rate"},
      {{"record", "-o", "nowhere/a.h5", "--device", "scripted:line.toml"}, 4, "nowhere"},
      {{"record", "-o", ".", "--device", "scripted:line.toml", "--overwrite"}, 4, "folder"},
      {{"record", "--list", "--check"}, 2, "--list"},
      {with(record_line, {"--check"}), 2, "leave out"},
      {{"record", "--check", "--device", "scripted:line.toml"}, 2, "leave out"},
      {{"record", "--check", "--feel", "none.toml"}, 4, "none.toml"},
      {{"record", "--list", "--feel", "scene.toml"}, 2, "leave out"},
  };
  for (const auto& [arguments, exit_code, part] : attempts) {
    const ProgramResult result = run_program(arguments, folder);
    const std::string said = result.err + result.out;
    EXPECT_EQ(result.exit_code, exit_code) << arguments.back() << ": " << said;
    EXPECT_NE(said.find(part), std::string::npos) << arguments.back() << ": " << said;
    EXPECT_EQ(said.find("unexpected"), std::string::npos) << said;
    EXPECT_FALSE(fs::exists(folder / "a.h5"));
    EXPECT_FALSE(fs::exists(folder / "a.h5.recording"));
  }
}

TEST(CliRecord, AFolderThatCannotBeWrittenIsAnError) {
  if (geteuid() == 0) GTEST_SKIP() << "root may write anywhere";
  const fs::path folder = test_folder();
  fs::create_directory(folder / "closed");
  fs::permissions(folder / "closed", fs::perms::owner_read | fs::perms::owner_exec);
  const ProgramResult result =
      run_program({"record", "-o", "closed/a.h5", "--device", "scripted:line.toml"}, folder);
  EXPECT_EQ(result.exit_code, 4) << result.err;
  fs::permissions(folder / "closed", fs::perms::owner_all);
}

TEST(CliRecord, SandCanBeFelt) {
  const fs::path folder = test_folder();
  const ProgramResult result =
      run_program(with(record_line, {"--feel", "scene.toml", "--set", "force.k_s=2000", "--max-force", "3",
                                     "--force-ramp", "0.1", "--json"}),
                  folder);
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const json said = json::parse(result.out);
  EXPECT_EQ(said["force_limit"], 3.0);
  EXPECT_GT(said["felt"]["contact_ticks"], 500);
  EXPECT_GT(said["felt"]["relaxations"], 0);
  const Stroke stroke = read_stroke_file(folder / "a.h5");
  ASSERT_EQ(stroke.force.size(), stroke.size());
  double most = 0.0;
  for (const Eigen::Vector3d& force : stroke.force) most = std::max(most, force.norm());
  EXPECT_GT(most, 0.1);
  EXPECT_LE(most, 3.0 * (1.0 + 1e-12));
}

/// resting.h5: a hand that rests 65 mm below the surface, as in an inkwell, until `lifts` [s], is then 20 mm
/// above it for 0.2 s, and comes down again.
fs::path folder_with_resting_stylus(double lifts) {
  const fs::path folder = test_folder();
  Stroke hand;
  for (int i = 0; i <= 600; ++i) {
    const double t = 1e-3 * i, out = std::clamp(std::min(t - lifts, lifts + 0.4 - t) / 0.1, 0.0, 1.0);
    hand.time.push_back(t);
    hand.position.emplace_back(0.0, 0.0, -0.065 + 0.085 * out);
  }
  write_stroke_file(folder / "resting.h5", hand);
  return folder;
}

double largest_force(const fs::path& stroke_file, double until = 1e9) {
  const Stroke stroke = read_stroke_file(stroke_file);
  double largest = 0.0;
  for (std::size_t i = 0; i < stroke.size(); ++i)
    if (stroke.time[i] < until) largest = std::max(largest, stroke.force.at(i).norm());
  return largest;
}

TEST(CliRecord, AHandThatRestsInTheSandIsNotPushed) {
  const fs::path folder = folder_with_resting_stylus(100.0);
  const std::string wscg = std::string(SANDSTROKE_SOURCE) + "/strokes/wscg/scene.toml";
  const ProgramResult result =
      run_program({"record", "--max-skipped", "100", "-o", "a.h5", "--device", "replay:resting.h5", "--feel",
                   wscg, "--duration", "0.4", "--json"},
                  folder);
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const json said = json::parse(result.out);
  EXPECT_EQ(said["ticks_interlocked"], said["ticks_recorded"]);
  EXPECT_EQ(largest_force(folder / "a.h5"), 0.0);
}

TEST(CliRecord, AHandThatWasLiftedFeelsTheSand) {
  const fs::path folder = folder_with_resting_stylus(0.1);
  const ProgramResult result =
      run_program({"record", "--max-skipped", "100", "-o", "a.h5", "--device", "replay:resting.h5", "--feel",
                   "scene.toml", "--force-ramp", "0.1"},
                  folder);
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_NE(result.out.find("until the tool was lifted out of the sand"), std::string::npos) << result.out;
  EXPECT_EQ(largest_force(folder / "a.h5", 0.2), 0.0);
  EXPECT_GT(largest_force(folder / "a.h5"), 3.0);
}

TEST(CliRecord, WhatCameBeforeTheBeginningIsNotInTheStroke) {
  const fs::path folder = folder_with_resting_stylus(0.15);
  const auto record_with = [&](const std::vector<std::string>& more) {
    return run_program(with({"record", "--max-skipped", "100", "-o", "a.h5", "--overwrite", "--device",
                             "replay:resting.h5", "--json"},
                            more),
                       folder);
  };
  const ProgramResult counted = record_with({"--countdown", "0.1", "--duration", "0.2"});
  ASSERT_EQ(counted.exit_code, 0) << counted.err;
  EXPECT_EQ(json::parse(counted.out)["ticks_elapsed"], 200);
  EXPECT_EQ(read_stroke_file(folder / "a.h5").time.front(), 0.0);

  const ProgramResult touching = record_with({"--start-at-contact", "--feel", "scene.toml"});
  ASSERT_EQ(touching.exit_code, 0) << touching.err;
  const Stroke stroke = read_stroke_file(folder / "a.h5");
  EXPECT_EQ(stroke.time.front(), 0.0);
  ASSERT_GT(stroke.size(), 50u);
  EXPECT_GT(stroke.position[0].z(), 0.0) << "the way into the sand is in it";
  EXPECT_LT(stroke.position[5].z(), 0.0);
  EXPECT_LT(stroke.duration(), 0.3);
  const ProgramResult played = run_program({"run", "scene.toml", "--stroke", "a.h5", "--json"}, folder);
  ASSERT_EQ(played.exit_code, 0) << played.err;
  const json felt = json::parse(touching.out);  // what was skipped was not felt, but is played
  EXPECT_NEAR(json::parse(played.out)["contact_ticks"].get<double>(),
              felt["felt"]["contact_ticks"].get<double>(), 30.0 + felt["ticks_skipped"].get<double>());

  const ProgramResult never = record_with({"--start-switch", "0"});
  EXPECT_EQ(never.exit_code, 4);
  EXPECT_NE(never.err.find("nothing was recorded"), std::string::npos) << never.err;
}

TEST(CliRecord, CtrlCWhileItWaitsLeavesNothing) {
  const fs::path folder = folder_with_resting_stylus(100.0);
  Conditions stopped{SIGINT};
  stopped.when = [&] { return fs::exists(folder / "a.h5.recording"); };
  const ProgramResult result = run_program(
      {"record", "-o", "a.h5", "--device", "replay:resting.h5", "--countdown", "300"}, folder, stopped);
  EXPECT_EQ(result.exit_code, 4) << result.err;
  EXPECT_NE(result.err.find("nothing was recorded: a signal came"), std::string::npos) << result.err;
  EXPECT_FALSE(fs::exists(folder / "a.h5"));
  EXPECT_FALSE(fs::exists(folder / "a.h5.recording"));
}

TEST(CliRecord, SandThatWasNeverTouchedIsTold) {
  const fs::path folder = test_folder();
  const auto record_at = [&](const char* offset) {
    return run_program({"record", "--max-skipped", "100", "-o", "a.h5", "--overwrite", "--device",
                        "scripted:line.toml", "--feel", "scene.toml", "--set", offset},
                       folder);
  };
  const ProgramResult above = record_at("stroke.offset=[0, 0, 1]"),
                      in_it = record_at("stroke.offset=[0, 0, 0]");
  EXPECT_EQ(above.exit_code, 0) << above.err;
  EXPECT_NE(above.err.find("never touched"), std::string::npos) << above.err;
  EXPECT_EQ(in_it.err.find("never touched"), std::string::npos) << in_it.err;
}

TEST(CliRecord, ARunOfAFeltStrokeHasTheForcesThatWereFelt) {
  // The bound of live_sand.h, with the spacing that this machine reached; without relaxation during the
  // stroke, whose times are the wall's.
  const fs::path folder = test_folder();
  constexpr double radius = 0.04, turn = 3.0, dip = 0.006, dive = 9.0;  // m, 1/s
  Stroke hand;
  for (int i = 0; i <= 2000; ++i) {
    const double t = 1e-3 * i;
    hand.time.push_back(t);
    hand.position.emplace_back(radius * std::cos(turn * t), radius * std::sin(turn * t),
                               0.001 + dip * std::cos(dive * t));
  }
  write_stroke_file(folder / "hand.h5", hand);
  ASSERT_EQ(run_program({"record", "--max-skipped", "100", "-o", "felt.h5", "--device", "replay:hand.h5",
                         "--feel", "scene.toml", "--set", "relaxation.rate=0", "--force-ramp", "0"},
                        folder)
                .exit_code,
            0);
  const ProgramResult run = run_program(
      {"run", "scene.toml", "--stroke", "felt.h5", "--set", "relaxation.rate=0", "--json"}, folder);
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const json said = json::parse(run.out);
  const double h = largest_spacing(read_stroke_file(folder / "felt.h5"));
  const double speed = radius * turn + dip * dive, acceleration = radius * turn * turn + dip * dive * dive;
  const double repulse = said["max_force"], stiffness = 1000.0 * 0.5 * std::exp(0.5 * 0.01), k_f = 10.0;
  EXPECT_GT(said["recorded_force"]["ticks"], 1000);
  EXPECT_GT(repulse, 1.0);
  EXPECT_LE(said["recorded_force"]["max"],
            2.0 * stiffness * speed * h * (1.0 + k_f * speed) + k_f * repulse * acceleration * 4.0 * h);
}

TEST(CliRecord, ListSaysWhatThereIs) {
  const fs::path folder = test_folder();
  const ProgramResult table = run_program({"record", "--list"}, folder);
  EXPECT_EQ(table.exit_code, 0);
  EXPECT_NE(table.out.find("scripted:FILE.toml"), std::string::npos) << table.out;
  const json list = json::parse(run_program({"record", "--list", "--json"}, folder).out);
  EXPECT_EQ(list["stand_ins"].size(), 3u);
  EXPECT_TRUE(list["devices"].is_array());
}

TEST(CliRecord, CheckMeasuresThisMachine) {
  const fs::path folder = test_folder();
  const ProgramResult check = run_program({"record", "--check", "--duration", "0.2", "--json"}, folder);
  const json said = json::parse(check.out);
  EXPECT_EQ(check.exit_code, said["fit"] ? 0 : 1) << check.err;
  EXPECT_EQ(said["ticks_elapsed"], 200);
  EXPECT_EQ(said["ticks_elapsed"].get<int>(), said["ticks_recorded"].get<int>() +
                                                  said["ticks_skipped"].get<int>() +
                                                  said["ticks_dropped"].get<int>());
  EXPECT_LE(said["lateness_mean"], said["lateness_max"]);
  const ProgramResult table = run_program({"record", "--check", "--duration", "0.2"}, folder);
  EXPECT_NE(table.out.find("verdict"), std::string::npos) << table.out;
  EXPECT_NE(table.out.find("less than 100 us in 99 of 100"), std::string::npos) << table.out;
}

TEST(CliRecord, CheckHoldsSandAgainstTheory) {
  const fs::path folder = test_folder();
  const auto check = [&](const std::vector<std::string>& more) {
    return run_program(with({"record", "--check", "--duration", "0.05", "--feel", "scene.toml"}, more),
                       folder);
  };
  const json felt = json::parse(check({"--max-force", "3", "--json"}).out)["felt"];
  EXPECT_EQ(felt["force"], 3.0);
  EXPECT_NEAR(felt["sand"]["stiffness"].get<double>(), 0.5 * 1003.0, 1e-9);
  EXPECT_NEAR(felt["sand"]["damping"].get<double>(), 30.0, 1e-12);
  EXPECT_EQ(felt["device"]["damping"], 0.0) << "no device is named";
  const ProgramResult hard = check({"--set", "force.k_f=1000"});
  EXPECT_EQ(hard.exit_code, 1) << hard.out;
  EXPECT_NE(hard.out.find("REFUSED: the hand would shake; set force.k_f = "), std::string::npos) << hard.out;
  const ProgramResult stand_in = check({"--device", "scripted:line.toml", "--set", "force.k_f=1000"});
  EXPECT_NE(stand_in.out.find("no limit to compare with"), std::string::npos) << stand_in.out;
  EXPECT_FALSE(fs::exists(folder / "a.h5"));
}

TEST(CliRecord, RecordsWithoutPermissionForRealTimeAndSaysWhatThatCosts) {
  const fs::path folder = test_folder();
  Conditions refused;
  refused.real_time_refused = true;
  const ProgramResult result =
      run_program(with(record_line, {"--duration", "0.2", "--json"}), folder, refused);
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const json said = json::parse(result.out);
  EXPECT_EQ(said["scheduling"], "SCHED_OTHER");
  EXPECT_EQ(said["memory_locked"], false);
  for (const char* part : {"SCHED_FIFO", "refused", "limits.conf"}) {
    EXPECT_NE(said["scheduling_advice"].get<std::string>().find(part), std::string::npos) << said;
    EXPECT_NE(result.err.find(part), std::string::npos) << result.err;
  }
  const ProgramResult check =
      run_program({"record", "--check", "--duration", "0.2", "--json"}, folder, refused);
  EXPECT_EQ(json::parse(check.out)["scheduling_advice"], said["scheduling_advice"]);
  // Fit or not: what was refused is told.
  const ProgramResult table = run_program({"record", "--check", "--duration", "0.2"}, folder, refused);
  EXPECT_NE(table.out.find("limits.conf"), std::string::npos) << table.out;

  const ProgramResult unasked =
      run_program({"record", "--max-skipped", "100", "-o", "b.h5", "--device", "scripted:line.toml",
                   "--duration", "0.2", "--priority", "0", "--no-memory-lock", "--json"},
                  folder, refused);
  ASSERT_EQ(unasked.exit_code, 0) << unasked.err;
  EXPECT_EQ(json::parse(unasked.out)["scheduling_advice"], "");
  EXPECT_EQ(unasked.err.find("refused"), std::string::npos) << unasked.err;
}

}  // namespace
}  // namespace sandstroke
