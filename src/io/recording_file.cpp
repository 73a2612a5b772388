#include "io/recording_file.h"

#include <cmath>
#include <limits>

#include "core/error.h"
#include "haptics/recording_fields.h"
#include "io/stroke_format.h"

namespace sandstroke {
namespace {

constexpr std::size_t block_samples = 4096;

/// The samples' columns, written block by block.
class SampleColumns {
 public:
  SampleColumns(Hdf5GridWriter& file, const RecordingHeader& header)
      : time_(file.column("/stroke/time")),
        position_(file.column("/stroke/position", 3)),
        switches_(file.column<std::uint32_t>("/stroke/switches")),
        sequence_(file.column<std::uint64_t>("/stroke/sequence")),
        monotonic_time_(file.column<std::int64_t>("/stroke/monotonic_time")),
        flags_(file.column<std::uint32_t>("/stroke/flags")) {
    if (header.device.measures_velocity) velocity_ = file.column("/stroke/velocity", 3);
    if (header.force_limit > 0.0) force_ = file.column("/stroke/force", 3);
    if (header.device.measures_orientation) orientation_ = file.column("/stroke/orientation", 4);
    std::vector<std::string> names = {"time", "position", "switches", "sequence", "monotonic_time", "flags"};
    if (velocity_) names.emplace_back("velocity");
    if (force_) names.emplace_back("force");
    if (orientation_) names.emplace_back("orientation");
    describe_stroke_columns(file, names);
  }

  /// start [ns]: the time of the first sample.
  void append(const std::vector<RecordedSample>& samples, std::int64_t start) {
    const auto put = [&samples](Hdf5Column& column, const auto& value_of) {
      std::vector<std::decay_t<decltype(value_of(samples[0]))>> values;
      for (const RecordedSample& sample : samples) values.push_back(value_of(sample));
      column.append(values.data(), values.size());
    };
    const auto put_vectors = [&samples](Hdf5Column& column, auto field) {
      std::vector<double> numbers;
      for (const RecordedSample& sample : samples)
        numbers.insert(numbers.end(), std::begin(sample.*field), std::end(sample.*field));
      column.append(numbers.data(), samples.size());
    };
    put(time_, [start](const RecordedSample& s) { return static_cast<double>(s.time - start) / 1e9; });
    put_vectors(position_, &RecordedSample::position);
    if (velocity_) put_vectors(*velocity_, &RecordedSample::velocity);
    if (force_) put_vectors(*force_, &RecordedSample::force);
    if (orientation_) put_vectors(*orientation_, &RecordedSample::orientation);
    put(switches_, [](const RecordedSample& s) { return s.switches; });
    put(sequence_, [](const RecordedSample& s) { return s.sequence; });
    put(monotonic_time_, [](const RecordedSample& s) { return s.time; });
    put(flags_, [](const RecordedSample& s) { return s.flags; });
  }

 private:
  Hdf5Column time_, position_, switches_, sequence_, monotonic_time_, flags_;
  std::optional<Hdf5Column> velocity_, force_, orientation_;
};

constexpr const char* attribute_units =
    "s, Hz, m, N, N/m, N s/m; clock_start: ns; yes and no: 1 and 0; for the device's values 0 means none or "
    "unknown, and a force of 1.8e308 N means any. A sample's wall time: started + monotonic_time / 1e9 - "
    "started_monotonic";

/// The footer, with counts that fit the samples there are. recorded: the samples' counts; `elapsed` ends with
/// the last sample.
RecordingFooter settled_footer(const std::optional<RecordingFooter>& footer, const TickCounts& recorded) {
  RecordingFooter settled;
  settled.ticks = recorded;
  if (footer) {
    settled.reason = footer->reason;
    settled.lateness = footer->lateness;
    settled.ticks.elapsed = footer->ticks.elapsed;
    settled.ticks.skipped = footer->ticks.skipped;
    settled.ticks.unread = footer->ticks.unread;
    // Also those ticks that the loop recorded and the disk did not take.
    settled.ticks.dropped =
        footer->ticks.elapsed - recorded.recorded - footer->ticks.skipped - footer->ticks.unread;
  } else {
    constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
    settled.reason = StopReason::cut_off;
    settled.lateness = {unknown, unknown, unknown};
    settled.ticks.skipped = recorded.elapsed - recorded.recorded;
  }
  return settled;
}

struct PutAttribute {
  Hdf5GridWriter& file;

