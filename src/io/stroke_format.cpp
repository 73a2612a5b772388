#include "io/stroke_format.h"

#include "core/error.h"

namespace sandstroke {
namespace {

constexpr const char* format = "sandstroke.stroke";
constexpr double format_version = 1.0;

}  // namespace

void check_stroke_format(const Hdf5Reader& file) {
  if (!file.has(stroke_group) || !file.has_attribute(stroke_group, "format") ||
      file.text_attribute(stroke_group, "format") != format) {
    throw_input_error("{}: is not a stroke file ({} has no attribute format = \"{}\"); name another file",
                      file.name(), stroke_group, format);
  }
  const double version = file.has_attribute(stroke_group, "format_version")
                             ? file.number_attribute(stroke_group, "format_version")
                             : 0.0;
  if (version != format_version) {
    throw_input_error(
        "{}: {} has format_version {} (0 = none), and this program reads {}; convert the stroke again",
        file.name(), stroke_group, version, format_version);
  }
}

void write_stroke_attributes(Hdf5Writer& file, const Stroke& stroke) {
  file.attribute(stroke_group, "format", std::string(format));
  file.attribute(stroke_group, "format_version", format_version);
  file.attribute(stroke_group, "nominal_rate", stroke.nominal_rate);
  file.attribute(stroke_group, "gap_threshold", stroke.gap_threshold);
  file.attribute(stroke_group, "source", stroke.source);
  file.attribute(stroke_group, "frame", stroke.frame);
  file.attribute(stroke_group, "complete", stroke.complete ? 1.0 : 0.0);
}

void read_stroke_attributes(const Hdf5Reader& file, Stroke& stroke) {
  const auto has = [&](const char* attribute) { return file.has_attribute(stroke_group, attribute); };
  if (has("nominal_rate")) stroke.nominal_rate = file.number_attribute(stroke_group, "nominal_rate");
  if (has("gap_threshold")) stroke.gap_threshold = file.number_attribute(stroke_group, "gap_threshold");
  if (has("source")) stroke.source = file.text_attribute(stroke_group, "source");
  if (has("frame")) stroke.frame = file.text_attribute(stroke_group, "frame");
  if (has("complete")) stroke.complete = file.number_attribute(stroke_group, "complete") != 0.0;
}

}  // namespace sandstroke
