#include <filesystem>
#include <memory>

#include "cli/standard_output.h"
#include "cli/stroke_parts.h"
#include "core/error.h"
#include "core/output_file.h"
#include "io/recording_file.h"
#include "io/stroke_file.h"
#include "io/stroke_format.h"
#include "record/journal.h"
#include "record/recording_json.h"

namespace sandstroke {
namespace {

namespace fs = std::filesystem;

struct RepairArguments {
  std::string file, output;
  bool remove = false, json = false;
};

/// The journal to repair, and the stroke to write.
struct Task {
  fs::path journal, output;
};

/// Finds journal and output. arguments.file is STROKE.h5.recording, or the STROKE.h5 to write.
Task task_of(const RepairArguments& arguments) {
  const fs::path file = arguments.file;
  Task task;
  task.journal = file.extension() == journal_extension ? file : journal_path(file);
  task.output = arguments.output;
  if (task.output.empty()) task.output = fs::path(task.journal).replace_extension();
  if (!fs::exists(task.journal))
    throw_io_error("{}: does not exist; name a recording that was cut off, {}", task.journal.string(),
                   journal_path("STROKE.h5").string());
  check_output(task.output, {task.journal}, recording_output);
  return task;
}

struct Repair {
  RecordingInfo recording;
  double duration = 0.0;         // s, from the first sample to the last
  std::uint64_t lost_bytes = 0;  // damaged or cut off in the journal
};

Repair repair(const Task& task) {
  Repair done;
  JournalReader journal(task.journal);
  done.recording = write_recording_file(task.output, journal);
  done.lost_bytes = journal.lost_bytes();
  done.duration = read_stroke_file(task.output).duration();  // also checks that the stroke can be read
  return done;
}

nlohmann::ordered_json describe(const Task& task, const Repair& done, bool removed) {
  nlohmann::ordered_json json = {{"journal", task.journal.string()}, {"journal_removed", removed},
                                 {"output", task.output.string()},   {"complete", done.recording.complete()},
                                 {"duration", done.duration},        {"lost_bytes", done.lost_bytes}};
  json.update(as_json(done.recording.footer));
  return json;
}

std::string lost_text(const Repair& done) {
  std::string text;
  if (done.lost_bytes > 0)
    text = fmt::format("{} bytes after the last complete sample, cut off or damaged (a sample has {}); ",
                       done.lost_bytes, journal_sample_bytes);
  if (done.recording.footer.reason == StopReason::cut_off)
    text +=
        "samples not yet written: about 0.1 s if the program was killed, 1 s if the machine stopped, more if "
        "the disk was slow";
  return text.empty() ? "nothing: the recording was finished" : text;
}

void print_table(const Task& task, const Repair& done, bool removed) {
  const RecordingFooter& footer = done.recording.footer;
  print_row("stroke", task.output.string());
  print_row("samples",
            fmt::format("{}, the last {:.3f} s after the first", footer.ticks.recorded, done.duration));
  print_row("ticks", recorded_ticks_text(footer));
  print_row("ended", stop_reason_text(footer.reason));
  print_row("lost", lost_text(done));
  print_row("journal", fmt::format("{}: {}", task.journal.string(),
                                   removed ? "removed" : "kept; remove it after you checked the stroke"));
}

int repair_command(const RepairArguments& arguments) {
  const Task task = task_of(arguments);
  const Repair done = repair(task);
  std::error_code failure;
  const bool removed = arguments.remove && fs::remove(task.journal, failure);
  if (arguments.json)
    print_json(describe(task, done, removed));
  else
    print_table(task, done, removed);
  if (failure)
    throw_io_error("{}: cannot be removed ({}); the stroke is written, so remove it yourself",
                   task.journal.string(), failure.message());
  return 0;
}

}  // namespace

void add_stroke_repair_command(CLI::App& stroke, Command& chosen) {
  CLI::App* command = stroke.add_subcommand(
      "repair", "Turn a recording that was cut off into a stroke. Report what was lost");
  auto arguments = std::make_shared<RepairArguments>();
  command
      ->add_option("FILE", arguments->file,
                   "Journal of the recording, STROKE.h5.recording; or the stroke's name, STROKE.h5")
      ->type_name("FILE.recording|.h5")
      ->option_text("REQUIRED")
      ->required();
  command->add_option("OUT", arguments->output, "Stroke to write (.h5). Default: STROKE.h5")
      ->type_name("FILE.h5");
  command->add_flag("--remove", arguments->remove, "Remove the journal once the stroke is written");
  command->add_flag("--json", arguments->json, "Print what was done as one JSON object");
  command->footer(
      "A recording in progress is in STROKE.h5.recording. If the program is killed, the machine stops\n"
      "or the disk is full, that file stays. This command turns it into a stroke.\n"
      "Example:  sandstroke stroke repair hand.h5");
  command->callback([&chosen, arguments] { chosen = [arguments] { return repair_command(*arguments); }; });
}

}  // namespace sandstroke
