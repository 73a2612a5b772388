#include "io/run_file.h"

#include <spdlog/fmt/fmt.h>

#include <limits>

#include "core/angle.h"
#include "core/elementary.h"
#include "core/error.h"
#include "core/machine.h"
#include "io/bed_floor.h"
#include "io/frame_writer.h"
#include "io/input_kind.h"
#include "io/scene_toml.h"

namespace sandstroke {
namespace {

constexpr int first_version = 1;  // of the format

std::string trace_dataset(const FieldText& field) { return std::string("/trace/") + field.name; }

}  // namespace

RunFile::RunFile(const std::filesystem::path& path) try : file_(path) {
  if (!has_format(file_, InputKind::run))
    throw_input_error("{}: is not a sandstroke run file; make one with 'sandstroke run'", file_.name());
  version_ = file_.number_attribute("/", "format_version");
  const int own_version = output_kind(InputKind::run).version;
  if (version_ != first_version && version_ != own_version)
    throw_input_error(
        "{}: has run format {}, but this program reads formats {} and {}; use a newer version of sandstroke",
        file_.name(), version_, first_version, own_version);
} catch (const Error&) {
  expect_kind(path, {InputKind::run});
}

bool RunFile::complete() const { return file_.number_attribute("/", "complete") != 0.0; }

double RunFile::cell_size() const { return file_.cell_size("/surface"); }

std::vector<hsize_t> RunFile::shape() const {
  const std::vector<hsize_t> shape = file_.shape("/surface/initial");
  constexpr hsize_t most = std::numeric_limits<int>::max();
  if (shape.size() != 2 || shape[0] > most || shape[1] > most || shape[0] * shape[1] == 0)
    throw_input_error("{}: /surface/initial is not a grid of cells; the file is damaged", file_.name());
  return shape;
}
int RunFile::rows() const { return static_cast<int>(shape()[0]); }
int RunFile::cols() const { return static_cast<int>(shape()[1]); }

HeightGrid RunFile::initial() const {
  shape();  // checks that there is one
  return file_.grid("/surface/initial");
}

HeightField RunFile::initial_bed() const {
  shape();
  return surface_on_ground("/surface/initial");
}

std::shared_ptr<const Ground> RunFile::ground() const {
  if (ground_ || !file_.has(floor_dataset)) return ground_;
  const BedGeometry bed(rows(), cols(), cell_size());
  auto read = std::make_shared<Ground>(bed, elementary::tan(to_radians(scene().relaxation.talus_angle)));
  read->floor = read_floor(file_, bed);
  return ground_ = std::move(read);
}

HeightField RunFile::surface_on_ground(const std::string& dataset) const {
  HeightField surface = file_.bed(dataset, cell_size());
  if (const std::shared_ptr<const Ground> under = ground()) {
    check_above_floor(surface, under->floor, file_.name());
    surface.lie_on(under);
  }
  return surface;
}

bool RunFile::has_final() const { return file_.has("/surface/final"); }

void RunFile::check_final() const {
  if (!has_final() && !complete())
    throw_input_error(
        "{}: the run was cut off and has no final surface; run it again{}", file_.name(),
        frame_times().empty() ? "" : fmt::format(", or take a frame: 0 to {}", frame_times().size() - 1));
  if (file_.shape("/surface/final") != shape())
    throw_input_error("{}: /surface/final and /surface/initial differ in shape; the file is damaged",
                      file_.name());
}

HeightGrid RunFile::final() const {
  check_final();
  return file_.grid("/surface/final");
}

HeightField RunFile::final_bed() const {
  check_final();
  return surface_on_ground("/surface/final");
}

TraceContent RunFile::trace_content() const {
  TraceContent content;
  visit_tick_fields([&](const FieldText& field, const auto&) {
    if (field.only_with) content.*field.only_with = file_.has(trace_dataset(field));
  });
  return content;
}

std::vector<RelaxationRecord> RunFile::relaxations() const {
  const std::size_t count = file_.has("/relaxation/time") ? file_.doubles("/relaxation/time").size() : 0;
  std::vector<RelaxationRecord> relaxations(count);
  visit_relaxation_fields([&](const FieldText& field, const auto& of) {
    if (count == 0) return;
    const std::string name = std::string("/relaxation/") + field.name;
    const std::vector<double> column = file_.doubles(name);
    if (column.size() != count)
      throw_input_error("{}: {} has {} rows, but /relaxation/time has {}; the file is damaged", file_.name(),
                        name, column.size(), count);
    using Value = std::decay_t<decltype(of(relaxations.front()))>;
    for (std::size_t i = 0; i < count; ++i) of(relaxations[i]) = static_cast<Value>(column[i]);
  });
  return relaxations;
}

bool RunFile::has_trace() const { return file_.has("/trace/time"); }

std::vector<TickRecord> RunFile::trace() const {
  const std::vector<double> time = file_.doubles("/trace/time");
  const std::size_t count = time.size();
  const TraceContent content = trace_content();
  const auto visit_trace = [&](const auto& visit) {
    visit_tick_fields([&](const FieldText& field, const auto& of) {
      if (!field.only_with || content.*field.only_with) visit(trace_dataset(field), of);
    });
  };
  visit_trace([&](const std::string& name, const auto&) {
    const std::vector<hsize_t> shape = file_.shape(name);
    if (shape.empty() || shape[0] != count)
      throw_input_error("{}: {} has {} rows, but /trace/time has {}; the file is damaged", file_.name(), name,
                        shape.empty() ? 0 : shape[0], count);
  });
  check_memory(static_cast<double>(count) * sizeof(TickRecord),
               fmt::format("{}: /trace: working with {} ticks", file_.name(), count),
               "read a part of it, for example with h5py");
  std::vector<TickRecord> ticks(count);
  visit_trace([&](const std::string& name, const auto& of) {
    const auto fill = [&](const auto& column) {
      for (std::size_t i = 0; i < ticks.size(); ++i) of(ticks[i]) = column[i];
    };
    using Value = std::decay_t<decltype(of(ticks.front()))>;
    if constexpr (std::is_same_v<Value, Eigen::Vector3d>)
      fill(file_.vectors(name));
    else if constexpr (std::is_same_v<Value, Eigen::Vector4d>)
      fill(file_.quaternions(name));
    else if constexpr (std::is_same_v<Value, bool>)
      fill(file_.integers(name));
    else
      name == "/trace/time" ? fill(time) : fill(file_.doubles(name));
  });
  return ticks;
}

std::vector<double> RunFile::frame_times() const {
  if (!file_.has("/surface/frame")) return {};
  if (version_ == first_version)
    throw_input_error("{}: was written by {}, whose frames this version cannot read; run its scene again",
                      file_.name(), file_.text_attribute("/", "written_by"));
  return file_.doubles("/surface/time");
}

int RunFile::apply_frame(int k, HeightField& surface) const {
  const std::string changed = FrameWriter::changed(k);
  if (file_.shape(changed) != shape())
    throw_input_error("{}: {} differs from /surface/initial in shape; the file is damaged", file_.name(),
                      changed);
  int parts = 0;
  file_.visit_written(changed,
                      [&](Eigen::Index first_row, Eigen::Index first_col, const HeightGrid& heights) {
                        if (!heights.isFinite().all())
                          throw_input_error("{}: {} has heights that are not numbers; the file is damaged",
                                            file_.name(), changed);
                        surface.set_block(static_cast<int>(first_row), static_cast<int>(first_col), heights);
                        ++parts;
                      });
  return parts;
}

std::optional<ErrorEstimate> RunFile::error_estimate() const {
  if (!file_.has(error_group)) return std::nullopt;
  ErrorEstimate error;
  visit_error_fields([&](const FieldText& field, const auto& of) {
    of(error) =
        static_cast<std::decay_t<decltype(of(error))>>(file_.number_attribute(error_group, field.name));
  });
  return error;
}

std::optional<HeightField> RunFile::error_map() const {
  constexpr const char* map = "/surface/error";
  if (!file_.has(map)) return std::nullopt;
  if (file_.shape(map) != shape())
    throw_input_error("{}: {} and /surface/initial differ in shape; the file is damaged", file_.name(), map);
  return file_.bed(map, cell_size());
}

std::vector<SourceLedger> RunFile::sources() const {
  if (!file_.has(source_group)) return {};
  std::vector<SourceLedger> sources;
  visit_source_fields([&](const FieldText& field, const auto& of) {
    const std::string name = std::string(source_group) + "/" + field.name;
    const std::vector<double> column = file_.doubles(name);
    if (sources.empty()) sources.resize(column.size());
    if (column.size() != sources.size())
      throw_input_error("{}: {} has {} rows, but others of its group have {}; the file is damaged",
                        file_.name(), name, column.size(), sources.size());
    for (std::size_t i = 0; i < column.size(); ++i) of(sources[i]) = column[i];
  });
  return sources;
}

std::optional<LoadLedger> RunFile::load() const {
  if (!file_.has(load_group)) return std::nullopt;
  LoadLedger load;
  visit_load_fields([&](const FieldText& field, const auto& of) {
    of(load) = file_.number_attribute(load_group, field.name);
  });
  return load;
}

std::string load_dataset(int k) { return fmt::format("/tool/sand/{:06}", k); }

std::optional<LoadSurface> RunFile::load_surface(int k) const {
  const std::string name = load_dataset(k);
  if (!file_.has(name)) return {};
  return LoadSurface{file_.grid(name),
                     file_.cell_size(name),
                     {file_.number_attribute(name, "along_x"), file_.number_attribute(name, "along_y")}};
}

std::string RunFile::scene_text() const { return file_.text("/scene"); }

SceneFile RunFile::scene() const {
  SceneFile scene = stored_scene(scene_text(), name() + ": /scene");
  if (scene.tool.shape == ToolShape::mesh && file_.has("/tool/triangles"))
    scene.tool.mesh = std::make_shared<TriangleMesh>(tool_mesh());
  return scene;
}

TriangleMesh RunFile::tool_mesh() const {
  TriangleMesh mesh;
  mesh.vertices = file_.vectors("/tool/vertices");
  const auto count = static_cast<double>(mesh.vertices.size());
  for (const Eigen::Vector3d& corners : file_.vectors("/tool/triangles")) {
    if (!(corners.minCoeff() >= 0.0 && corners.maxCoeff() < count &&
          corners == corners.array().floor().matrix()))
      throw_input_error(
          "{}: /tool/triangles names a vertex that /tool/vertices does not have; the file is "
          "damaged",
          name());
    const Eigen::Vector3i indices = corners.cast<int>();
    mesh.triangles.push_back({indices[0], indices[1], indices[2]});
  }
  return mesh;
}

std::vector<std::pair<std::string, std::string>> RunFile::provenance() const {
  constexpr const char* group = "/provenance";
  std::vector<std::pair<std::string, std::string>> entries;
  if (version_ == first_version)
    for (const std::string& name : file_.members(group))
      entries.emplace_back(name, file_.text(std::string(group) + "/" + name));
  else
    for (const std::string& name : file_.attributes(group))
      entries.emplace_back(name, name == "threads" ? fmt::format("{}", file_.number_attribute(group, name))
                                                   : file_.text_attribute(group, name));
  return entries;
}

const HeightField& RunFrames::surface(int k) {
  if (!surface_ || k < applied_ - 1) {
    surface_ = run_.initial_bed();
    applied_ = 0;
  }
  for (; applied_ <= k; ++applied_) tiles_read_ += run_.apply_frame(applied_, *surface_);
  return *surface_;
}

LastSurface last_surface(const RunFile& run) {
  if (run.has_final()) return {run.final_bed(), "final surface"};
  LastSurface last{run.initial_bed(), "initial surface"};
  const std::vector<double> times = run.frame_times();
  for (std::size_t k = 0; k < times.size(); ++k) {
    run.apply_frame(static_cast<int>(k), last.surface);
    last.name = fmt::format("surface at {:.4g} s", times[k]);
  }
  return last;
}

}  // namespace sandstroke
