#include "io/run_file.h"

#include <limits>

#include "core/error.h"
#include "core/machine.h"
#include "io/input_kind.h"

namespace sandstroke {
namespace {

std::string frame_name(int k) { return fmt::format("/surface/frame/{:06}", k); }

}  // namespace

RunFile::RunFile(const std::filesystem::path& path) try : file_(path) {
  if (!has_format(file_, InputKind::run))
    throw_input_error("{}: is not a sandstroke run file; make one with 'sandstroke run'", file_.name());
  if (const double version = file_.number_attribute("/", "format_version"); version != 1)
    throw_input_error(
        "{}: has run format {}, and this program reads format 1; use a newer version of sandstroke",
        file_.name(), version);
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
  shape();  // that there is one
  return file_.grid("/surface/initial");
}

HeightField RunFile::initial_bed() const {
  shape();
  return file_.bed("/surface/initial", cell_size());
}

bool RunFile::has_final() const { return file_.has("/surface/final"); }

void RunFile::check_final() const {
  if (!has_final() && !complete())
    throw_input_error("{}: the run was cut off and has no final surface; run it again", file_.name());
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
  return file_.bed("/surface/final", cell_size());
}

bool RunFile::has_trace() const { return file_.has("/trace/time"); }

std::vector<TickRecord> RunFile::trace() const {
  const std::vector<double> time = file_.doubles("/trace/time");
  const std::size_t count = time.size();
  visit_tick_fields([&](const std::string& field, const char*, const auto&) {
    const std::vector<hsize_t> shape = file_.shape("/trace/" + field);
    if (shape.empty() || shape[0] != count)
      throw_input_error("{}: /trace/{} has {} rows and /trace/time {}; the file is damaged", file_.name(),
                        field, shape.empty() ? 0 : shape[0], count);
  });
  check_memory(static_cast<double>(count) * sizeof(TickRecord),
               fmt::format("{}: /trace: working with {} ticks", file_.name(), count),
               "read a part of it, for example with h5py");
  std::vector<TickRecord> ticks(count);
  visit_tick_fields([&](const std::string& field, const char*, const auto& of) {
    const std::string name = "/trace/" + field;
    const auto fill = [&](const auto& column) {
      for (std::size_t i = 0; i < ticks.size(); ++i) of(ticks[i]) = column[i];
    };
    using Value = std::decay_t<decltype(of(ticks.front()))>;
    if constexpr (std::is_same_v<Value, Eigen::Vector3d>)
      fill(file_.vectors(name));
    else if constexpr (std::is_same_v<Value, bool>)
      fill(file_.integers(name));
    else
      field == "time" ? fill(time) : fill(file_.doubles(name));
  });
  return ticks;
}

std::vector<double> RunFile::frame_times() const {
  std::vector<double> times;
  if (!file_.has("/surface/frame")) return times;
  for (const std::string& name : file_.members("/surface/frame"))
    times.push_back(file_.number_attribute("/surface/frame/" + name, "time"));
  return times;
}

int RunFile::apply_frame(int k, HeightField& surface) const {
  const std::vector<std::uint32_t> tiles = file_.integers(frame_name(k) + "/tiles");
  if (file_.shape(frame_name(k) + "/heights") != std::vector<hsize_t>{tiles.size(), HeightField::tile_area})
    throw_input_error("{}: {} has heights of the wrong shape; the file is damaged", file_.name(),
                      frame_name(k));
  const HeightGrid blocks = file_.grid(frame_name(k) + "/heights");
  if (!blocks.isFinite().all())
    throw_input_error("{}: {} has heights that are not numbers; the file is damaged", file_.name(),
                      frame_name(k));
  for (std::size_t t = 0; t < tiles.size(); ++t) {
    if (tiles[t] >= static_cast<std::uint32_t>(surface.tile_count()))
      throw_input_error("{}: {} names tile {}, which the bed does not have; the file is damaged",
                        file_.name(), frame_name(k), tiles[t]);
    std::copy_n(blocks.row(static_cast<Eigen::Index>(t)).data(), HeightField::tile_area,
                surface.tile_heights(surface.allocate(static_cast<int>(tiles[t]))));
  }
  return static_cast<int>(tiles.size());
}

std::string RunFile::scene_text() const { return file_.text("/scene"); }

std::vector<std::pair<std::string, std::string>> RunFile::provenance() const {
  std::vector<std::pair<std::string, std::string>> entries;
  for (const std::string& name : file_.members("/provenance"))
    entries.emplace_back(name, file_.text("/provenance/" + name));
  return entries;
}

HeightGrid RunFrames::surface(int k) {
  if (!surface_ || k < applied_ - 1) {
    surface_.emplace(run_.initial(), run_.cell_size());
    applied_ = 0;
  }
  for (; applied_ <= k; ++applied_) tiles_read_ += run_.apply_frame(applied_, *surface_);
  return surface_->grid();
}

}  // namespace sandstroke
