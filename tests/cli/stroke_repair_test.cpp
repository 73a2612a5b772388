#include <gmock/gmock-matchers.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <nlohmann/json.hpp>

#include "cli/program.h"
#include "io/recording_file.h"
#include "io/stroke_file.h"
#include "record/journal.h"
#include "record/made_recording.h"
#include "sanitized.h"

namespace sandstroke {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;

/// A hand that draws a line 4 mm deep, a tick at a time, without tick 50.
std::vector<RecordedSample> line() {
  std::vector<RecordedSample> samples;
  for (std::uint64_t tick = 0; tick < 300; ++tick) {
    if (tick == 50) continue;
    RecordedSample sample;
    sample.sequence = tick;
    sample.time = 5000000000 + static_cast<std::int64_t>(tick) * 1000000;
    sample.position[0] = -0.05 + 0.0003 * static_cast<double>(tick);
    sample.position[2] = -0.004;
    samples.push_back(sample);
  }
  return samples;
}

RecordingHeader bed_header() {
  RecordingHeader header = full_header();
  header.device.frame = "bed";
  return header;
}

/// A journal with the line in it; with a footer, where one is given.
fs::path write_journal(const fs::path& path, const std::optional<RecordingFooter>& footer = {}) {
  JournalWriter journal(path, bed_header());
  journal.append(line());
  if (footer) journal.finish(*footer);
  return path;
}

RecordingFooter line_footer(StopReason reason = StopReason::key) {
  RecordingFooter footer;
  footer.ticks.elapsed = 300;
  footer.ticks.recorded = 299;
  footer.ticks.unread = 1;
  footer.lateness = {1e-6, 2e-6, 3e-6};
  footer.reason = reason;
  return footer;
}

nlohmann::json parsed(const ProgramResult& result) {
  EXPECT_EQ(result.exit_code, 0) << result.err;
  return nlohmann::json::parse(result.out);
}

TEST(CliStrokeRepair, AKilledRecordingCanBePlayed) {
  const fs::path folder = test_folder();
  int ready[2];
  ASSERT_EQ(pipe(ready), 0);
  const pid_t child = fork();
  if (child == 0) {
    JournalWriter journal(folder / "hand.h5.recording", bed_header());
    journal.append(line());
    if (write(ready[1], "", 1) != 1) _exit(1);
    while (true) pause();
  }
  char told = 0;
  ASSERT_EQ(read(ready[0], &told, 1), 1);
  const ProgramResult early = run_program({"stroke", "repair", "hand.h5"}, folder);
  EXPECT_EQ(early.exit_code, 4);
  EXPECT_THAT(early.err, AllOf(HasSubstr("hand.h5.recording"), HasSubstr("still being recorded")));
  kill(child, SIGKILL);
  int status = 0;
  ASSERT_EQ(waitpid(child, &status, 0), child);

  const ProgramResult unrepaired =
      run_program({"run", "scene.toml", "--stroke", "hand.h5.recording", "-o", "a.h5"}, folder);
  EXPECT_EQ(unrepaired.exit_code, 2);
  EXPECT_THAT(unrepaired.err, AllOf(HasSubstr("hand.h5.recording"), HasSubstr("stroke repair")));

  const ProgramResult repair = run_program({"stroke", "repair", "hand.h5"}, folder);
  EXPECT_EQ(repair.exit_code, 0) << repair.err;
  EXPECT_THAT(repair.out,
              AllOf(HasSubstr("299, the last 0.299 s after"), HasSubstr("299 recorded, 1 missing"),
                    HasSubstr("cut off"), HasSubstr("not yet written"), HasSubstr("kept")));
  EXPECT_TRUE(fs::exists(folder / "hand.h5.recording")) << "nothing of the user's is removed unasked";

  const ProgramResult run =
      run_program({"run", "scene.toml", "--stroke", "hand.h5", "-o", "a.h5", "--json"}, folder);
  EXPECT_GT(parsed(run)["contact_ticks"], 250);
  EXPECT_THAT(run.err, AllOf(HasSubstr("hand.h5"), HasSubstr("cut off")));
  EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1) << run.err;
}

TEST(CliStrokeRepair, SaysWhatIsLost) {
  const fs::path folder = test_folder();
  const fs::path journal = write_journal(folder / "hand.h5.recording");
  fs::resize_file(journal, fs::file_size(journal) - 2 * journal_sample_bytes -
                               1);  // 297 samples from the front, but a byte
  const nlohmann::json told =
      parsed(run_program({"stroke", "repair", "hand.h5.recording", "out.h5", "--json"}, folder));
  EXPECT_EQ(told["ticks_recorded"], 296);
  EXPECT_EQ(told["ticks_elapsed"], 297);
  EXPECT_EQ(told["ticks_skipped"], 1);
  EXPECT_EQ(told["lost_bytes"], journal_sample_bytes - 1);
  EXPECT_EQ(told["duration"], 0.296);
  EXPECT_EQ(told["complete"], false);
  EXPECT_EQ(told["stop_reason"], "cut off");
  EXPECT_TRUE(told["lateness_mean"].is_null());
  EXPECT_EQ(read_stroke_file(folder / "out.h5").size(), 296u);
  EXPECT_FALSE(fs::exists(folder / "hand.h5"));

  const ProgramResult again = run_program({"stroke", "repair", "hand.h5.recording"}, folder);
  EXPECT_THAT(again.out,
              AllOf(HasSubstr("143 bytes after the last complete sample"), HasSubstr("a sample has 144")));
}

