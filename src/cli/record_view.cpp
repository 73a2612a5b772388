#include "cli/record_view.h"

#include "view/live_page.h"

namespace sandstroke {
namespace {

ViewHello hello_of(const std::string& title, const Scene& scene, const HeightField& start, double max_force,
                   const PointerDevice* pointer) {
  return {title,
          start,
          height_range(start),
          scene.tool,
          max_force,
          pointer ? std::optional(pointer->scale()) : std::nullopt,
          level_bottom(start)};
}

}  // namespace

RecordView::RecordView(const std::string& title, const Scene& scene, const HeightField& start,
                       double max_force, PointerDevice* pointer, bool opens)
    : bed_(start),
      server_({bed_, state_, hello_of(title, scene, start, max_force, pointer), live_page(title), pointer}),
      opener_(announce_view(server_, opens)) {
  if (!pointer) wait_for_page(server_, "recording");
}

void RecordView::follow(LiveSand& sand) {
  sand_ = &sand;
  sand.show_to([this](const HeightField& bed) { bed_.publish(bed); });
}

void RecordView::show(const ServoProgress& progress) {
  ViewState state;
  state.time = progress.time;
  state.tip = sand_->tip(progress.position);
  state.force = sand_->force_on_bed(progress.held);
  state.orientation = sand_->orientation();
  state.depth = sand_->depth();
  state.rate = rate_.at(progress.time, static_cast<double>(progress.recorded));
  state.lateness = progress.lateness;
  state.max_lateness = progress.max_lateness;
  state.tip_known = progress.read;
  state.force_withheld = progress.awaited == Awaited::lift;
  state_.publish(state);
  state_.say(hint_of(progress));
}

}  // namespace sandstroke
