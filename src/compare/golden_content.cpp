#include "compare/golden_content.h"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "compare/compare_runs.h"
#include "compare/golden_trace.h"
#include "core/error.h"
#include "core/hash.h"
#include "core/machine.h"
#include "io/input_kind.h"
#include "io/scene_toml.h"
#include "render/changed_cells.h"

namespace sandstroke {
namespace {

constexpr double height_quantum = 0x1p-30;   // m
constexpr double initial_quantum = 0x1p-20;  // m

/// The change of the whole bed. golden.h5 holds a block of it.
HeightGrid read_change(const Hdf5Reader& file, const std::string& update) {
  const double rows = file.number_attribute("/surface", "rows"),
               cols = file.number_attribute("/surface", "cols");
  const HeightGrid block = file.grid("/surface/change");
  const double row = file.number_attribute("/surface/change", "row");
  const double col = file.number_attribute("/surface/change", "col");
  constexpr double most = BedGeometry::most_cells;
  const bool fits = rows >= 1 && cols >= 1 && rows <= most && cols <= most && row >= 0 && col >= 0 &&
                    row + static_cast<double>(block.rows()) <= rows &&
                    col + static_cast<double>(block.cols()) <= cols;
  if (!fits)
    throw_input_error("{}: /surface/change does not lie in the bed; make the file again with: {}",
                      file.name(), update);
  check_memory(4.0 * sizeof(double) * rows * cols,
               fmt::format("{}: working with a bed of {} x {} cells", file.name(), rows, cols),
               "name another file");
  HeightGrid change = HeightGrid::Zero(static_cast<Eigen::Index>(rows), static_cast<Eigen::Index>(cols));
  change.block(static_cast<Eigen::Index>(row), static_cast<Eigen::Index>(col), block.rows(), block.cols()) =
      block;
  return change;
}

std::vector<TickRecord> read_trace(const Hdf5Reader& file, const std::string& update) {
  const HeightGrid table = file.grid("/trace/ticks");
  if (table.rows() != packed_trace_rows)
    throw_input_error("{}: /trace/ticks does not have {} rows; make the file again with: {}", file.name(),
                      packed_trace_rows, update);
  const double servo_rate = file.number_attribute("/trace", "servo_rate");
  if (!(servo_rate > 0.0 && std::isfinite(servo_rate)))
    throw_input_error("{}: /trace has a servo_rate of {} Hz; make the file again with: {}", file.name(),
                      servo_rate, update);
  return unpacked_trace(table, servo_rate);
}

}  // namespace

std::string initial_hash(const HeightGrid& heights) {
  ContentHash hash;
  for (const double height : heights.reshaped<Eigen::RowMajor>()) {
    const std::int64_t steps = std::llround(height / initial_quantum);
    hash.add(&steps, sizeof steps);
  }
  return hash.text();
}

HeightGrid height_change(const RunFile& run) {
  const HeightGrid initial = run.initial(), final_heights = run.final();
  if (initial.rows() != final_heights.rows() || initial.cols() != final_heights.cols() || initial.size() == 0)
    throw_input_error("{}: /surface/initial and /surface/final differ in shape or are empty", run.name());
  return final_heights - initial;
}

void write_golden_content(const std::filesystem::path& path, const RunFile& run) {
  if (!run.complete())
    throw_input_error("{}: was cut off; only a complete run can become golden", run.name());
  const HeightGrid initial = run.initial(), change = height_change(run);
  if (!change.allFinite())
    throw_input_error("{}: has heights that are not finite; this run cannot become golden", run.name());
  CellRange block =
      changed_cells(HeightGrid::Zero(change.rows(), change.cols()), change, 0.5 * height_quantum);
  if (block.empty()) block = {0, 1, 0, 1};
  const std::string scene = run.scene_text();

  Hdf5Writer file(path, output_kind(InputKind::golden));
  file.write("/scene", scene);
  file.make_group("/surface");
  file.attribute("/surface", "rows", static_cast<double>(change.rows()));
  file.attribute("/surface", "cols", static_cast<double>(change.cols()));
  file.attribute("/surface", "cell_size", run.cell_size());
  file.attribute("/surface", "initial_hash", initial_hash(initial));
  const HeightGrid kept = change.block(block.row_begin, block.col_begin, block.rows(), block.cols());
  file.write("/surface/change", (kept / height_quantum).round() * height_quantum, Compression::small);
  file.attribute("/surface/change", "row", block.row_begin);
  file.attribute("/surface/change", "col", block.col_begin);
  if (const std::optional<std::vector<TickRecord>> trace = whole_trace(run)) {
    const double servo_rate = stored_scene(scene, run.name() + ": /scene").device.servo_rate;
    file.make_group("/trace");
    file.attribute("/trace", "servo_rate", servo_rate);
    file.write_whole_numbers("/trace/ticks", packed_trace(*trace, servo_rate, run.name()));
  }
  file.finish();
}

GoldenContent read_golden_content(const std::filesystem::path& path, const std::string& update) {
  const Hdf5Reader file(path);
  if (!has_format(file, InputKind::golden))
    throw_input_error("{}: is not a golden file; make it with: {}", file.name(), update);
  const int golden_format = output_kind(InputKind::golden).version;
  if (const double version = file.number_attribute("/", "format_version"); version != golden_format) {
    throw_input_error(
        "{}: has format {}, and this program reads format {}; {}", file.name(), version, golden_format,
        version > golden_format ? "use a newer version of sandstroke" : "make it again with: " + update);
  }
  GoldenContent content{file.text("/scene"), file.cell_size("/surface"),
                        file.text_attribute("/surface", "initial_hash"), read_change(file, update),
                        std::nullopt};
  if (file.has("/trace")) content.trace = read_trace(file, update);
  return content;
}

}  // namespace sandstroke
