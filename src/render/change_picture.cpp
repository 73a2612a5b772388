#include "render/change_picture.h"

#include <algorithm>
#include <cmath>

namespace sandstroke {

RenderSubject subject_of_change(const HeightField& initial, const HeightField& last, const CellRange& stroke,
                                const ViewSettings& view, double contour_interval) {
  RenderSubject subject;
  subject.view = view;
  subject.contour_interval = contour_interval;
  subject.focus = stroke;
  subject.start = start_heights(initial);
  if (view.style == RenderStyle::difference) {
    double most = 0.0;
    visit_cells_of_both(initial, last, [&](int, int, double before, double after) {
      most = std::max(most, std::abs(after - before));
    });
    subject.range = value_range(-most, most, ColourScale::diverging);
  } else {
    const StartHeights end = start_heights(last);
    subject.range = value_range(std::min(subject.start->lowest, end.lowest),
                                std::max(subject.start->highest, end.highest), ColourScale::sequential);
  }
  return subject;
}

Image ChangePainter::draw(const HeightField& initial, const HeightField& last, const CellRange& stroke,
                          const ViewSettings& view, double crumbs) {
  if (!renderer_ || !bed_->same_grid(last)) {
    renderer_.reset();  // before the next is made: two take twice the memory
    bed_ = last;
    renderer_ = std::make_unique<HeightFieldRenderer>(last.rows(), last.cols(), last.cell_size());
  }
  RenderSubject subject = subject_of_change(initial, last, stroke, view);
  subject.crumbs = crumbs;
  HeightGrid difference;
  if (view.style == RenderStyle::difference) difference = last.grid() - initial.grid();
  subject.difference = &difference;
  return renderer_->render(last, subject);
}

}  // namespace sandstroke
