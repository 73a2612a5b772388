#include "sweep/sweep_file.h"

#include <algorithm>
#include <numeric>

#include "hdf5/hdf5_grid_writer.h"
#include "io/bed_writer.h"
#include "io/input_kind.h"

namespace sandstroke {
namespace {

class SweepFile {
 public:
  SweepFile(const std::filesystem::path& path, const CollectedSweep& sweep)
      : file_(path, output_kind(InputKind::sweep)),
        sweep_(sweep),
        design_(sweep.folder.design()),
        shape_(design_.shape()) {
    if (!design_.grid) scales_ = {"point"};
    for (const SweepAxis& axis : design_.axes)
      if (design_.grid) scales_.push_back(axis.key);
  }

  void write(const std::string& content_hash) {
    const SweepManifest& manifest = sweep_.folder.manifest();
    file_.attribute("/", "content_hash", content_hash);
    file_.attribute("/", "version", manifest.version);
    file_.attribute("/", "commit", manifest.commit);
    file_.attribute("/", "scene", manifest.scene);
    write_axes();
    write_verdicts();
    const std::vector<Metric>& metrics = sweep_.folder.metrics();
    for (std::size_t i = 0; i < metrics.size(); ++i) write_metric(metrics[i], i);
    if (sweep_.bed) write_surfaces(*sweep_.bed);
    file_.finish();
  }

 private:
  template <class Value, class Of>
  std::vector<Value> over_points(const Of& of) const {
    std::vector<Value> values;
    for (std::size_t point = 0; point < sweep_.results.size(); ++point) values.push_back(of(point));
    return values;
  }

  /// Writes an array over the axes.
  template <class Value>
  void put(const std::string& name, const std::vector<Value>& values) {
    file_.write(name, shape_, values);
    file_.attach_scales(name, scales_);
  }

  void write_axes() {
    std::vector<std::uint32_t> points(sweep_.results.size());
    std::iota(points.begin(), points.end(), 0u);
    file_.write("point", shape_, points);
    if (!design_.grid) file_.make_scale("point");
    for (const SweepAxis& axis : design_.axes) {
      std::vector<double> numbers;
      std::vector<std::string> labels;
      for (std::size_t i = 0; i < axis.values.size(); ++i) {
        numbers.push_back(axis.number(i));
        labels.push_back(axis.label(i));
      }
      if (axis.numeric())
        file_.write(axis.key, {numbers.size()}, numbers);
      else
        file_.write(axis.key, {labels.size()}, labels);
      if (!axis.unit.empty()) file_.attribute(axis.key, "units", axis.unit);
      if (design_.grid)
        file_.make_scale(axis.key);
      else
        file_.attach_scales(axis.key, scales_);
    }
    if (design_.grid) file_.attach_scales("point", scales_);
  }

  void write_verdicts() {
    put("verdict", over_points<std::uint8_t>(
                       [&](std::size_t point) { return static_cast<std::uint8_t>(sweep_.verdict(point)); }));
    std::vector<std::uint8_t> values(verdict_names.size() + 1);
    std::iota(values.begin(), values.end(), std::uint8_t{0});
    std::string meanings;
    for (std::string name : verdict_names) {
      std::replace(name.begin(), name.end(), ' ', '_');  // blanks separate the words of flag_meanings
      meanings += name + " ";
    }
    file_.attribute("verdict", "flag_values", values);
    file_.attribute("verdict", "flag_meanings", meanings + missing_verdict);
    const auto reasons = over_points<std::string>([&](std::size_t point) { return sweep_.reason(point); });
    if (std::any_of(reasons.begin(), reasons.end(),
                    [](const std::string& reason) { return !reason.empty(); }))
      put("reason", reasons);
  }

  void write_metric(const Metric& metric, std::size_t index) {
    const std::string name = metric.timing ? "timing/" + metric.name : metric.name;
    put(name, over_points<double>([&](std::size_t point) { return sweep_.metric(point, index); }));
    file_.attribute(name, "long_name", metric.title);
    file_.attribute(name, "comment", metric.definition);
    if (!metric.unit.empty()) file_.attribute(name, "units", metric.unit);
    if (!metric.timing) file_.attribute(name, "coordinates", coordinates());
  }

  /// The names of further arrays that locate a value (CF conventions).
  std::string coordinates() const {
    if (design_.grid) return "point";
    std::string names;
    for (const SweepAxis& axis : design_.axes) names += (names.empty() ? "" : " ") + axis.key;
    return names;
  }

  void write_surfaces(const BedGeometry& bed) {
    write_bed_axes(file_, "", bed);
    std::vector<Hdf5GridWriter::Block> parts;
    for (std::size_t point = 0; point < sweep_.surfaces.size(); ++point) {
      if (!sweep_.surfaces[point]) continue;
      const auto file = sweep_.surfaces[point]->file.lexically_relative(sweep_.folder.path());
      parts.push_back({point, file.string(), "/surface"});
    }
    file_.write_virtual("surface", shape_, static_cast<std::size_t>(bed.rows()),
                        static_cast<std::size_t>(bed.cols()), parts);
    std::vector<std::string> scales = scales_;
    scales.insert(scales.end(), {"y", "x"});
    file_.attach_scales("surface", scales);
    file_.attribute("surface", "long_name", "height of the sand");
    file_.attribute("surface", "units", "m");
    file_.attribute("surface", "coordinates", coordinates());
  }

  Hdf5GridWriter file_;
  const CollectedSweep& sweep_;
  const SweepDesign& design_;
  std::vector<std::size_t> shape_;
  std::vector<std::string> scales_;  // one per dimension
};

}  // namespace

void write_sweep_file(const std::filesystem::path& path, const CollectedSweep& sweep,
                      const std::string& content_hash) {
  SweepFile(path, sweep).write(content_hash);
}

}  // namespace sandstroke
