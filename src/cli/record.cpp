#include <spdlog/spdlog.h>

#include <memory>
#include <optional>

#include "cli/commands.h"
#include "cli/find_device.h"
#include "cli/record_display.h"
#include "cli/record_parts.h"
#include "cli/stop_keys.h"
#include "core/error.h"
#include "core/interrupt.h"
#include "core/output_file.h"
#include "io/recording_file.h"
#include "io/scene_toml.h"
#include "io/stroke_format.h"
#include "io/surface_file.h"
#include "record/journal.h"
#include "record/real_time.h"

namespace sandstroke {
namespace {

namespace fs = std::filesystem;

struct RecordArguments {
  std::string output, device, felt_scene;
  std::vector<std::string> overrides;  // of the felt scene
  RecorderSettings settings;
  double duration = 0.0;     // s; 0: not given
  double rate = 0.0;         // Hz; 0: not given
  int stop_switch = -1;      // not given
  double max_skipped = 1.0;  // percent of the ticks
  bool list = false, check = false, no_memory_lock = false, json = false;
};

// Hz. Slower, the watchdog would take every tick for a stall; faster, no device is.
constexpr double slowest = 100.0, fastest = 10000.0;

/// The rate given, or that at which `run` will play the stroke in the scene that is felt.
double servo_rate(const RecordArguments& arguments, const std::optional<Scene>& felt) {
  if (arguments.rate > 0.0) return arguments.rate;
  if (!felt) return ServoSettings{}.rate;
  const double rate = felt->device.servo_rate;
  if (!(rate >= slowest && rate <= fastest))
    throw_input_error(
        "device.servo_rate: {} Hz is not a rate that can be recorded ({} to {} Hz); set another with --rate",
        rate, slowest, fastest);
  return rate;
}

RecorderSettings recorder_settings(const RecordArguments& arguments, const std::optional<Scene>& felt) {
  RecorderSettings settings = arguments.settings;
  settings.servo.rate = servo_rate(arguments, felt);
  if (arguments.duration > 0.0) settings.servo.duration = arguments.duration;
  if (arguments.stop_switch >= 0) settings.servo.stop_switch = arguments.stop_switch;
  settings.lock_memory = !arguments.no_memory_lock;
  if (!felt) settings.servo.force.max_force = 0.0;  // nothing is felt
  return settings;
}

/// The files that may not be written over, for they are read.
std::vector<fs::path> inputs(const RecordArguments& arguments, const std::optional<Scene>& felt) {
  std::vector<fs::path> files;
  if (const fs::path played = file_played(arguments.device); !played.empty()) files.push_back(played);
  if (!felt) return files;
  files.push_back(arguments.felt_scene);
  if (felt->bed.surface.kind == SurfaceKind::file)
    files.push_back(fs::path(arguments.felt_scene).parent_path() / felt->bed.surface.file);
  return files;
}

RecordingReport record_stroke(HapticDevice& device, FeltWorld* world, const RecorderSettings& settings,
                              RecordingHeader header, const fs::path& output) {
  catch_all_interrupts();
  StopKeys keys;
  RecordDisplay display(keys.listening() ? "; q ends it" : "");
  return record(device, world, settings, std::move(header), journal_path(output),
                [&](const ServoProgress& progress) -> std::optional<StopReason> {
                  display.show(progress);
                  return keys.pressed() ? std::optional(StopReason::key) : std::nullopt;
                });
}

/// The journal goes once the stroke is whole, or where there is nothing in it.
void write_stroke(const fs::path& output, const RecordingFooter& recorded) {
  const fs::path journal = journal_path(output);
  if (recorded.ticks.recorded == 0) {
    fs::remove(journal);
    throw_io_error("{}: was not written, because nothing was recorded: {}", output.string(),
                   stop_reason_text(recorded.reason));
  }
  std::optional<JournalReader> reader;
  try {
    reader.emplace(journal);
  } catch (const Error& failure) {
    throw_io_error("{}; the file was removed or replaced during the recording, so the recording is lost",
                   failure.what());
  }
  try {
    write_recording_file(output, *reader);
  } catch (const Error& failure) {
    throw_io_error("{}. The recording is in {}; make a stroke of it with: sandstroke stroke repair {}",
                   failure.what(), journal.string(), journal.string());
  }
  fs::remove(journal);
}

void warn(const RecordingReport& report, const std::string& output, double max_skipped) {
  const RecordingFooter& footer = report.footer;
  if (!is_complete(footer.reason))
    spdlog::warn("{} is incomplete, because {}; it holds what was recorded until then", output,
                 stop_reason_text(footer.reason));
  const TickCounts& ticks = footer.ticks;
  if (skipped_share(ticks) > 0.01 * max_skipped)
    spdlog::warn(
        "{}: {} of {} ticks were skipped ({:.2g} %, more than --max-skipped {:g}): other programs held the "
        "loop up; end them, lower --rate, or see sandstroke record --check",
        output, ticks.skipped, ticks.elapsed, 100.0 * skipped_share(ticks), max_skipped);
  if (!report.disk_error.empty()) spdlog::warn("{}", report.disk_error);
  if (!report.header.scheduling.advice.empty()) spdlog::warn("{}", report.header.scheduling.advice);
}

int exit_code(const RecordingFooter& footer, double max_skipped) {
  const StopReason reason = footer.reason;
  if (is_complete(reason))
    return is_starved(footer.ticks) && skipped_share(footer.ticks) > 0.01 * max_skipped ? 1 : 0;
  if (reason == StopReason::signal) return 128 + interrupted();
  return static_cast<int>(reason == StopReason::no_number ? ErrorKind::unstable : ErrorKind::io);
}

int record(const RecordArguments& arguments) {
  if ((arguments.list || arguments.check) &&
      !(arguments.output.empty() && arguments.device.empty() && arguments.felt_scene.empty()))
    throw_input_error("record --list and --check record nothing; leave out -o, --device and --feel");
  if (arguments.list) return list_devices(arguments.json);
  if (arguments.check) return check_machine(recorder_settings(arguments, {}), arguments.json);
  if (arguments.output.empty() || arguments.device.empty())
    throw_input_error(
        "record needs -o STROKE.h5 and --device NAME; sandstroke record --list names the devices");

  std::optional<Scene> felt;
  if (!arguments.felt_scene.empty()) felt = load_scene(arguments.felt_scene, arguments.overrides);
  const RecorderSettings settings = recorder_settings(arguments, felt);
  check_output(arguments.output, inputs(arguments, felt), recording_output);
  check_no_journal(journal_path(arguments.output));
  const std::unique_ptr<HapticDevice> device =
      find_device(arguments.device, felt ? felt->force : ForceSettings{});
  RecordingHeader header;
  header.source = arguments.device;
  std::optional<LiveSand> sand;
  if (felt) {
    const fs::path folder = fs::path(arguments.felt_scene).parent_path();
    sand.emplace(*felt, load_surface(felt->bed, folder), device->specification().frame);
    header.felt_scene = scene_text(*felt);
    sand->start();
  }
  const RecordingReport report =
      record_stroke(*device, sand ? &*sand : nullptr, settings, std::move(header), arguments.output);
  write_stroke(arguments.output, report.footer);
  std::optional<LiveSandReport> felt_sand;
  if (sand) felt_sand = sand->finish();
  print_recording(report, felt_sand, arguments.output, arguments.json);
  warn(report, arguments.output, arguments.max_skipped);
  if (felt_sand && felt_sand->contact_ticks == 0)
    spdlog::warn(
        "the tool never touched the sand; move its positions with --set stroke.offset and stroke.scale");
  return exit_code(report.footer, arguments.max_skipped);
}

CLI::Validator recording_rate() {
  return CLI::Validator(
      [](std::string& text) -> std::string {
        double rate = 0.0;
        return CLI::detail::lexical_cast(text, rate) && rate >= slowest && rate <= fastest
                   ? ""
                   : fmt::format("{} is not a number of {} to {}", text, slowest, fastest);
      },
      fmt::format("{} to {}", slowest, fastest));
}

/// What the hand feels while it is recorded.
void add_force_options(CLI::App& app, RecordArguments& arguments) {
  ForceLimits& force = arguments.settings.servo.force;
  auto* feel = app.add_option("--feel", arguments.felt_scene,
                              "Scene whose sand the hand feels. A run of the recorded stroke in it has the "
                              "same sand and forces. Without this option no force is given")
                   ->type_name("FILE.toml")
                   ->option_text("SCENE.toml");
  add_set_option(app, arguments.overrides)->needs(feel);
  app.add_option("--max-force", force.max_force,
                 "Largest force on the hand [N]. Default: the limit of the device or the scene")
      ->check(not_negative_number())
      ->option_text("N")
      ->needs(feel);
  app.add_option("--force-ramp", force.ramp, "Time over which the force grows to full [s]")
      ->check(not_negative_number())
      ->capture_default_str()
      ->needs(feel);
  app.add_option("--force-rate", force.rate, "Largest change of the force [N/s], also after a late tick")
      ->check(positive_number())
      ->capture_default_str()
      ->needs(feel);
}

}  // namespace

void add_record_command(CLI::App& app, Command& chosen) {
  CLI::App* command = app.add_subcommand(
      "record", "Record a stroke from a haptic device, or from a stand-in that plays a stroke");
  auto arguments = std::make_shared<RecordArguments>();
  RecorderSettings& settings = arguments->settings;
  settings.servo.force.max_force = any_force;
  command->add_option("-o,--output", arguments->output, "Stroke to write (.h5)")
      ->type_name("FILE.h5")
      ->option_text("STROKE.h5");
  command
      ->add_option("--device", arguments->device,
                   "chai3d, chai3d:N, scripted:FILE.toml or replay:FILE.h5 (see --list)")
      ->type_name("{chai3d,replay:,scripted:}")
      ->option_text("NAME");
  auto* list = command->add_flag("--list", arguments->list, "List devices and stand-ins");
  auto* check = command->add_flag(
      "--check", arguments->check,
      "Measure how well this machine keeps the loop's rate. Needs no device. Takes 10 s, or --duration");
  list->excludes(check);
  command
      ->add_option("--duration", arguments->duration,
                   "Length of the recording [s]. Default: until its stroke, q or --stop-switch ends it")
      ->check(positive_number())
      ->option_text("S");
  command
      ->add_option("--rate", arguments->rate,
                   "Rate of the loop [Hz]. Default: 1000, or with --feel the scene's device.servo_rate")
      ->check(recording_rate())
      ->option_text("HZ");
  command
      ->add_option("--stop-switch", arguments->stop_switch,
                   "Switch of the device that ends the recording, counted from 0")
      ->check(CLI::Range(0, 31))
      ->option_text("K");
  command
      ->add_option("--max-skipped", arguments->max_skipped,
                   "Share of skipped ticks [%] above which there is a warning. Above 10 % too, the stroke is "
                   "marked starved and the exit code is 1")
      ->check(CLI::Range(0.0, 100.0))
      ->capture_default_str()
      ->option_text("PERCENT");
  add_force_options(*command, *arguments);
  command->add_flag("--calibrate", settings.calibrate,
                    "Calibrate the device first. THIS MAY MOVE ITS ARM: keep clear");
  command
      ->add_option("--priority", settings.priority,
                   fmt::format("Real-time priority (SCHED_FIFO) of the loop, 1 to {}. 0 asks for none",
                               highest_loop_priority))
      ->check(CLI::Range(0, highest_loop_priority))
      ->capture_default_str();
  command->add_flag("--no-memory-lock", arguments->no_memory_lock, "Do not lock the memory of the program");
  command->add_flag("--json", arguments->json, "One JSON object in SI units instead of a table");
  command->footer(
      "A recording is complete if a time, its stroke, a switch or a key (q, Esc, Enter, space) ends it.\n"
      "If anything else ends it, such as Ctrl-C, it is kept and marked incomplete.\n"
      "After kill -9 or a power failure it is in STROKE.h5.recording.\n"
      "Save it with: sandstroke stroke repair STROKE.h5\n"
      "Example:  sandstroke record --device scripted:strokes/wscg/stroke.toml -o hand.h5");
  command->callback([arguments, &chosen] { chosen = [arguments] { return record(*arguments); }; });
}

}  // namespace sandstroke