TEST(CliStrokeRepair, AFinishedJournalBecomesACompleteStroke) {
  const fs::path folder = test_folder();
  write_journal(folder / "hand.h5.recording", line_footer());
  const ProgramResult repair = run_program({"stroke", "repair", "hand.h5", "--remove"}, folder);
  EXPECT_EQ(repair.exit_code, 0) << repair.err;
  EXPECT_THAT(repair.out, AllOf(HasSubstr("nothing: the recording was finished"), HasSubstr("removed"),
                                HasSubstr("a key was pressed")));
  EXPECT_FALSE(fs::exists(folder / "hand.h5.recording"));
  EXPECT_TRUE(read_recording_info(folder / "hand.h5")->complete());
  const ProgramResult run = run_program({"run", "scene.toml", "--stroke", "hand.h5", "-o", "a.h5"}, folder);
  EXPECT_EQ(run.exit_code, 0);
  EXPECT_EQ(run.err, "") << "nothing to warn of";
}

TEST(CliStrokeRepair, AFullDiskLeavesTheJournal) {
  if (threads_sanitized) GTEST_SKIP() << "the sanitizer's own memory is a file";
  const fs::path folder = test_folder();
  const std::string before = read_file(write_journal(folder / "hand.h5.recording", line_footer()));
  Conditions full;
  full.most_file_bytes = 10000;
  const ProgramResult repair = run_program({"stroke", "repair", "hand.h5", "--remove"}, folder, full);
  EXPECT_EQ(repair.exit_code, 4);
  EXPECT_THAT(repair.err, AllOf(HasSubstr("hand.h5"), HasSubstr("free disk space")));
  EXPECT_FALSE(fs::exists(folder / "hand.h5"));
  EXPECT_EQ(read_file(folder / "hand.h5.recording"), before);
  EXPECT_EQ(run_program({"stroke", "repair", "hand.h5", "--remove"}, folder).exit_code, 0);
  EXPECT_EQ(read_stroke_file(folder / "hand.h5").size(), 299u);
}

TEST(CliStrokeRepair, RefusesWhatItCannotDo) {
  const fs::path folder = test_folder();
  const auto refused = [&](const std::vector<std::string>& arguments, int exit_code,
                           const testing::Matcher<const std::string&>& sentence) {
    std::vector<std::string> command = {"stroke", "repair"};
    command.insert(command.end(), arguments.begin(), arguments.end());
    const ProgramResult result = run_program(command, folder);
    EXPECT_EQ(result.exit_code, exit_code) << result.err;
    EXPECT_THAT(result.err, sentence);
    EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
  };
  refused({"absent.h5"}, 4, AllOf(HasSubstr("absent.h5.recording"), HasSubstr("does not exist")));
  write_journal(folder / "hand.h5.recording");
  write_file(folder / "hand.h5", "an earlier one");
  refused({"hand.h5"}, 2, AllOf(HasSubstr("hand.h5: already exists"), HasSubstr("another file")));
  EXPECT_EQ(read_file(folder / "hand.h5"), "an earlier one");
  refused({"hand.h5", "hand.h5.recording"}, 2, HasSubstr("named twice"));
  refused({"hand.h5", "no/folder/a.h5"}, 4, HasSubstr("make it first"));
  write_file(folder / "text.recording", "no journal at all, but some text");
  refused({"text.recording"}, 2, HasSubstr("not the journal of a recording"));
  EXPECT_FALSE(fs::exists(folder / "text"));
  JournalWriter(folder / "empty.h5.recording", full_header());
  refused({"empty.h5"}, 2, AllOf(HasSubstr("empty.h5"), HasSubstr("no sample")));
  EXPECT_FALSE(fs::exists(folder / "empty.h5"));
  EXPECT_TRUE(fs::exists(folder / "empty.h5.recording"));
}

TEST(CliStrokeRepair, InfoTellsOfTheRecording) {
  const fs::path folder = test_folder();
  write_journal(folder / "hand.h5.recording", line_footer(StopReason::device_lost));
  ASSERT_EQ(run_program({"stroke", "repair", "hand.h5"}, folder).exit_code, 0);
  const nlohmann::json told = parsed(run_program({"stroke", "info", "hand.h5", "--json"}, folder));
  EXPECT_EQ(told["samples"], 299);
  EXPECT_EQ(told["complete"], false);
  const nlohmann::json& recording = told["recording"];
  EXPECT_EQ(recording["device_model"], full_header().device.model);
  EXPECT_EQ(recording["scheduling"], "SCHED_FIFO");
  EXPECT_EQ(recording["nominal_rate"], 999.5);
  EXPECT_DOUBLE_EQ(recording["rate"], 298 / 0.299);
  EXPECT_EQ(recording["ticks_unread"], 1);
  EXPECT_EQ(recording["lateness_max"], 3e-6);
  EXPECT_EQ(recording["stop_reason"], "the device no longer answered");
  const std::string table = run_program({"stroke", "info", "hand.h5"}, folder).out;
  EXPECT_THAT(table, AllOf(HasSubstr(full_header().device.model), HasSubstr("SCHED_FIFO 80"),
                           HasSubstr("999.5 Hz asked"), HasSubstr("1 unread"),
                           HasSubstr("no: the device no longer answered")));

  ASSERT_EQ(run_program({"stroke", "script", "line.toml", "line.h5"}, folder).exit_code, 0);
  EXPECT_FALSE(parsed(run_program({"stroke", "info", "line.h5", "--json"}, folder)).contains("recording"));
  const ProgramResult info = run_program({"info", "line.h5"}, folder);
  EXPECT_EQ(info.exit_code, 2);
  EXPECT_THAT(info.err, AllOf(HasSubstr("is a stroke"), HasSubstr("sandstroke stroke info line.h5")));
}

}  // namespace
}  // namespace sandstroke
