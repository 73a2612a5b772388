#include "io/run_writer.h"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <numeric>
#include <type_traits>
#include <utility>

#include "core/hash.h"
#include "core/output_file.h"
#include "core/version.h"
#include "io/bed_floor.h"
#include "io/bed_writer.h"
#include "io/input_kind.h"
#include "io/run_file.h"
#include "io/sand_map_file.h"
#include "io/scene_toml.h"
#include "sand/instruction_set.h"
#include "sim/plugin_laws.h"

namespace sandstroke {
namespace {

constexpr std::chrono::milliseconds time_per_flush{500};  // what a killed run can lose
constexpr const char *provenance = "/provenance", *final_surface = "/surface/final",
                     *error_surface = "/surface/error";
constexpr double bytes_per_frame = 1800.0;  // at least, if nothing changes
// The clock is read after so many rows, because a tick may take microseconds. No more rows are kept than a
// chunk has.
constexpr std::size_t rows_per_look = 1024, most_rows_kept = 4 * rows_per_look;

/// The type of the field of(record) of a record.
template <class Record, class Of>
using FieldOf = std::decay_t<std::invoke_result_t<Of, Record&>>;

/// The type of number that a field is stored as.
template <class Field>
using StoredAs = std::conditional_t<std::is_same_v<Field, bool>, std::uint8_t, Field>;

/// Makes a growing dataset for a field of records, over their times.
template <class Record, class Of>
Hdf5Column column_of(Hdf5GridWriter& file, const std::string& group, const FieldText& field, const Of&) {
  using Field = FieldOf<Record, Of>;
  constexpr std::size_t components = components_of<Field>().size();
  const std::string name = group + "/" + field.name, time = group + "/time",
                    axis = group + (components == 4 ? "/component" : "/axis");
  Hdf5Column column;
  if constexpr (components > 0)
    column = file.column(name, components);
  else
    column = file.column<StoredAs<Field>>(name);
  file.describe(name, field.units, field.meaning);
  if constexpr (std::is_same_v<Field, bool>) file.attribute(name, "dtype", "bool");  // for xarray
  if (name == time)
    file.make_scale(time);
  else
    file.attach_scales(name, components > 0 ? std::vector{time, axis} : std::vector{time});
  return column;
}

/// Appends of(record) for all records.
template <class Record, class Of>
void append(Hdf5Column& column, const std::vector<Record>& records, const Of& of) {
  using Field = FieldOf<Record, Of>;
  if constexpr (!components_of<Field>().empty()) {
    std::vector<double> rows;
    for (const Record& record : records) rows.insert(rows.end(), of(record).begin(), of(record).end());
    column.append(rows.data(), records.size());
  } else {
    std::vector<StoredAs<Field>> rows;
    for (const Record& record : records) rows.push_back(of(record));
    column.append(rows.data(), records.size());
  }
}

/// Visits those of visit_tick_fields() that a run has.
template <class Visit>
void visit_trace(const TraceContent& content, const Visit& visit) {
  visit_tick_fields([&](const FieldText& field, const auto& of) {
    if (!field.only_with || content.*field.only_with) visit(field, of);
  });
}

void write_tool_mesh(Hdf5GridWriter& file, const TriangleMesh& mesh) {
  file.write("/tool/vertices", mesh.vertices);
  file.describe("/tool/vertices", "m", "vertices of the tool's surface in the tool's frame: x, y, z");
  Hdf5Column triangles = file.column<std::int32_t>("/tool/triangles", 3);
  triangles.append(mesh.triangles.data()->data(), mesh.triangles.size());
  file.describe(
      "/tool/triangles", "",
      "triangles of the tool's surface: rows of their corners in vertices, counterclockwise from outside");
}

std::string source_scale() { return std::string(source_group) + "/source"; }

/// A column per field, and a row per source, counted from 1.
void write_sources(Hdf5GridWriter& file, const std::vector<SourceLedger>& sources) {
  std::vector<double> number(sources.size());
  std::iota(number.begin(), number.end(), 1.0);
  file.write_scale(source_scale(), number, "", "which [[source]] of the scene");
  visit_source_fields([&](const FieldText& field, const auto& of) {
    const std::string name = std::string(source_group) + "/" + field.name;
    std::vector<double> column;
    for (const SourceLedger& source : sources) column.push_back(of(source));
    file.write(name, column);
    file.describe(name, field.units, field.meaning);
    file.attach_scales(name, {source_scale()});
  });
}

void remove_sources(Hdf5GridWriter& file) {
  visit_source_fields([&](const FieldText& field, const auto&) {
    file.remove(std::string(source_group) + "/" + field.name, {source_scale()});
  });
  file.remove(source_group);
}

void write_load(Hdf5GridWriter& file, const LoadLedger& load) {
  file.make_group(load_group);
  visit_load_fields(
      [&](const FieldText& field, const auto& of) { file.attribute(load_group, field.name, of(load)); });
}

}  // namespace

double least_bytes(const Simulation& simulation) {
  const Scene& scene = simulation.scene();
  double per_tick = 0.0;
  visit_trace(simulation.trace_content(), [&](auto, const auto& of) {
    per_tick += static_cast<double>(sizeof(FieldOf<TickRecord, decltype(of)>));  // flags are bytes
  });
  const double trace = scene.output.trace ? per_tick * static_cast<double>(simulation.told_ticks()) : 0.0;
  const double frames = std::min(scene.output.frames, scene.device.servo_rate) * simulation.seconds();
  return trace + bytes_per_frame * frames;
}

RunWriter::RunWriter(const std::filesystem::path& path, const Simulation& simulation,
                     const ViewSettings& view, const std::string& stroke_hash, const std::string& scene_file,
                     Hdf5Writer::Begins begins)
    : path_(path),
      file_(path, output_kind(InputKind::run), begins),
      keeps_trace_(simulation.scene().output.trace && simulation.scene().stroke),
      content_(simulation.trace_content()),
      frames_(file_, simulation.bed()) {
  if (begins == Hdf5Writer::Begins::anew) begin(simulation, view, stroke_hash, scene_file);
}

void RunWriter::begin(const Simulation& simulation, const ViewSettings& view, const std::string& stroke_hash,
                      const std::string& scene_file) {
  const HeightField& bed = simulation.bed();
  const std::string scene = scene_text({simulation.scene(), view});
  file_.attribute("/", "complete", false);
  file_.write("/scene", scene);
  file_.make_group(provenance);
  file_.attribute(provenance, "version", version);
  file_.attribute(provenance, "commit", commit);
  file_.attribute(provenance, "compiler", compiler);
  file_.attribute(provenance, "instruction_set", instruction_set());
  file_.attribute(provenance, "scene_hash", content_hash(scene));
  file_.attribute(provenance, "stroke_hash", stroke_hash);
  if (const std::string hash = sand_map_hash(simulation.scene().ground); !hash.empty())
    file_.attribute(provenance, sand_map_attribute, hash);
  const PluginLaws* const laws = simulation.scene().plugin_laws.laws.get();
  if (laws && !laws->hash.empty()) file_.attribute(provenance, "plugin_hash", laws->hash);
  if (!scene_file.empty()) file_.attribute(provenance, "scene_file", scene_file);
  write_bed_axes(file_, "/surface", bed);
  file_.attribute("/surface", "cell_size", bed.cell_size());
  if (simulation.scene().tool.mesh) write_tool_mesh(file_, *simulation.scene().tool.mesh);
  if (has_floor(bed)) write_floor(file_, bed.ground()->floor);
  write_surface("/surface/initial", bed, "height of the sand at the start");
  if (keeps_trace_) {
    file_.write_scale("/trace/axis", {"x", "y", "z"});
    if (content_.orientation) file_.write_scale("/trace/component", {"x", "y", "z", "w"});
    visit_trace(content_, [&](const FieldText& field, const auto& of) {
      tick_columns_.push_back(column_of<TickRecord>(file_, "/trace", field, of));
    });
  }
  visit_relaxation_fields([&](const FieldText& field, const auto& of) {
    relaxation_columns_.push_back(column_of<RelaxationRecord>(file_, "/relaxation", field, of));
  });
  file_.flush();
}

void RunWriter::write_surface(const std::string& dataset, const HeightField& surface,
                              const std::string& meaning) {
  write_bed(file_, dataset, surface);
  file_.attach_scales(dataset, {"/surface/y", "/surface/x"});
  file_.describe(dataset, "m", meaning);
}

void RunWriter::on_tick(const TickRecord& tick) {
  if (!keeps_trace_) return;
  ticks_.push_back(tick);
  if (ticks_.size() % rows_per_look == 0) write_in_time();
}

void RunWriter::on_relaxation(const RelaxationRecord& relaxation) {
  relaxations_.push_back(relaxation);
  if (relaxations_.size() % rows_per_look == 0) write_in_time();
}

void RunWriter::write_in_time() {
  if (std::chrono::steady_clock::now() - flushed_ >= time_per_flush)
    flush();
  else if (std::max(ticks_.size(), relaxations_.size()) >= most_rows_kept)
    write_rows();
}

void RunWriter::write_rows() {
  auto column = tick_columns_.begin();
  if (keeps_trace_) visit_trace(content_, [&](auto, const auto& of) { append(*column++, ticks_, of); });
  column = relaxation_columns_.begin();
  visit_relaxation_fields([&](auto, const auto& of) { append(*column++, relaxations_, of); });
  ticks_.clear();
  relaxations_.clear();
}

void RunWriter::flush() {
  write_rows();
  file_.flush();
  flushed_ = std::chrono::steady_clock::now();
}

void RunWriter::on_frame(double time, const HeightField& surface) {
  if (!std::exchange(has_load_, false)) remove_later_load();
  frames_.add(time, surface);
  write_in_time();
}

/// A run that goes on from an earlier state has written this frame's before.
void RunWriter::remove_later_load() {
  if (const std::string name = load_dataset(frames_.count()); file_.has(name)) file_.remove(name);
}

void RunWriter::on_load(const LoadSurface& load) {
  const std::string name = load_dataset(frames_.count());
  remove_later_load();
  file_.write(name, load.height, Compression::fast);
  has_load_ = true;
  file_.attribute(name, "cell_size", load.cell_size);
  file_.attribute(name, "along_x", load.along.x());
  file_.attribute(name, "along_y", load.along.y());
  file_.describe(
      name, "m",
      "height of the sand on the tool above its tip, in the middle of the grid, whose x axis points "
      "along (along_x, along_y) of the bed; not a number where there is none");
}

void RunWriter::visit_state(StateVisitor& state) {
  if (!state.restores()) {
    flush();
    sync_part(path_);  // the state that goes with it will be on the disk
  }
  const auto rows_of = [](const std::vector<Hdf5Column>& columns) {
    return columns.empty() ? std::uint64_t{0} : columns.front().rows();
  };
  std::uint64_t ticks = rows_of(tick_columns_), relaxations = rows_of(relaxation_columns_);
  state.value("trace.rows", ticks);
  state.value("relaxation.rows", relaxations);
  if (state.restores()) {
    if (keeps_trace_)
      visit_trace(content_, [&](const FieldText& field, const auto&) {
        tick_columns_.push_back(file_.shortened(std::string("/trace/") + field.name, ticks));
      });
    visit_relaxation_fields([&](const FieldText& field, const auto&) {
      relaxation_columns_.push_back(file_.shortened(std::string("/relaxation/") + field.name, relaxations));
    });
    for (const char* later : {final_surface, error_surface})
      file_.remove(later, {"/surface/y", "/surface/x"});
    file_.remove(error_group);
    file_.remove(load_group);
    remove_sources(file_);
  }
  frames_.visit_state(state);
  if (state.restores()) file_.flush();
}

void RunWriter::end(const RunResult& result, const HeightField& surface) {
  flush();
  file_.attribute(provenance, "threads", result.threads);
  if (result.interrupted) {
    file_.flush();
    spdlog::warn("stopped; the results up to here are in {}", part_path(path_).string());
    return;
  }
  frames_.finish();
  seconds_ = result.simulated_seconds;
  write_surface(final_surface, surface, "height of the sand at the end");
  if (result.furrow) {
    file_.attribute(final_surface, "furrow_depth", result.furrow->depth);
    file_.attribute(final_surface, "asked_depth", result.furrow->asked_depth);
  }
  if (!result.sources.empty()) write_sources(file_, result.sources);
  if (result.load) write_load(file_, *result.load);
  file_.flush();
}

void RunWriter::write_error(const ErrorEstimate& error, const HeightField* map) {
  file_.make_group(error_group);
  visit_error_fields(
      [&](const FieldText& field, const auto& of) { file_.attribute(error_group, field.name, of(error)); });
  if (map) write_surface(error_surface, *map, "estimated error of the height at the end");
}

void RunWriter::finish() {
  file_.attribute("/", "complete", true);
  const std::filesystem::path xdmf = beside(path_, ".xdmf");
  check_replaceable(xdmf, xdmf_output);
  const std::filesystem::file_status earlier = std::filesystem::status(xdmf);
  std::filesystem::remove(
      xdmf);  // an earlier run's file would describe this run's surface with that run's cells
  const std::string floor = file_.has(floor_dataset) ? floor_dataset : "";
  file_.finish();
  write_text_file(xdmf, xdmf_text(path_.filename().string(), frames_.bed(), frames_.steps(seconds_), floor),
                  xdmf_output);
  std::error_code ignored;  // some file systems have no modes
  if (std::filesystem::exists(earlier)) std::filesystem::permissions(xdmf, earlier.permissions(), ignored);
}

}  // namespace sandstroke
