#include "sweep/sweep_folder.h"

#include <unistd.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "core/error.h"
#include "core/input_file.h"
#include "core/output_file.h"
#include "core/shell_text.h"
#include "hdf5/hdf5_file.h"
#include "io/bed_writer.h"
#include "io/input_kind.h"
#include "io/scene_toml.h"
#include "sweep/plan_keys.h"

namespace sandstroke {
namespace {

constexpr const char* surface_in = "surface_in";  // an attribute of a point's file

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

Json to_json(const SweepManifest& m) {
  Json axes = Json::array(), inputs = Json::array();
  for (const SweepAxis& axis : m.design.axes)
    axes.push_back(
        {{"key", axis.key}, {"unit", axis.unit}, {"logarithmic", axis.logarithmic}, {"values", axis.values}});
  for (const auto& [file, hash] : m.inputs) inputs.push_back({{"file", file}, {"hash", hash}});
  return {{"format", "sandstroke.sweep"},
          {"format_version", 1},
          {"version", m.version},
          {"commit", m.commit},
          {"scene", m.scene},
          {"settings", m.settings},
          {"design", m.design.grid ? "grid" : "latin"},
          {"axes", axes},
          {"metrics", m.metrics},
          {"keep_surface", m.keep_surface},
          {"keep_picture", m.keep_picture},
          {"estimate_error", m.estimate_error},
          {"golden", m.golden},
          {"plan", m.plan},
          {"inputs", inputs}};
}

SweepManifest from_json(const Json& json) {
  SweepManifest m;
  m.version = json.at("version");
  m.commit = json.at("commit");
  m.scene = json.at("scene");
  m.settings = json.at("settings");
  m.design.grid = json.at("design") == "grid";
  for (const Json& axis : json.at("axes"))
    m.design.axes.push_back({axis.at("key"), axis.at("unit"), axis.at("logarithmic"), axis.at("values")});
  m.metrics = json.at("metrics");
  m.keep_surface = json.at("keep_surface");
  m.keep_picture = json.at("keep_picture");
  m.estimate_error = json.value("estimate_error", "");  // early manifests lack it
  m.golden = json.at("golden");
  m.plan = json.value("plan", "");  // as above
  for (const Json& input : json.at("inputs")) m.inputs.emplace_back(input.at("file"), input.at("hash"));
  return m;
}

/// The parts of a manifest that decide the results. A moved scene is still the same.
Json without_paths(Json manifest) {
  manifest.erase("scene");
  manifest.erase("golden");
  manifest.erase("plan");
  for (Json& input : manifest["inputs"]) input.erase("file");
  return manifest;
}

/// True if the design has points, not more than a plan may have, and each point has a value of each axis.
bool is_whole(const SweepDesign& design) {
  double points = 1.0;
  for (const SweepAxis& axis : design.axes) points *= static_cast<double>(axis.values.size());
  return !design.axes.empty() && (!design.grid || points <= most_points) &&
         std::all_of(design.axes.begin(), design.axes.end(), [&](const SweepAxis& axis) {
           return !axis.values.empty() &&
                  (design.grid || axis.values.size() == design.axes.front().values.size());
         });
}

/// Without settings that do not apply beside the others: a run refuses them. All, if the scene has gone.
std::vector<std::string> those_that_apply(const std::string& scene, std::vector<std::string> settings) {
  const auto key_of = [](const std::string& setting) { return setting.substr(0, setting.find('=')); };
  if (std::none_of(settings.begin(), settings.end(),
                   [&](const std::string& setting) { return applies_conditionally(key_of(setting)); }))
    return settings;
  try {
    std::vector<LeftOut> left_out;
    combined_scene({read_text_file(scene), scene}, settings, left_out);
    std::erase_if(settings, [&](const std::string& setting) {
      return std::any_of(left_out.begin(), left_out.end(),
                         [&](const LeftOut& one) { return one.key == key_of(setting); });
    });
  } catch (const Error&) {  // of a point that is refused
  }
  return settings;
}

constexpr OutputKind manifest_output{"a sweep's manifest", "{\n  \"format\": \"sandstroke.sweep\""};

fs::path manifest_path(const fs::path& folder) { return folder / "manifest.json"; }

/// nullptr if the program has no metric of this name.
const Metric* find_metric(const std::string& name) {
  const auto found = std::find_if(all_metrics().begin(), all_metrics().end(),
                                  [&](const Metric& metric) { return metric.name == name; });
  return found == all_metrics().end() ? nullptr : &*found;
}

}  // namespace

void refuse_link(const fs::path& folder) {
  if (fs::is_symlink(folder))
    throw_input_error(
        "{}: is a link, and sandstroke does not write through links; remove it or choose another -o",
        folder.string());
}

SweepFolder::SweepFolder(fs::path path, SweepManifest manifest)
    : path_(std::move(path)), manifest_(std::move(manifest)) {
  for (const std::string& name : manifest_.metrics) {
    const Metric* metric = find_metric(name);
    if (!metric)
      throw_input_error("{}: this version has no metric '{}'; use the version that began the sweep ({}, {})",
                        manifest_path(path_).string(), name, manifest_.version, manifest_.commit);
    metrics_.push_back(*metric);
  }
}

SweepFolder SweepFolder::make(const fs::path& path, const SweepManifest& manifest) {
  refuse_link(path / "points");
  if (fs::exists(manifest_path(path))) {
    SweepFolder there = open(path);
    const Json old_one = without_paths(to_json(there.manifest_)), new_one = without_paths(to_json(manifest));
    for (const auto& [key, value] : new_one.items()) {
      if (old_one.at(key) == value) continue;
      if (key == "version" || key == "commit")
        throw_input_error(
            "{}: was begun by another version of sandstroke ({}, {}), whose results may differ; choose "
            "another -o, or remove the folder",
            path.string(), there.manifest_.version, there.manifest_.commit);
      throw_input_error("{}: holds another sweep, whose {} differ{}; choose another -o, or remove the folder",
                        path.string(), key == "inputs" ? "scene, strokes or other files" : key,
                        key == "axes" || key == "inputs" || key == "settings" || key == "metrics" ? "" : "s");
    }
    make_folder(path / "points");  // if somebody removed it, all points are missing
    return there;
  }
  if (fs::is_directory(path))
    for (const auto& entry : fs::directory_iterator(path)) {
      const std::string name = entry.path().filename().string();
      // Another process may be making the same folder. It writes the manifest before any points. Points
      // without a manifest belong to an unknown sweep.
      if (name.starts_with("manifest")) continue;
      if (name == "points") {
        if (fs::is_empty(entry.path()) || fs::exists(manifest_path(path))) continue;
        throw_input_error(
            "{}: holds points but no manifest.json, so their sweep is unknown; choose another -o, or remove "
            "the folder",
            path.string());
      }
      throw_input_error("{}: holds other files and not a sweep; choose another -o, or an empty folder",
                        path.string());
    }
  make_folder(path / "points");
  SweepFolder made(path, manifest);
  const fs::path own = path / fmt::format("manifest-{}.json", getpid());
  // A folder's name need not be UTF-8.
  write_text_file(own, to_json(manifest).dump(2, ' ', false, Json::error_handler_t::replace) + "\n",
                  manifest_output);
  std::error_code failure;
  fs::rename(own, manifest_path(path), failure);
  if (failure)
    throw_io_error("{}: cannot be put in place ({})", manifest_path(path).string(), failure.message());
  return made;
}

SweepFolder SweepFolder::open(const fs::path& path) {
  const fs::path file = manifest_path(path);
  if (!fs::exists(file))
    throw_io_error(
        "{}: is not a sweep folder, because it has no manifest.json; name the folder that was given with -o",
        path.string());
  try {
    const Json json = Json::parse(read_text_file(file, most_note_bytes));
    if (json.at("format") != "sandstroke.sweep" || json.at("format_version") != 1)
      throw_input_error("{}: has an unknown format; use the version of sandstroke that began the sweep",
                        file.string());
    SweepManifest manifest = from_json(json);
    if (is_whole(manifest.design)) return {path, std::move(manifest)};
  } catch (const Json::exception&) {
  }
  throw_input_error("{}: is damaged; remove the folder and sweep again", file.string());
}

fs::path SweepFolder::point_file(std::size_t point) const {
  return path_ / "points" / fmt::format("{:06}.h5", point);
}
fs::path SweepFolder::picture_file(std::size_t point) const {
  return path_ / "points" / fmt::format("{:06}.png", point);
}

fs::path SweepFolder::state_file(std::size_t point) const {
  return path_ / "points" / fmt::format("{:06}.state", point);
}

fs::path SweepFolder::surface_file(std::size_t point) const {
  const Hdf5Reader file(point_file(point));
  if (!file.has_attribute("/", surface_in)) return point_file(point);
  const fs::path shared = path_ / "points" / fs::path(file.text_attribute("/", surface_in)).filename();
  if (!fs::exists(shared))
    throw_input_error("{}: shares the surface in {}, which is missing", point_file(point).string(),
                      shared.string());
  return shared;
}

std::optional<PointResult> SweepFolder::read(std::size_t point) const {
  const fs::path path = point_file(point);
  if (!fs::exists(path)) return std::nullopt;
  try {
    const Hdf5Reader file(path);
    PointResult result;
    const auto verdict =
        std::find(verdict_names.begin(), verdict_names.end(), file.text_attribute("/", "verdict"));
    if (verdict == verdict_names.end() || file.number_attribute("/", "point") != static_cast<double>(point))
      return std::nullopt;
    result.verdict = static_cast<PointVerdict>(verdict - verdict_names.begin());
    result.reason = file.text_attribute("/", "reason");
    for (const Metric& metric : metrics_)
      result.metrics.push_back(file.number_attribute("/metrics", metric.name));
    return result;
  } catch (const Error& error) {
    if (is_of_the_machine(error)) throw;
    return std::nullopt;
  }
}

void SweepFolder::write(std::size_t point, const PointResult& result, const std::string& scene_text,
                        const Surface& surface) const {
  Hdf5Writer file(point_file(point), output_kind(InputKind::point));
  file.attribute("/", "point", static_cast<double>(point));
  file.attribute("/", "verdict", verdict_names[static_cast<std::size_t>(result.verdict)]);
  file.attribute("/", "reason", result.reason);
  file.write("/scene", scene_text);
  file.make_group("/metrics");
  for (std::size_t i = 0; i < metrics_.size(); ++i)
    file.attribute("/metrics", metrics_[i].name, result.metrics[i]);
  if (surface.same_as) {
    file.attribute("/", surface_in, point_file(*surface.same_as).filename().string());
  } else if (surface.heights) {
    write_bed(file, "/surface", *surface.heights);
    file.attribute("/surface", "cell_size", surface.heights->cell_size());
  }
  file.finish();
}

std::string SweepFolder::command(std::size_t point) const {
  std::string command = "sandstroke run " + shell_quoted(manifest_.scene);
  const auto set = [&](const std::string& setting) { command += " --set " + shell_quoted(setting); };
  std::vector<std::string> settings = manifest_.settings;
  for (const std::string& setting : design().settings(point)) settings.push_back(setting);
  for (const std::string& setting : those_that_apply(manifest_.scene, settings)) set(setting);
  return command + fmt::format(" -o point-{:06}.h5", point);
}

}  // namespace sandstroke
