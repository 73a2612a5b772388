#include <spdlog/spdlog.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "cli/record_parts.h"
#include "cli/standard_output.h"
#include "cli/stroke_parts.h"
#include "cli/table_options.h"
#include "core/error.h"
#include "core/median.h"
#include "core/terminal_text.h"
#include "core/warning.h"
#include "haptics/stroke_coverage.h"
#include "haptics/stroke_quality.h"
#include "import/table_option.h"
#include "io/recording_file.h"
#include "io/stroke_file.h"
#include "record/recording_json.h"

namespace sandstroke {

using Eigen::Vector3d;

StrokeSummary summarize(const Stroke& stroke) {
  StrokeSummary summary;
  summary.samples = stroke.size();
  summary.duration = stroke.duration();
  summary.low = summary.high = stroke.position.front();
  std::vector<double> spacings;
  for (std::size_t i = 0; i < stroke.size(); ++i) {
    summary.drawn_samples += stroke.pen_down(i);
    summary.low = summary.low.cwiseMin(stroke.position[i]);
    summary.high = summary.high.cwiseMax(stroke.position[i]);
    if (i == 0) continue;
    spacings.push_back(stroke.time[i] - stroke.time[i - 1]);
  }
  summary.median_spacing = median(std::move(spacings));
  const StrokeSampler sampler(stroke);
  summary.gaps = sampler.gaps();
  summary.played = played_part(sampler);
  if (!stroke.force.empty()) {
    const auto shorter = [](const Vector3d& a, const Vector3d& b) { return a.norm() < b.norm(); };
    const auto [least, greatest] = std::minmax_element(stroke.force.begin(), stroke.force.end(), shorter);
    summary.least_force = least->norm();
    summary.greatest_force = greatest->norm();
  }
  return summary;
}

std::string recorded_ticks_text(const RecordingFooter& footer) {
  const TickCounts& ticks = footer.ticks;
  if (footer.reason != StopReason::cut_off) return ticks_text(ticks);
  return fmt::format("{} up to the last sample: {} recorded, {} missing", ticks.elapsed, ticks.recorded,
                     ticks.elapsed - ticks.recorded);
}

namespace {

std::string table_row(std::string_view title, const std::string& value) {
  return fmt::format("{:<11}{}\n", title, terminal_line(value));
}

/// The mean rate of the samples [Hz].
double reached_rate(const StrokeSummary& summary) {
  return summary.samples > 1 ? static_cast<double>(summary.samples - 1) / summary.duration : 0.0;
}

std::string recording_rows(const RecordingInfo& recording, const StrokeSummary& summary) {
  const auto& [header, footer] = recording;
  std::string device = header.device.model;
  if (!header.device.manufacturer.empty()) device += fmt::format(" ({})", header.device.manufacturer);
  if (header.device.max_force > 0.0 && header.device.max_force < any_force)
    device += fmt::format(", up to {:.4g} N", header.device.max_force);
  return table_row("device", device) + table_row("recorded", header.started) +
         table_row("loop", fmt::format("{:.6g} Hz asked, {:.6g} samples a second; {}", header.nominal_rate,
                                       reached_rate(summary), scheduling_text(header.scheduling))) +
         table_row("ticks", recorded_ticks_text(footer)) +
         table_row("lateness",
                   std::isnan(footer.lateness.mean)
                       ? fmt::format("unknown; {} samples were over half a tick late", footer.ticks.late)
                       : lateness_text(footer)) +
         table_row("ended", stop_reason_text(footer.reason));
}

nlohmann::ordered_json as_json(const StrokeQuality& quality) {
  return {{"jitter", quality.jitter},
          {"repeated_share", quality.repeats.fraction},
          {"repeat_period", quality.repeats.period},
          {"noise", quality.noise},
          {"top_speed", quality.top_speed},
          {"usual_speed", quality.usual_speed},
          {"plane_tilt_deg", quality.plane.tilt()},
          {"plane_rms", quality.plane.rms()},
          {"plane_largest", quality.plane.largest}};
}

}  // namespace

nlohmann::ordered_json stroke_json(const std::string& file, const Stroke& stroke,
                                   const std::optional<RecordingInfo>& recording) {
  const StrokeSummary summary = summarize(stroke);
  nlohmann::ordered_json json;
  json["file"] = file;
  json["source"] = stroke.source;
  json["frame"] = stroke.frame;
  json["complete"] = stroke.complete;
  json["starved"] = stroke.starved;
  json["samples"] = summary.samples;
  json["drawn_samples"] = summary.drawn_samples;
  json["duration"] = summary.duration;
  json["nominal_rate"] = stroke.nominal_rate;
  json["median_spacing"] = summary.median_spacing;
  for (int axis = 0; axis < 3; ++axis)
    json[std::string("extent_") + "xyz"[axis]] = {summary.low[axis], summary.high[axis]};
  json["gap_threshold"] = stroke.gap_threshold;
  json["played_seconds"] = summary.played.played;
  json["gaps"] = nlohmann::json::array();
  for (const StrokeGap& gap : summary.gaps) json["gaps"].push_back({gap.begin, gap.end});
  if (!stroke.force.empty()) json["force"] = {summary.least_force, summary.greatest_force};
  if (recording) {
    nlohmann::ordered_json& recorded = json["recording"] = as_json(recording->header);
    recorded.update(as_json(recording->footer));
    recorded["rate"] = reached_rate(summary);
  }
  json.update(as_json(quality_of(stroke)));
  return json;
}

namespace {

std::string quality_rows(const StrokeQuality& quality) {
  const LeastSquaresPlane& plane = quality.plane;
  const Repeats& repeats = quality.repeats;
  return table_row("jitter", fmt::format("{:.3g} ms rms of the spacing", 1e3 * quality.jitter)) +
         table_row("repeats",
                   fmt::format("{:.3g} % of the samples{}", 100.0 * repeats.fraction,
                               repeats.period > 1 ? fmt::format(", up to {} alike", repeats.period) : "")) +
         table_row("noise", fmt::format("{:.3g} mm rms", 1e3 * quality.noise)) +
         table_row("plane", plane.is_line()
                                ? "none: the stroke is a line"
                                : fmt::format("tilted {:.3g} deg, {:.3g} mm rms off it, {:.3g} mm at most",
                                              plane.tilt(), 1e3 * plane.rms(), 1e3 * plane.largest)) +
         table_row("speed", fmt::format("{:.4g} m/s usually, {:.4g} m/s at most (at {:.4g} s), without gaps",
                                        quality.usual_speed, quality.top_speed, quality.top_time));
}

std::string as_table(const std::string& file, const Stroke& stroke, const StrokeSummary& summary,
                     const StrokeQuality& quality, const std::optional<RecordingInfo>& recording) {
  std::string table;
  const auto row = [&table](std::string_view title, const std::string& value) {
    table += table_row(title, value);
  };
  row("file", file);
  row("source", stroke.source.empty() ? "unknown" : stroke.source);
  row("frame", stroke.frame);
  row("complete", stroke.complete ? "yes"
                  : recording     ? fmt::format("no: {}", stop_reason_text(recording->footer.reason))
                                  : "no: the recording was cut off");
  row("samples",
      std::to_string(summary.samples) +
          (stroke.contact.empty() ? "" : fmt::format(", {} with the pen down", summary.drawn_samples)));
  row("duration", fmt::format("{:.6g} s", summary.duration));
  row("rate",
      fmt::format("{}, median spacing {:.6g} ms",
                  stroke.nominal_rate > 0.0 ? fmt::format("{:.6g} Hz", stroke.nominal_rate) : "unknown",
                  1e3 * summary.median_spacing));
  for (int axis = 0; axis < 3; ++axis) {
    row({&"xyz"[axis], 1},
        fmt::format("{:>10.3f} to {:>10.3f} mm, {:>10.3f} mm wide", 1e3 * summary.low[axis],
                    1e3 * summary.high[axis], 1e3 * (summary.high[axis] - summary.low[axis])));
  }
  table += quality_rows(quality);
  row("gaps",
      summary.gaps.empty()
          ? "none"
          : fmt::format("{}, {:.6g} s in all (pen lifted, or over {:.6g} s without a sample); a run {}",
                        summary.gaps.size(), summary.played.whole - summary.played.played,
                        stroke.gap_threshold, played_text(summary.played)));
  row("force", stroke.force.empty()
                   ? "not recorded"
                   : fmt::format("{:.4g} to {:.4g} N", summary.least_force, summary.greatest_force));
  if (const auto [least, greatest] = std::minmax_element(stroke.pressure.begin(), stroke.pressure.end());
      least != stroke.pressure.end())
    row("pressure", fmt::format("{:.4g} to {:.4g}", *least, *greatest));
  if (recording) table += recording_rows(*recording, summary);
  return table;
}

/// Refuses options that say how a table is read where none is read.
void refuse_options_without_table(const std::string& file, const TableOptions& given) {
  if (!is_recorded(file) && !is_script(file)) return;
  for (const auto& [key, value] : given)
    if (!value.empty())
      throw_input_error("{}: is a {} stroke, which {} does not change; leave it out", file,
                        is_recorded(file) ? "recorded" : "scripted", option_of(key));
}

}  // namespace

void add_stroke_info_command(CLI::App& stroke_app, Command& chosen) {
  struct Options {
    std::string file;
    TableOptions table;
    bool json = false;
  };
  auto options = std::make_shared<Options>();
  CLI::App* app = stroke_app.add_subcommand(
      "info", "Show the content of a stroke file, or what 'stroke convert' would make of another file");
  app->add_option("FILE", options->file,
                  "Recorded (.h5) or scripted (.toml) stroke, or any file that 'stroke convert' reads")
      ->type_name(stroke_file_type)
      ->option_text("REQUIRED")
      ->required();
  app->add_flag("--json", options->json, "One JSON object in SI units instead of a table");
  add_table_options(*app, options->table);
  app->callback([&chosen, options] {
    chosen = [options] {
      refuse_options_without_table(options->file, options->table);
      const Stroke stroke = load_stroke(options->file, ForceSettings{}, table_settings(options->table));
      const StrokeQuality quality = quality_of(stroke);
      const std::optional<RecordingInfo> recording =
          is_recorded(options->file) ? read_recording_info(options->file) : std::nullopt;
      if (options->json) {
        print_json(stroke_json(options->file, stroke, recording));
      } else {
        print_text("{}", as_table(options->file, stroke, summarize(stroke), quality, recording));
      }
      warn_if_any(WarningCode::stroke_gaps, coverage_warning(stroke, options->file));
      for (const std::string& warning : quality_warnings(quality))
        warn({WarningCode::stroke_quality, fmt::format("{}: {}", options->file, warning)});
      return 0;
    };
  });
}

}  // namespace sandstroke
