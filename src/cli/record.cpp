#include <spdlog/spdlog.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <utility>

#include "cli/commands.h"
#include "cli/find_device.h"
#include "cli/record_display.h"
#include "cli/record_parts.h"
#include "cli/record_view.h"
#include "cli/stop_keys.h"
#include "core/error.h"
#include "core/interrupt.h"
#include "core/output_file.h"
#include "io/mesh_file.h"
#include "io/recording_file.h"
#include "io/scene_toml.h"
#include "io/stroke_format.h"
#include "io/surface_file.h"
#include "record/felt_loop_text.h"
#include "record/journal.h"
#include "record/real_time.h"
#include "sim/tool_fit.h"

namespace sandstroke {
namespace {

namespace fs = std::filesystem;

struct RecordArguments {
  std::string output, device, felt_scene;
  std::vector<std::string> overrides;  // settings for the felt scene
  RecorderSettings settings;
  double duration = 0.0;                    // s; 0: not given
  double rate = 0.0;                        // Hz; 0: not given
  int start_switch = -1, stop_switch = -1;  // not given
  double max_skipped = 1.0;                 // % of the ticks
  bool list = false, check = false, no_memory_lock = false, json = false;
  bool view = false, no_open = false;
};

// Hz. Below it the watchdog would take every tick for a stall. No device is faster.
constexpr double slowest = 100.0, fastest = 10000.0;

/// The given rate, or the rate at which `run` will play the stroke in the felt scene.
double servo_rate(const RecordArguments& arguments, const std::optional<SceneFile>& felt) {
  if (arguments.rate > 0.0) return arguments.rate;
  if (!felt) return ServoSettings{}.rate;
  const double rate = felt->device.servo_rate;
  if (!(rate >= slowest && rate <= fastest))
    throw_input_error(
        "device.servo_rate: {} Hz is outside the recordable range ({} to {} Hz); choose a rate with --rate",
        rate, slowest, fastest);
  return rate;
}

RecorderSettings recorder_settings(const RecordArguments& arguments, const std::optional<SceneFile>& felt) {
  RecorderSettings settings = arguments.settings;
  settings.servo.rate = servo_rate(arguments, felt);
  if (arguments.duration > 0.0) settings.servo.duration = arguments.duration;
  if (arguments.device == pointer_name) {
    settings.servo.stop_switch = PointerSample::finish_switch;
    settings.servo.switch_reason = StopReason::finish;
  }
  if (arguments.start_switch >= 0) settings.servo.start.start_switch = arguments.start_switch;
  if (arguments.stop_switch >= 0) {
    settings.servo.stop_switch = arguments.stop_switch;
    settings.servo.switch_reason = StopReason::stop_switch;
  }
  if (arguments.view) settings.watch = picture_interval;
  settings.lock_memory = !arguments.no_memory_lock;
  if (!felt) settings.servo.force.max_force = 0.0;  // without sand there is no force
  return settings;
}

/// The files that the command reads and must not overwrite.
std::vector<fs::path> inputs(const RecordArguments& arguments, const std::optional<SceneFile>& felt) {
  std::vector<fs::path> files;
  if (const fs::path played = file_played(arguments.device); !played.empty()) files.push_back(played);
  if (!felt) return files;
  files.push_back(arguments.felt_scene);
  if (felt->bed.surface.kind == SurfaceKind::file)
    files.push_back(fs::path(arguments.felt_scene).parent_path() / felt->bed.surface.file);
  return files;
}

RecordingReport record_stroke(HapticDevice& device, FeltWorld* world, const RecorderSettings& settings,
                              RecordingHeader header, const fs::path& output, RecordView* view) {
  StopKeys keys;
  RecordDisplay display(keys.listening() ? "; q ends it" : "");
  double shown = -1.0;  // tenths of a second
  return record(device, world, settings, std::move(header), journal_path(output),
                [&](const ServoProgress& progress) -> std::optional<StopReason> {
                  if (view) view->show(progress);
                  const double tenth = std::floor(10.0 * progress.time);
                  if (tenth != shown) display.show(progress);
                  shown = tenth;
                  return keys.pressed() ? std::optional(StopReason::key) : std::nullopt;
                });
}

/// Writes the stroke, then removes the journal. Also removes a journal without samples.
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
  if (skipped_fraction(ticks) > 0.01 * max_skipped)
    spdlog::warn(
        "{}: {} of {} ticks were skipped ({:.2g} %, more than --max-skipped {:g}), because other programs "
        "delayed the loop; close them, lower --rate, or see sandstroke record --check",
        output, ticks.skipped, ticks.elapsed, 100.0 * skipped_fraction(ticks), max_skipped);
  if (!report.disk_error.empty()) spdlog::warn("{}", report.disk_error);
  if (!report.header.scheduling.advice.empty()) spdlog::warn("{}", report.header.scheduling.advice);
}

int exit_code(const RecordingFooter& footer, double max_skipped) {
  const StopReason reason = footer.reason;
  if (is_complete(reason))
    return is_starved(footer) && skipped_fraction(footer.ticks) > 0.01 * max_skipped ? 1 : 0;
  if (reason == StopReason::signal) return 128 + interrupted();
  return static_cast<int>(reason == StopReason::no_number ? ErrorKind::unstable : ErrorKind::io);
}

/// Makes the named device. start: the felt scene's bed, which a pointer needs; none without --feel.
std::unique_ptr<HapticDevice> named_device(const RecordArguments& arguments,
                                           const std::optional<SceneFile>& felt,
                                           const std::optional<HeightField>& start, LoopClock& clock) {
  if (arguments.device != pointer_name)
    return find_device(arguments.device, felt ? felt->force : ForceSettings{});
  return std::make_unique<PointerDevice>(*felt, *start, clock);
}

/// The scene whose sand the hand feels. None without --feel.
std::optional<SceneFile> felt_scene(const RecordArguments& arguments) {
  if (arguments.felt_scene.empty()) return std::nullopt;
  SceneFile scene = load_scene(arguments.felt_scene, arguments.overrides);
  const PluginLawSettings& own = scene.plugin_laws;
  for (const auto& [key, name] : {std::pair("relaxation", own.relaxation),
                                  std::pair("displacement", own.displacement), std::pair("force", own.force)})
    if (!name.empty())
      throw_input_error(
          "{}: model.{} = \"{}\" is a plugin law, which record --feel does not take, because its run time is "
          "unknown; remove it from the scene",
          arguments.felt_scene, key, name);
  if (!scene.ground.empty())
    throw_input_error(
        "{}: has a bed.floor, a [[stone]], a [sand.map], a [[sand.region]] or a [[sand.layer]], which record "
        "--feel does not know yet; remove them from the scene",
        arguments.felt_scene);
  if (scene.moisture)
    throw_input_error(
        "{}: has a [moisture], which record --feel does not know yet: a wall that fails takes longer than a "
        "tick; remove it from the scene",
        arguments.felt_scene);
  if (scene.tool.carries)
    throw_input_error("{}: has tool.carries, which record --feel does not know yet; remove it from the scene",
                      arguments.felt_scene);
  if (!scene.sources.empty())
    throw_input_error(
        "{}: record --feel takes no [[source]], because its servo loop only moves what the tool moves; "
        "remove it from the scene",
        arguments.felt_scene);
  scene.tool = with_mesh(scene.tool, fs::path(arguments.felt_scene).parent_path());
  check_tool_fits(scene, arguments.felt_scene);
  return scene;
}

int check(const RecordArguments& arguments) {
  if (!arguments.output.empty()) throw_input_error("record --check records nothing; leave out -o");
  if (!arguments.device.empty() && arguments.felt_scene.empty())
    throw_input_error(
        "record --check needs no device; leave out --device, or add --feel SCENE to compare the sand with "
        "the device's limits");
  const std::optional<SceneFile> felt = felt_scene(arguments);
  DeviceSpecification device;
  device.max_force = std::numeric_limits<double>::infinity();  // without --device the scene's limit holds
  if (arguments.device == pointer_name)
    device.max_force = 0.0;
  else if (!arguments.device.empty())
    device = find_device(arguments.device, felt->force)->specification();
  return check_machine(recorder_settings(arguments, felt), felt, device, arguments.json);
}

int record(const RecordArguments& arguments) {
  if (arguments.list &&
      !(arguments.output.empty() && arguments.device.empty() && arguments.felt_scene.empty()))
    throw_input_error("record --list records nothing; leave out -o, --device and --feel");
  if (arguments.list) return list_devices(arguments.json);
  if (!(arguments.max_skipped >= 0.0)) throw_input_error("--max-skipped: give a percentage from 0 to 100");
  if (arguments.no_open && !arguments.view)
    throw_input_error("--no-open: there is no view to open; leave it out, or add --view");
  if (arguments.check) return check(arguments);
  if (arguments.output.empty() || arguments.device.empty())
    throw_input_error(
        "record needs -o STROKE.h5 and --device NAME; sandstroke record --list names the devices");

  if (arguments.view && arguments.felt_scene.empty())
    throw_input_error(
        "record --view and --device pointer show and shape the sand of a scene; name it with --feel "
        "SCENE.toml");

  std::optional<SceneFile> felt = felt_scene(arguments);
  const RecorderSettings settings = recorder_settings(arguments, felt);
  check_output(arguments.output, inputs(arguments, felt), recording_output);
  check_no_journal(journal_path(arguments.output));
  MonotonicClock clock;
  std::optional<HeightField> bed;
  if (felt) bed = load_surface(felt->bed, fs::path(arguments.felt_scene).parent_path());
  const std::unique_ptr<HapticDevice> device = named_device(arguments, felt, bed, clock);
  if (felt)
    if (const std::optional<FeltLoop> loop =
            felt_loop(*felt, device->specification(), settings.servo.force.max_force, settings.servo.rate))
      check_felt_loop(*loop, *felt, arguments.felt_scene);
  catch_all_interrupts();
  RecordingHeader header;
  header.source = arguments.device;
  std::optional<RecordView> view;
  std::optional<LiveSand> sand;
  if (felt) {
    const double largest = largest_force(*felt, device->specification(), settings.servo.force.max_force);
    const DeviceSpecification& is = device->specification();
    sand.emplace(*felt, *bed, FeltDevice{is.frame, largest, is.measures_orientation});
    header.felt_scene = scene_text(*felt);
    if (arguments.view) {
      view.emplace(fs::path(arguments.output).filename().string(), *felt, *bed, largest,
                   dynamic_cast<PointerDevice*>(device.get()), !arguments.no_open);
      view->follow(*sand);
    }
    sand->start();
  }
  const RecordingReport report = record_stroke(*device, sand ? &*sand : nullptr, settings, std::move(header),
                                               arguments.output, view ? &*view : nullptr);
  write_stroke(arguments.output, report.footer);
  std::optional<LiveSandReport> felt_sand;
  if (sand) felt_sand = sand->finish();
  if (view) view->end(stop_reason_text(report.footer.reason));
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
                   : fmt::format("{} is not a number from {} to {}", text, slowest, fastest);
      },
      fmt::format("{} to {}", slowest, fastest));
}

