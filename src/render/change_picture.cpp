#include "render/change_picture.h"

#include <algorithm>

namespace sandstroke {

RenderSubject subject_of_change(const HeightGrid& initial, const HeightGrid& last, const CellRange& stroke,
                                const ViewSettings& view, double contour_interval) {
  RenderSubject subject;
  subject.view = view;
  subject.contour_interval = contour_interval;
  subject.focus = stroke;
  subject.start = start_heights(initial);
  if (view.style == RenderStyle::difference) {
    const double most = (last - initial).abs().maxCoeff();
    subject.range = value_range(-most, most, ColourScale::diverging);
  } else {
    subject.range = value_range(std::min(subject.start->lowest, last.minCoeff()),
                                std::max(subject.start->highest, last.maxCoeff()), ColourScale::sequential);
  }
  return subject;
}

Image ChangePainter::draw(const HeightField& initial, const HeightField& last, const CellRange& stroke,
                          const ViewSettings& view) {
  if (!renderer_ || !bed_->same_grid(last)) {
    renderer_.reset();  // before the next is made: two take twice the memory
    bed_ = last;
    renderer_ = std::make_unique<HeightFieldRenderer>(last.rows(), last.cols(), last.cell_size());
  }
  const HeightGrid before = initial.grid(), after = last.grid();
  RenderSubject subject = subject_of_change(before, after, stroke, view);
  HeightGrid difference;
  if (view.style == RenderStyle::difference) difference = after - before;
  subject.difference = &difference;
  return renderer_->render(last, subject);
}

}  // namespace sandstroke
