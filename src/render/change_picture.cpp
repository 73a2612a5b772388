#include "render/change_picture.h"

#include <algorithm>

#include "render/changed_cells.h"

namespace sandstroke {

RenderSubject subject_of_change(const HeightGrid& initial, const HeightGrid& last, const ViewSettings& view,
                                double contour_interval) {
  RenderSubject subject;
  subject.view = view;
  subject.contour_interval = contour_interval;
  // The stroke is where sand was moved by more than what settles around it.
  const double most = (last - initial).abs().maxCoeff();
  subject.focus = changed_cells(initial, last, settled_share * most);
  // Box, camera and colours stay the same from frame to frame.
  subject.extent = {std::min(initial.minCoeff(), last.minCoeff()),
                    std::max(initial.maxCoeff(), last.maxCoeff())};
  subject.range = view.style == RenderStyle::difference
                      ? value_range(-most, most, true)
                      : value_range(subject.extent->low, subject.extent->high, false);
  return subject;
}

Image ChangePainter::draw(const HeightField& initial, const HeightField& last, const ViewSettings& view) {
  if (!renderer_ || !bed_->same_grid(last)) {
    renderer_.reset();  // before the next: two take twice the memory
    bed_ = last;
    renderer_ = std::make_unique<HeightFieldRenderer>(last.rows(), last.cols(), last.cell_size());
  }
  const HeightGrid before = initial.grid(), after = last.grid();
  RenderSubject subject = subject_of_change(before, after, view);
  const HeightGrid difference = after - before;
  subject.difference = &difference;
  return renderer_->render(last, subject);
}

}  // namespace sandstroke