void add_switch(CLI::App& app, const char* name, int& number, const char* help) {
  app.add_option(name, number, help)->check(CLI::Range(0, 31))->option_text("K");
}

/// Adds the options for the beginning and end of the recording.
void add_time_options(CLI::App& app, RecordArguments& arguments) {
  StartSettings& start = arguments.settings.servo.start;
  app.add_option(
         "--duration", arguments.duration,
         "Length of the recording [s]. Default: until the end of the played stroke, q or --stop-switch")
      ->check(positive_number())
      ->option_text("S");
  app.add_option("--countdown", start.countdown,
                 "Seconds until the recording begins. The stroke contains nothing from before")
      ->check(not_negative_number())
      ->option_text("S");
  add_switch(app, "--start-switch", arguments.start_switch,
             "Switch of the device that begins the recording, counted from 0");
  app.add_flag("--start-at-contact", start.at_contact,
               "Begin a tick before the tool touches the sand from above")
      ->needs("--feel");
  add_switch(app, "--stop-switch", arguments.stop_switch,
             "Switch of the device that ends the recording, counted from 0");
  app.add_option("--max-skipped", arguments.max_skipped,
                 "Percentage of skipped ticks above which record warns. If it is also above 10 %, the stroke "
                 "is marked starved and the exit code is 1")
      ->check(CLI::Range(0.0, 100.0))
      ->capture_default_str()
      ->option_text("PERCENT");
}

