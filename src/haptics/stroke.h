#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <string>
#include <vector>

namespace sandstroke {

/// Whether the pen is down at a sample. If every sample was drawn, none can mark the gaps between pen
/// strokes. So the last sample of a pen stroke says that the pen lifts right after it.
enum PenState : std::uint8_t { pen_up = 0, pen_down = 1, pen_lifts = 2 };

/// Which force a stroke holds: the force on the device, which the hand feels, or the force by the hand.
enum class ForceSign { not_said, on_device, by_hand };
inline const std::vector<std::string> force_sign_names = {"unknown", "on device", "by hand"};

/// A hand motion over time, recorded or scripted: n samples of a tool tip, z up. Optional columns are empty
/// or have n entries.
struct Stroke {
  std::vector<double> time;                    ///< s, strictly increasing
  std::vector<Eigen::Vector3d> position;       ///< m, in `frame`
  std::vector<Eigen::Vector3d> velocity;       ///< m/s, as recorded (optional)
  std::vector<Eigen::Vector3d> force;          ///< N, as recorded (optional)
  std::vector<Eigen::Vector4d> orientation;    ///< of the tool: unit quaternions x, y, z, w (optional)
  std::vector<double> pressure;                ///< of the pen, in its own unit (optional)
  std::vector<std::uint32_t> switches;         ///< a bit per device switch (optional)
  std::vector<std::uint32_t> flags;            ///< a recorder's SampleFlag bits (optional)
  std::vector<std::uint8_t> contact;           ///< a PenState each (optional); without it the pen is down
  double nominal_rate = 0.0;                   ///< Hz; 0 = unknown
  double gap_threshold = 0.1;                  ///< s; samples further apart are not joined: the tool lifts
  double tip_speed = 0.0;                      ///< m/s that `time` was made for, at any scale; 0: recorded
  std::string source;                          ///< where it came from, for people
  std::string frame = "bed";                   ///< "bed" or "device"
  ForceSign force_sign = ForceSign::not_said;  ///< of `force`
  bool follows_sand = false;                   ///< heights count from the sand under the tip, not from z = 0
  bool complete = true;                        ///< false: cut off while being recorded
  bool starved = false;                        ///< its recorder skipped many ticks (is_starved)

  std::size_t size() const { return time.size(); }
  double duration() const { return time.empty() ? 0.0 : time.back() - time.front(); }

  /// Whether the pen is down at sample i.
  bool pen_down(std::size_t i) const { return contact.empty() || contact[i] != pen_up; }
  /// Whether it is known where the hand is between samples i and i + 1.
  bool sampled_between(std::size_t i) const {
    return i + 1 < size() && time[i + 1] - time[i] <= gap_threshold &&
           (contact.empty() || contact[i] != pen_lifts);
  }
  /// Whether samples i and i + 1 are drawn as one line; otherwise the tool is lifted between them.
  bool joined(std::size_t i) const { return sampled_between(i) && pen_down(i) && pen_down(i + 1); }
};

/// Calls visit(name, column) for each column of a stroke, with its name in files. It is the only list of
/// them. Optional ones may be empty.
template <class AnyStroke, class Visit>
void visit_columns(AnyStroke& stroke, const Visit& visit) {
  visit("time", stroke.time);
  visit("position", stroke.position);
  visit("velocity", stroke.velocity);
  visit("force", stroke.force);
  visit("orientation", stroke.orientation);
  visit("pressure", stroke.pressure);
  visit("switches", stroke.switches);
  visit("flags", stroke.flags);
  visit("contact", stroke.contact);
}

/// Keeps the samples [begin, end), or these samples in their order, and removes all others from all columns.
void keep_samples(Stroke& stroke, std::size_t begin, std::size_t end);
void keep_samples(Stroke& stroke, const std::vector<std::size_t>& samples);

/// Largest time, coordinate and speed [s, m, m/s]. Beyond it, what follows from them is not finite.
inline constexpr double most_in_stroke = 1e50;

/// Checks what every reader and maker of a stroke guarantees: at least one sample, columns of equal length,
/// finite numbers, times, positions and velocities of at most most_in_stroke, times that increase by at least
/// 1e-50 s. Error: input; `name` says which stroke, the sentence names column and sample.
void check_stroke(const Stroke& stroke, const std::string& name);

}  // namespace sandstroke
