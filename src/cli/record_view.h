#pragma once

#include <optional>

#include "cli/announce_view.h"
#include "cli/recent_rate.h"
#include "record/live_sand.h"
#include "record/servo_loop.h"
#include "view/pointer_device.h"
#include "view/view_server.h"

namespace sandstroke {

/// The sand of a recording, live in pages (`record --view`). Outlives the sand that it follows.
class RecordView {
 public:
  /// start: the bed before anything touches it. max_force [N]: on the hand. pointer: none, where pages only
  /// watch, and then it waits for one of them, or an interrupt; outlives it. Error: input, for a bed that is
  /// too large; io.
  RecordView(const std::string& title, const Scene& scene, const HeightField& start, double max_force,
             PointerDevice* pointer, bool opens);

  /// Before the sand starts.
  void follow(LiveSand& sand);
  /// Of the recording that goes on.
  void show(const ServoProgress& progress);
  /// The sand is finished.
  void end(const std::string& reason);

 private:
  LiveBed bed_;
  LiveState state_;
  ViewServer server_;
  std::unique_ptr<ViewOpener> opener_;
  const LiveSand* sand_ = nullptr;
  RecentRate rate_;
};

}  // namespace sandstroke