/// Adds the options for the force on the hand.
void add_force_options(CLI::App& app, RecordArguments& arguments) {
  ForceLimits& force = arguments.settings.servo.force;
  auto* feel = app.add_option("--feel", arguments.felt_scene,
                              "Scene whose sand the hand feels. A run of the recorded stroke in it has the "
                              "same sand and forces. Without this option no force is given")
                   ->type_name("FILE.toml")
                   ->option_text("SCENE.toml");
  add_set_option(app, arguments.overrides)->needs(feel);
  app.get_option("--unset")->needs(feel);
  app.add_option("--max-force", force.max_force,
                 "Largest force on the hand [N]. Default: the limit of the device or the scene")
      ->check(not_negative_number())
      ->option_text("N")
      ->needs(feel);
  app.add_option("--force-ramp", force.ramp,
                 "Time in which the force grows to its full value, after the tool was out of the sand [s]")
      ->check(not_negative_number())
      ->capture_default_str()
      ->needs(feel);
  app.add_option("--force-rate", force.rate, "Largest change of the force [N/s], also after a late tick")
      ->check(positive_number())
      ->capture_default_str()
      ->needs(feel);
}

constexpr const char* record_footer =
    "A recording is complete if a time, its stroke, a switch or a key (q, Esc, Enter, space) ends it.\n"
    "If anything else ends it, such as Ctrl-C, it is kept and marked incomplete.\n"
    "After kill -9 or a power failure it is in STROKE.h5.recording.\n"
    "Save it with: sandstroke stroke repair STROKE.h5\n"
    "With --feel there is no force until the tool was out of the sand once. record refuses sand in which\n"
    "the hand and the device would shake. It judges by the largest force, the rate, and the scene's\n"
    "device.mass, device.damping, device.hand_stiffness and device.hand_damping: set them to your\n"
    "device's values.\n"
    "Examples:  sandstroke record --device scripted:strokes/wscg/stroke.toml -o hand.h5\n"
    "           sandstroke record --device pointer --feel strokes/wscg/scene.toml -o hand.h5";

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
                   "chai3d, chai3d:N, pointer, scripted:FILE.toml or replay:FILE.h5 (see --list). pointer is "
                   "the mouse, pen or finger in the page of --view; it needs --feel")
      ->type_name("{chai3d,pointer,replay:,scripted:}")
      ->option_text("NAME");
  auto* list = command->add_flag("--list", arguments->list, "List devices and stand-ins");
  auto* check = command->add_flag(
      "--check", arguments->check,
      "Measure how well this machine keeps the loop's rate. Takes 10 s, or --duration. With --feel, also "
      "compare the sand with the limits of --device and of theory. Does not move the device");
  list->excludes(check);
  command
      ->add_option("--rate", arguments->rate,
                   "Rate of the loop [Hz]. Default: 1000, or with --feel the scene's device.servo_rate")
      ->check(recording_rate())
      ->option_text("HZ");
  add_force_options(*command, *arguments);
  command->add_flag("--view", arguments->view,
                    "Wait until a page is open in a browser, and show the sand of --feel live in it. Prints "
                    "the address, and opens it on a desktop");
  command->add_flag("--no-open", arguments->no_open, "Print the address of --view, but do not open it");
  add_time_options(*command, *arguments);
  command->add_flag("--calibrate", settings.calibrate,
                    "Calibrate the device first. THIS MAY MOVE ITS ARM: keep clear");
  command->add_flag(
      "--allow-uncalibrated", settings.allow_uncalibrated,
      "Give forces on a device that says it is not calibrated. They may push where there is no sand");
  command
      ->add_option("--priority", settings.priority,
                   fmt::format("Real-time priority (SCHED_FIFO) of the loop, 1 to {}. 0 asks for none",
                               highest_loop_priority))
      ->check(CLI::Range(0, highest_loop_priority))
      ->capture_default_str();
  command->add_flag("--no-memory-lock", arguments->no_memory_lock, "Do not lock the memory of the program");
  command->add_flag("--json", arguments->json, "One JSON object in SI units instead of a table");
  command->footer(record_footer);
  command->callback([arguments, &chosen] {
    if (arguments->device == pointer_name) arguments->view = true;
    chosen = [arguments] { return record(*arguments); };
  });
}

}  // namespace sandstroke