  void operator()(const char* name, const std::string& text) const {
    file.attribute(stroke_group, name, text);
  }
  void operator()(const char* name, const StopReason& reason) const {
    file.attribute(stroke_group, name, std::string(stop_reason_text(reason)));
  }
  template <class Number>
  void operator()(const char* name, const Number& number) const {
    file.attribute(stroke_group, name, number);
  }
};

/// Takes an attribute. A number that an older file does not have keeps its default.
struct TakeAttribute {
  const Hdf5Reader& file;

  void operator()(const char* name, std::string& text) const {
    text = file.text_attribute(stroke_group, name);
  }
  void operator()(const char* name, StopReason& reason) const {
    const std::string text = file.text_attribute(stroke_group, name);
    const std::optional<StopReason> known = stop_reason_of(text);
    if (!known)
      throw_input_error("{}: {} has {} '{}', which is unknown; use a newer version of sandstroke",
                        file.name(), stroke_group, name, text);
    reason = *known;
  }
  void operator()(const char* name, double& number) const {
    if (file.has_attribute(stroke_group, name)) number = file.number_attribute(stroke_group, name);
  }
  /// A count, or yes or no.
  template <class Count>
  void operator()(const char* name, Count& count) const {
    if (!file.has_attribute(stroke_group, name)) return;
    const double number = file.number_attribute(stroke_group, name);
    constexpr double most = most_ticks;
    if (!(std::abs(number) < std::min(most, static_cast<double>(std::numeric_limits<Count>::max()) + 1.0)))
      throw_input_error("{}: {} has {} {}, which is not a count; the file is damaged", file.name(),
                        stroke_group, name, number);
    count = static_cast<Count>(number);
  }
};

}  // namespace

RecordingInfo write_recording_file(const std::filesystem::path& path, Recording& recording) {
  RecordingInfo info;
  info.header = recording.header();
  std::vector<RecordedSample> samples = recording.next(block_samples);
  if (samples.empty())
    throw_input_error(
        "{}: was not made, because the recording has no sample; remove its journal and record again",
        path.string());
  Hdf5GridWriter file(path, recording_output);
  SampleColumns columns(file, info.header);
  const std::int64_t start = samples.front().time;
  TickCounts counted;
  for (; !samples.empty(); samples = recording.next(block_samples)) {
    columns.append(samples, start);
    counted.elapsed = static_cast<std::int64_t>(samples.back().sequence) + 1;
    counted.recorded += static_cast<std::int64_t>(samples.size());
    for (const RecordedSample& sample : samples) count_flags(sample.flags, counted);
  }
  info.footer = settled_footer(recording.footer(), counted);

  Stroke stroke;  // only for its attributes
  stroke.nominal_rate = info.header.nominal_rate;
  stroke.source = info.header.source;
  stroke.frame = info.header.device.frame;
  stroke.complete = info.complete();
  write_stroke_attributes(file, stroke);
  visit_header(info.header, PutAttribute{file});
  visit_footer(info.footer, PutAttribute{file});
  const auto ticks = static_cast<double>(info.footer.ticks.elapsed);
  file.attribute(stroke_group, "duration", std::max(ticks - 1.0, 0.0) / info.header.nominal_rate);
  file.attribute(stroke_group, "starved", is_starved(info.footer));
  file.attribute(stroke_group, "clock", std::string("CLOCK_MONOTONIC"));
  file.attribute(stroke_group, "clock_start", start);
  file.attribute(stroke_group, "units", std::string(attribute_units));
  file.finish();
  return info;
}

std::optional<RecordingInfo> read_recording_info(const std::filesystem::path& path) {
  const Hdf5Reader file(path);
  check_stroke_format(file);
  if (!file.has_attribute(stroke_group, "stop_reason")) return std::nullopt;
  RecordingInfo info;
  visit_header(info.header, TakeAttribute{file});
  visit_footer(info.footer, TakeAttribute{file});
  return info;
}

}  // namespace sandstroke
