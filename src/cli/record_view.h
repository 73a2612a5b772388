#pragma once

#include <optional>

#include "cli/announce_view.h"
#include "cli/recent_rate.h"
#include "record/live_sand.h"
#include "record/servo_loop.h"
#include "view/pointer_device.h"
#include "view/view_server.h"

namespace sandstroke {

/// Shows the sand of a recording live in pages (`record --view`). Must outlive the sand that it follows.
class RecordView {
 public:
  /// start: the untouched bed. max_force: on the hand [N]. pointer: the device that pages drive; it must
  /// outlive the view. Without it pages only watch, and the constructor waits for one, or for an interrupt.
  /// Error: input, for a bed that is too large; io.
  RecordView(const std::string& title, const Scene& scene, const HeightField& start, double max_force,
             PointerDevice* pointer, bool opens);

  /// Call it before the sand starts.
  void follow(LiveSand& sand);
  /// Shows the progress of the recording.
  void show(const ServoProgress& progress);
  /// Call it when the sand is finished, which shows it a last time.
  void end(const std::string& reason) { server_.end(reason); }

 private:
  LiveBed bed_;
  LiveState state_;
  ViewServer server_;
  std::unique_ptr<ViewOpener> opener_;
  const LiveSand* sand_ = nullptr;
  RecentRate rate_;
};

}  // namespace sandstroke
