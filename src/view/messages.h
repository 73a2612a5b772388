#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "tool/tool_settings.h"
#include "view/live_bed.h"
#include "view/live_state.h"

namespace sandstroke {

// Messages between server and page through a WebSocket. Numbers are little-endian.

/// How a pointer in a page becomes the hand.
struct PointerScale {
  double depth = 0.0;      ///< m below the surface at the start, at full pressure
  double radius = 0.0;     ///< m, of the tool
  double clearance = 0.0;  ///< m above the highest sand at the start, while it is lifted
};

/// The facts that a page needs before the first picture.
struct ViewHello {
  std::string title;
  BedGeometry bed;
  HeightRange heights;  ///< at the start
  ToolSettings tool;
  double max_force = 0.0;               ///< N
  std::optional<PointerScale> pointer;  ///< none: pages only watch
  std::optional<double> bottom = {};    ///< m, of a level floor under the sand
};

/// One place of a pointer.
struct PointerSample {
  double time = 0.0;   ///< ms, on the page's own clock
  float x = 0, y = 0;  ///< m, in the bed
  float pressure = 0;  ///< 0 = lifted, up to 1
  /// The page's button "Finish" presses this switch.
  static constexpr int finish_switch = 31;
  std::uint32_t switches = 0;
};

/// Takes what a pointer in a page does. Called by the server's thread.
class PointerSink {
 public:
  virtual ~PointerSink() = default;
  /// Takes samples that just came from the page whose pointer is the hand.
  virtual void take(std::span<const PointerSample> samples) = 0;
  /// That page is gone.
  virtual void leave() = 0;
};

// To the page, as JSON:
std::string hello_message(const ViewHello& hello);
std::string status_message(std::string_view text);
/// drawing: this page's pointer is the hand.
std::string drawing_message(bool drawing);
std::string end_message(std::string_view reason);

// To the page, in binary:
inline constexpr std::size_t picture_header_bytes = 80;
/// Fills `message`, and reuses its memory. with_load: it ends with the sand on the tool.
void put_picture(const ViewState& state, const LiveBed::Tiles& tiles, bool with_load, std::string& message);

// From the page, in binary:
inline constexpr std::size_t pointer_sample_bytes = 24;
inline constexpr std::size_t most_message_bytes = 8192;  ///< from a page
/// None where the message is not made of whole samples, all of finite numbers.
std::optional<std::vector<PointerSample>> pointer_samples(std::string_view message);

}  // namespace sandstroke
