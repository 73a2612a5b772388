#include "io/run_writer.h"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <type_traits>

#include "core/hash.h"
#include "core/output_file.h"
#include "core/version.h"
#include "core/xml_text.h"
#include "io/bed_writer.h"
#include "io/input_kind.h"
#include "io/scene_toml.h"
#include "sand/instruction_set.h"

namespace sandstroke {
namespace {

// What a killed run can lose. Not after fewer rows: ticks may take microseconds.
constexpr std::chrono::milliseconds time_per_write{500};
constexpr double bytes_per_frame = 1000.0;  // at least: of its groups and attributes
constexpr std::size_t least_rows_per_write = 1000, most_rows_per_write = 50'000;

/// Describes /surface to programs such as ParaView that read XDMF.
std::string xdmf_text(const std::string& run_name, int rows, int cols, double cell_size) {
  const auto grid = [&](const std::string& name) {
    return fmt::format(
        "    <Grid Name=\"{}\" GridType=\"Uniform\">\n"
        "      <Topology TopologyType=\"2DCoRectMesh\" Dimensions=\"{} {}\"/>\n"
        "      <Geometry GeometryType=\"Origin_DxDy\">\n"
        "        <DataItem Dimensions=\"2\" Format=\"XML\">{} {}</DataItem>\n"
        "        <DataItem Dimensions=\"2\" Format=\"XML\">{} {}</DataItem>\n"
        "      </Geometry>\n"
        "      <Attribute Name=\"height\" AttributeType=\"Scalar\" Center=\"Node\">\n"
        "        <DataItem Dimensions=\"{} {}\" NumberType=\"Float\" Precision=\"8\" "
        "Format=\"HDF\">{}:/surface/{}</DataItem>\n"
        "      </Attribute>\n"
        "    </Grid>\n",
        name, rows, cols, -0.5 * (rows - 1) * cell_size, -0.5 * (cols - 1) * cell_size, cell_size, cell_size,
        rows, cols, run_name, name);
  };
  return std::string(xdmf_output.begin) + grid("initial") + grid("final") + "  </Domain>\n</Xdmf>\n";
}

/// What a field of(record) of records is.
template <class Record, class Of>
using FieldOf = std::decay_t<std::invoke_result_t<Of, Record&>>;

/// Makes a growing dataset for a field of records.
template <class Record, class Of>
Hdf5Column column_of(Hdf5Writer& file, const std::string& name, const std::string& unit, const Of&) {
  using Field = FieldOf<Record, Of>;
  Hdf5Column column;
  if constexpr (std::is_same_v<Field, bool>)
    column = file.column<std::uint8_t>(name);
  else
    column = file.column(name, std::is_same_v<Field, Eigen::Vector3d> ? 3 : 1);
  if (!unit.empty()) file.attribute(name, "unit", unit);
  return column;
}

/// Appends of(record) of all records.
template <class Record, class Of>
void append(Hdf5Column& column, const std::vector<Record>& records, const Of& of) {
  using Field = FieldOf<Record, Of>;
  using Number = std::conditional_t<std::is_same_v<Field, bool>, std::uint8_t, double>;
  std::vector<Number> rows;
  for (const Record& record : records)
    if constexpr (std::is_same_v<Field, Eigen::Vector3d>)
      rows.insert(rows.end(), of(record).begin(), of(record).end());
    else
      rows.push_back(static_cast<Number>(of(record)));
  column.append(rows.data(), records.size());
}

}  // namespace

double least_bytes(const Simulation& simulation) {
  const Scene& scene = simulation.scene();
  double per_tick = 0.0;
  visit_tick_fields([&](auto, auto, const auto& of) {
    per_tick += static_cast<double>(sizeof(FieldOf<TickRecord, decltype(of)>));  // flags are bytes
  });
  const double trace = scene.output.trace ? per_tick * static_cast<double>(simulation.told_ticks()) : 0.0;
  const double frames = std::min(scene.output.frames, scene.device.servo_rate) * simulation.stroke_seconds();
  return trace + bytes_per_frame * frames;
}

RunWriter::RunWriter(const std::filesystem::path& path, const Simulation& simulation,
                     const std::string& stroke_hash, const std::string& scene_file)
    : path_(path),
      file_(path, output_kind(InputKind::run)),
      keeps_trace_(simulation.scene().output.trace && simulation.scene().stroke) {
  const HeightField& bed = simulation.bed();
  const std::string scene = scene_text(simulation.scene());
  file_.attribute("/", "complete", 0.0);
  file_.write("/scene", scene);
  file_.write("/provenance/version", version);
  file_.write("/provenance/commit", commit);
  file_.write("/provenance/compiler", compiler);
  file_.write("/provenance/instruction_set", instruction_set());
  file_.write("/provenance/scene_hash", content_hash(scene));
  file_.write("/provenance/stroke_hash", stroke_hash);
  if (!scene_file.empty()) file_.write("/provenance/scene_file", scene_file);
  write_bed(file_, "/surface/initial", bed);
  file_.attribute("/surface", "cell_size", bed.cell_size());
  file_.attribute("/surface", "unit", "m");
  for (int slot = 0; slot < bed.allocated_tiles(); ++slot)
    frame_revisions_.push_back(bed.tile_revision(bed.tile_of(slot)));
  if (keeps_trace_)
    visit_tick_fields([&](const std::string& name, const char* unit, const auto& of) {
      tick_columns_.push_back(column_of<TickRecord>(file_, "/trace/" + name, unit, of));
    });
  visit_relaxation_fields([&](const std::string& name, const char* unit, const auto& of) {
    relaxation_columns_.push_back(column_of<RelaxationRecord>(file_, "/relaxation/" + name, unit, of));
  });
  file_.flush();
}

void RunWriter::on_tick(const TickRecord& tick) {
  if (!keeps_trace_) return;
  ticks_.push_back(tick);
  if (ticks_.size() % least_rows_per_write == 0) write_rows_in_time();
}

void RunWriter::on_relaxation(const RelaxationRecord& relaxation) {
  relaxations_.push_back(relaxation);
  if (relaxations_.size() % least_rows_per_write == 0) write_rows_in_time();
}

void RunWriter::write_rows_in_time() {
  const bool full = std::max(ticks_.size(), relaxations_.size()) >= most_rows_per_write;
  if (full || std::chrono::steady_clock::now() - written_ >= time_per_write) write_rows();
}

void RunWriter::write_rows() {
  auto column = tick_columns_.begin();
  if (keeps_trace_) visit_tick_fields([&](auto, auto, const auto& of) { append(*column++, ticks_, of); });
  column = relaxation_columns_.begin();
  visit_relaxation_fields([&](auto, auto, const auto& of) { append(*column++, relaxations_, of); });
  ticks_.clear();
  relaxations_.clear();
  file_.flush();
  written_ = std::chrono::steady_clock::now();
}

void RunWriter::on_frame(double time, const HeightField& surface) {
  frame_revisions_.resize(surface.allocated_tiles(), HeightField::new_tile_revision);
  std::vector<std::uint32_t> changed;
  for (int slot = 0; slot < surface.allocated_tiles(); ++slot) {
    const int tile = surface.tile_of(slot);
    if (surface.tile_revision(tile) == frame_revisions_[slot]) continue;
    frame_revisions_[slot] = surface.tile_revision(tile);
    changed.push_back(static_cast<std::uint32_t>(tile));
  }
  std::sort(changed.begin(), changed.end());
  const std::string name = fmt::format("/surface/frame/{:06}", frames_++);
  file_.write(name + "/tiles", changed);
  Hdf5Chunks heights =
      file_.chunks(name + "/heights", {static_cast<int>(changed.size()), HeightField::tile_area},
                   {1, HeightField::tile_area}, 0.0);
  std::vector<double> block(HeightField::tile_area);
  for (std::size_t i = 0; i < changed.size(); ++i) {
    std::fill(block.begin(), block.end(), 0.0);  // outside the bed
    surface.read_tile(static_cast<int>(changed[i]), block.data());
    heights.write(static_cast<int>(i), 0, block.data());
  }
  file_.attribute(name, "time", time);
  write_rows_in_time();
}

void RunWriter::finish(const RunResult& result, const HeightField& surface) {
  write_rows();
  tick_columns_.clear();
  relaxation_columns_.clear();
  file_.write("/provenance/threads", std::to_string(result.threads));
  if (result.interrupted) {
    file_.flush();
    spdlog::warn("stopped; the part that was run is in {}", part_path(path_).string());
    return;
  }
  write_bed(file_, "/surface/final", surface);
  if (result.furrow) {
    file_.attribute("/surface/final", "furrow_depth", result.furrow->depth);
    file_.attribute("/surface/final", "asked_depth", result.furrow->asked_depth);
  }
  file_.attribute("/", "complete", 1.0);
  const std::filesystem::path xdmf = beside(path_, ".xdmf");
  check_replaceable(xdmf, xdmf_output);
  const std::filesystem::file_status earlier = std::filesystem::status(xdmf);
  std::filesystem::remove(
      xdmf);  // of an earlier run: it would describe this one's surface by that one's cells
  file_.finish();
  write_text_file(
      xdmf,
      xdmf_text(xml_escaped(path_.filename().string()), surface.rows(), surface.cols(), surface.cell_size()),
      xdmf_output);
  std::error_code ignored;  // some file systems have no modes
  if (std::filesystem::exists(earlier)) std::filesystem::permissions(xdmf, earlier.permissions(), ignored);
}

}  // namespace sandstroke
