#include "io/stroke_format.h"

#include <algorithm>

#include "core/error.h"
#include "haptics/gap_threshold.h"

namespace sandstroke {
namespace {

constexpr const char* format = "sandstroke.stroke";
constexpr int format_version = 1;

/// Texts in the file, for people who read it without this program.
struct ColumnText {
  const char *name, *units, *meaning;  // units: empty if it has none
  bool is_vector = false;
};
constexpr ColumnText column_texts[] = {
    {"time", "s", "time since the first sample, taken right before the device was read"},
    {"position", "m", "position as the device gave it, in its frame (attribute frame of /stroke)", true},
    {"velocity", "m/s", "velocity as the device gave it, in its frame", true},
    {"force", "N",
     "force on the hand, commanded after this reading and held until the next, in the device's frame", true},
    {"orientation", "", "orientation of the tool, as a unit quaternion x, y, z, w, in the positions' frame"},
    {"pressure", "", "pressure of the pen, in its own unit"},
    {"switches", "", "pressed switches: switch k is bit k"},
    {"sequence", "", "number of the tick, from 0; ticks without a sample are missing"},
    {"monotonic_time", "ns", "time, as the system's clock gave it (attribute clock of /stroke)"},
    {"flags", "",
     "sum of: 1 read over half a tick late, 2 ticks before it are missing, 4 force cut to the limit, 8 force "
     "fading in, 16 change of force limited, 32 force was not a number and not given, 64 tool did not "
     "displace sand because relaxation was late, 128 no force given because the tool had not been out of the "
     "sand before, 256 the force is the model's and no hand felt it"},
    {"contact", "", "pen: 0 is up, 1 is down, 2 lifts right after this sample"},
};

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
        "{}: {} has format_version {} (0 = none), but this program reads {}; convert the stroke again",
        file.name(), stroke_group, version, format_version);
  }
}

void write_stroke_attributes(Hdf5GridWriter& file, const Stroke& stroke) {
  file.attribute(stroke_group, "format", std::string(format));
  file.attribute(stroke_group, "format_version", format_version);
  file.attribute(stroke_group, "nominal_rate", stroke.nominal_rate);
  file.attribute(stroke_group, "gap_threshold", stroke.gap_threshold);
  file.attribute(stroke_group, "source", stroke.source);
  file.attribute(stroke_group, "frame", stroke.frame);
  file.attribute(stroke_group, "complete", stroke.complete);
  if (stroke.force_sign != ForceSign::not_said)
    file.attribute(stroke_group, "force_sign", force_sign_names[static_cast<std::size_t>(stroke.force_sign)]);
  if (stroke.tip_speed > 0.0) file.attribute(stroke_group, "tip_speed", stroke.tip_speed);
  if (stroke.follows_sand) file.attribute(stroke_group, "follows_sand", true);
}

void read_stroke_attributes(const Hdf5Reader& file, Stroke& stroke) {
  const auto has = [&](const char* attribute) { return file.has_attribute(stroke_group, attribute); };
  if (has("nominal_rate")) stroke.nominal_rate = file.number_attribute(stroke_group, "nominal_rate");
  stroke.gap_threshold = has("gap_threshold") ? file.number_attribute(stroke_group, "gap_threshold")
                                              : usual_gap_threshold(stroke);
  if (has("tip_speed")) stroke.tip_speed = file.number_attribute(stroke_group, "tip_speed");
  if (has("source")) stroke.source = file.text_attribute(stroke_group, "source");
  if (has("frame")) stroke.frame = file.text_attribute(stroke_group, "frame");
  if (has("complete")) stroke.complete = file.number_attribute(stroke_group, "complete") != 0.0;
  if (has("force_sign")) {
    const std::string said = file.text_attribute(stroke_group, "force_sign");
    const auto found = std::find(force_sign_names.begin(), force_sign_names.end(), said);
    if (found == force_sign_names.end())
      throw_input_error("{}: {} has force_sign '{}'; it must be one of: {}", file.name(), stroke_group, said,
                        fmt::join(force_sign_names, ", "));
    stroke.force_sign = static_cast<ForceSign>(found - force_sign_names.begin());
  }
  if (has("follows_sand")) stroke.follows_sand = file.number_attribute(stroke_group, "follows_sand") != 0.0;
  if (has("starved")) stroke.starved = file.number_attribute(stroke_group, "starved") != 0.0;
}

void describe_stroke_columns(Hdf5GridWriter& file, const std::vector<std::string>& names) {
  const std::string group = std::string(stroke_group) + "/", time = group + "time", axis = group + "axis";
  file.make_scale(time);
  file.write_scale(axis, {"x", "y", "z"});
  const std::string component = group + "component";
  const auto is_there = [&](const char* name) {
    return std::find(names.begin(), names.end(), name) != names.end();
  };
  if (is_there("orientation")) file.write_scale(component, {"x", "y", "z", "w"});
  for (const ColumnText& text : column_texts) {
    if (!is_there(text.name)) continue;
    file.describe(group + text.name, text.units, text.meaning);
    if (group + text.name == time) continue;
    std::vector<std::string> scales{time};
    if (text.is_vector) scales.push_back(axis);
    if (text.name == std::string_view("orientation")) scales.push_back(component);
    file.attach_scales(group + text.name, scales);
  }
}

}  // namespace sandstroke
