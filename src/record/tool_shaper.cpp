#include "record/tool_shaper.h"

#include <chrono>
#include <cmath>
#include <utility>

#include "core/error.h"
#include "sand/shaped_tool.h"
#include "tool/tool_surface.h"

namespace sandstroke {

ToolShaper::ToolShaper(const ToolSettings& tool, double distance, double cell_size)
    : settings_(tool),
      distance_(distance),
      cell_size_(cell_size),
      rotation_(own_rotation(tool)),
      asked_(rotation_) {}

void ToolShaper::start() {
  stopping_ = false;
  thread_ = std::thread([this] {
    using std::chrono::milliseconds;
    while (!stopping_) {
      const bool fine = work();
      std::this_thread::sleep_for(fine ? milliseconds(1) : milliseconds(100));
    }
  });
}

void ToolShaper::stop() {
  stopping_ = true;
  if (thread_.joinable()) thread_.join();
}

bool ToolShaper::work() noexcept {
  if (state_.load(std::memory_order_acquire) != asked) return true;
  try {
    auto tool = std::make_unique<ShapedTool>(settings_);
    tool->turn(asked_);
    // The bed holds the whole footprint, so that the tool takes its memory now.
    const int cells = 2 * static_cast<int>(std::ceil(1.5 * tool->farthest() / cell_size_)) + 16;
    tool->place(HeightField(cells, cells, cell_size_), 0.0, 0.0);
    tool->prepare(distance_);
    spare_ = std::move(tool);
    state_.store(made, std::memory_order_release);
    return true;
  } catch (const Error&) {  // too thin for the cells
  } catch (...) {           // the hand goes on feeling: ending the program here would not release the device
    failure_ = std::current_exception();
  }
  state_.store(idle, std::memory_order_release);
  return false;
}

bool ToolShaper::follow(const Eigen::Matrix3d& rotation, SandSide& sand) noexcept {
  const State state = state_.load(std::memory_order_acquire);
  if (state == asked) return false;
  if (state == made) {
    sand.exchange(spare_);
    rotation_ = asked_;
  }
  state_.store(idle, std::memory_order_relaxed);
  if (sand.tool().would_turn(rotation)) {
    asked_ = rotation;
    state_.store(asked, std::memory_order_release);
  }
  return state == made;
}

}  // namespace sandstroke
