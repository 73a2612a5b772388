#include "haptics/stroke.h"

#include <cmath>

#include "core/error.h"

namespace sandstroke {
namespace {

// Beyond these limits, speeds between samples and the cubic terms of a curve through them are not finite.
constexpr double most = most_in_stroke;
constexpr double least_step = 1e-50;  // s

void check_length(std::size_t length, const char* column, const Stroke& stroke, const std::string& name) {
  if (length == stroke.size()) return;
  throw_input_error("{}: {} has {} rows but time has {}; give every column one row per sample", name, column,
                    length, stroke.size());
}

void check_vectors(const std::vector<Eigen::Vector3d>& rows, const char* column, const Stroke& stroke,
                   const std::string& name) {
  check_length(rows.size(), column, stroke, name);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (rows[i].allFinite()) continue;
    throw_input_error(
        "{}: {} of sample {} is ({}, {}, {}), which is not finite; correct or remove that sample", name,
        column, i, rows[i].x(), rows[i].y(), rows[i].z());
  }
}

void check_orientation(const Stroke& stroke, const std::string& name) {
  check_length(stroke.orientation.size(), "orientation", stroke, name);
  for (std::size_t i = 0; i < stroke.size(); ++i) {
    if (std::abs(stroke.orientation[i].norm() - 1.0) < 1e-6) continue;
    throw_input_error(
        "{}: orientation of sample {} is not a unit quaternion (its length is {}); correct or remove that "
        "sample",
        name, i, stroke.orientation[i].norm());
  }
}

}  // namespace

void keep_samples(Stroke& stroke, std::size_t begin, std::size_t end) {
  visit_columns(stroke, [&](const char*, auto& column) {
    if (column.empty()) return;
    column.resize(end);
    column.erase(column.begin(), column.begin() + static_cast<std::ptrdiff_t>(begin));
  });
}

void keep_samples(Stroke& stroke, const std::vector<std::size_t>& samples) {
  visit_columns(stroke, [&](const char*, auto& column) {
    if (column.empty()) return;
    for (std::size_t i = 0; i < samples.size(); ++i) column[i] = column[samples[i]];
    column.resize(samples.size());
  });
}

void check_stroke(const Stroke& stroke, const std::string& name) {
  if (stroke.time.empty()) throw_input_error("{}: time has no samples; a stroke needs at least one", name);
  for (std::size_t i = 0; i < stroke.size(); ++i) {
    const double t = stroke.time[i];
    if (!(std::abs(t) <= most))
      throw_input_error(
          "{}: time of sample {} is {} s, which is not finite, or beyond {}; correct or remove that sample",
          name, i, t, most);
    if (i > 0 && !(t - stroke.time[i - 1] >= least_step)) {
      throw_input_error(
          "{}: time of sample {} is {} s, not later than {} s, the time of the sample before; times must "
          "increase by {} s or more; correct or remove that sample",
          name, i, t, stroke.time[i - 1], least_step);
    }
  }
  check_vectors(stroke.position, "position", stroke, name);
  for (std::size_t i = 0; i < stroke.size(); ++i) {
    if ((stroke.position[i].array().abs() <= most).all()) continue;
    throw_input_error(
        "{}: position of sample {} is ({}, {}, {}) m, beyond {} m; correct or remove that sample", name, i,
        stroke.position[i].x(), stroke.position[i].y(), stroke.position[i].z(), most);
  }
  if (!stroke.velocity.empty()) check_vectors(stroke.velocity, "velocity", stroke, name);
  for (std::size_t i = 0; i < stroke.velocity.size(); ++i)
    if (!(stroke.velocity[i].array().abs() <= most).all())
      throw_input_error(
          "{}: velocity of sample {} is ({}, {}, {}) m/s, beyond {} m/s; correct or remove that sample", name,
          i, stroke.velocity[i].x(), stroke.velocity[i].y(), stroke.velocity[i].z(), most);
  if (!stroke.force.empty()) check_vectors(stroke.force, "force", stroke, name);
  if (!stroke.orientation.empty()) check_orientation(stroke, name);
  if (!stroke.pressure.empty()) check_length(stroke.pressure.size(), "pressure", stroke, name);
  for (std::size_t i = 0; i < stroke.pressure.size(); ++i)
    if (!std::isfinite(stroke.pressure[i]))
      throw_input_error("{}: pressure of sample {} is {}, which is not finite; correct or remove that sample",
                        name, i, stroke.pressure[i]);
  if (!stroke.switches.empty()) check_length(stroke.switches.size(), "switches", stroke, name);
  if (!stroke.flags.empty()) check_length(stroke.flags.size(), "flags", stroke, name);
  if (!stroke.contact.empty()) check_length(stroke.contact.size(), "contact", stroke, name);
  for (std::size_t i = 0; i < stroke.contact.size(); ++i) {
    if (stroke.contact[i] <= pen_lifts) continue;
    throw_input_error(
        "{}: contact of sample {} is {}; it must be 0 (pen up), 1 (down) or 2 (down, lifts right after)",
        name, i, stroke.contact[i]);
  }
  if (!(stroke.gap_threshold > 0.0) || !std::isfinite(stroke.gap_threshold))
    throw_input_error("{}: gap_threshold is {} s; it must be a positive number", name, stroke.gap_threshold);
  if (!(stroke.nominal_rate >= 0.0) || !std::isfinite(stroke.nominal_rate))
    throw_input_error("{}: nominal_rate is {} Hz; it must be positive, or 0 if unknown", name,
                      stroke.nominal_rate);
  if (stroke.frame != "bed" && stroke.frame != "device")
    throw_input_error("{}: frame is '{}'; it must be 'bed' or 'device'", name, stroke.frame);
}

}  // namespace sandstroke
