#pragma once

#include <cstddef>
#include <iterator>
#include <string>
#include <vector>

namespace sandstroke {

/// What makes a result doubtful, in the order of a run's steps. warning_kinds lists them for users.
enum class WarningCode {
  stroke_import,
  stroke_cut_off,
  stroke_gaps,
  stroke_off_plane,
  stroke_smooth,
  stroke_quality,
  stroke_deep,
  tool_mesh,
  map_radians,
  tool_coarse,
  moisture_coarse,
  nothing_touched,
  furrow_shallow,
  stroke_in_floor,
  load_leaks,
  load_slides,
  force_theory,
  drag_limited,
  loop_active,
  loop_swings,
  not_at_rest,
  error_unreliable,
  error_unknown,
};

/// A code as a word, the section of the scene whose step makes the result doubtful, and what it means.
struct WarningKind {
  const char* word;
  const char* section;
  const char* meaning;
};

/// By WarningCode.
inline constexpr WarningKind warning_kinds[] = {
    {"stroke-import", "stroke", "part of the file of the stroke was not understood, or was left out"},
    {"stroke-cut-off", "stroke", "the recording of the stroke was cut off"},
    {"stroke-gaps", "stroke", "samples cover little of the stroke, and the tool is lifted in the rest"},
    {"stroke-off-plane", "stroke", "the stroke begins or ends off the plane that is fitted to it"},
    {"stroke-smooth", "stroke", "stroke.smooth changes nothing"},
    {"stroke-quality", "stroke", "the stroke is larger or faster than a hand's, jumps, or repeats samples"},
    {"stroke-deep", "stroke", "the stroke goes many times deeper than the tool's size"},
    {"tool-mesh", "tool", "the mesh had faults that were mended"},
    {"map-radians", "sand.map", "the angles of the map are so small that they look like radians"},
    {"tool-coarse", "tool", "few cells resolve the tool"},
    {"moisture-coarse", "moisture", "few cells resolve the height of a cut that stands"},
    {"nothing-touched", "stroke", "the tool never touched sand"},
    {"furrow-shallow", "displacement", "the furrow is less than half as deep as the stroke asked for"},
    {"stroke-in-floor", "stroke", "the stroke goes into a stone or the floor"},
    {"load-leaks", "tool",
     "walls of a tool that carries sand are thinner than cells, so that it runs through"},
    {"load-slides", "tool", "the tool moves so hard that sand would slide off it, which is not modelled"},
    {"force-theory", "force", "sand or speed are outside of what the law of the force was made for"},
    {"drag-limited", "device", "device.drag = implicit limited the drag"},
    {"loop-active", "device", "the sand returned more energy to the device than it had taken"},
    {"loop-swings", "device", "the device swings by itself; exit code 3"},
    {"not-at-rest", "relaxation", "the sand did not come to rest; exit code 3"},
    {"error-unreliable", "relaxation", "the estimated error is not reliable: sand was not at rest"},
    {"error-unknown", "relaxation", "the error could not be estimated; exit code 3"},
};
static_assert(std::size(warning_kinds) == static_cast<std::size_t>(WarningCode::error_unknown) + 1);

/// A sentence on what makes a result doubtful, and the code by which scripts know it.
struct Warning {
  WarningCode code;
  std::string text;

  const WarningKind& kind() const { return warning_kinds[static_cast<std::size_t>(code)]; }
  /// As it is logged: "the sand is not at rest [relaxation: not-at-rest]".
  std::string line() const { return text + " [" + kind().section + ": " + kind().word + "]"; }
};

/// Logs a warning, and adds it to the lists of this thread that live.
void warn(const Warning& warning);

/// The same, unless the sentence is empty.
void warn_if_any(WarningCode code, const std::string& sentence);

/// Keeps the warnings that this thread gives while it lives. Lists may be within one another.
class WarningList {
 public:
  WarningList();
  ~WarningList();
  WarningList(const WarningList&) = delete;
  WarningList& operator=(const WarningList&) = delete;
  const std::vector<Warning>& warnings() const { return warnings_; }

 private:
  friend void warn(const Warning& warning);
  std::vector<Warning> warnings_;
  WarningList* around_;
};

}  // namespace sandstroke
