// The flow of RelaxationLaw::faces. Included once per instruction set, like lanes-inl.h.
#if defined(SANDSTROKE_SAND_FACE_FLOW_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SANDSTROKE_SAND_FACE_FLOW_INL_H_
#undef SANDSTROKE_SAND_FACE_FLOW_INL_H_
#else
#define SANDSTROKE_SAND_FACE_FLOW_INL_H_
#endif

#include "sand/flow_in_step-inl.h"
#include "sand/slopes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace sandstroke {
namespace HWY_NAMESPACE {

/// The drop through a face, or more of it where the giver falls by `behind` > 0 to its other side, too.
HWY_INLINE V with_crest(V fall, V behind) {
  const Mask crest = behind > hn::Zero(d);
  if (hn::AllFalse(d, crest)) return fall;
  const V low = Min(fall, behind), high = Max(fall, behind);
  return fall + where(crest, low * low / (all(3.0) * high));
}
/// dx times the slope at a cell: central, or towards the only neighbour that is no wall.
HWY_INLINE V central_difference(V m, V before, Mask has_before, V after, Mask has_after) {
  const V rise = hn::IfThenElse(has_after, after, m) - hn::IfThenElse(has_before, before, m);
  return rise * hn::IfThenElse(hn::And(has_before, has_after), all(0.5), all(1.0));
}

/// The slope at the face between a cell and its neighbour one step `along`: right of it, or below.
struct FaceSlope {
  V drop;    ///< to the neighbour; NaN at a wall
  V square;  ///< the square of dx |g|

  HWY_INLINE FaceSlope(const double* cell, std::ptrdiff_t along, std::ptrdiff_t across) {
    const V m = hn::LoadU(d, cell), next = hn::LoadU(d, cell + along), zero = hn::Zero(d);
    drop = m - next;
    const V fall = hn::Abs(drop);
    // The giver's drop to its other side; above 0 if the giver is a crest.
    const V behind = Max(zero, hn::IfThenElse(drop > zero, m - hn::LoadU(d, cell - along),
                                              next - hn::LoadU(d, cell + 2 * along)));
    const V slope = with_crest(fall, behind);
    const V sideways = all(0.5) * (slope_across(m, cell, across) + slope_across(next, cell + along, across));
    square = hn::IfThenElse(fall > zero, slope * slope + sideways * sideways, zero);
  }

 private:
  /// dx times the slope across the face: central, or towards the only neighbour that is no wall.
  static HWY_INLINE V slope_across(V m, const double* cell, std::ptrdiff_t across) {
    const V before = hn::LoadU(d, cell - across), after = hn::LoadU(d, cell + across);
    return central_difference(m, before, before == before, after, after == after);
  }
};

/// Flags of the faces to the right of a row's cells, and of the face at the row's western end.
struct RightFaces {
  std::uint64_t own;
  bool west;
};

/// The faces of a row through which sand flows, of those to the right of the flagged cells and at their row's
/// western end, or below them. faces.group_of_faces() gives the flags of eight. (By a lambda it would not be
/// inlined, which costs a seventh of the law's time.)
template <class Faces>
HWY_INLINE RightFaces flowing_to_the_right(Faces& faces, int row, std::uint64_t cells) {
  RightFaces flowing{0, false};
  if (cells & 1) flowing.west = faces.group_of_faces(row, -group, 0) >> (group - 1) & 1;
  for (unsigned wanted = groups_of(cells | cells >> 1); wanted; wanted &= wanted - 1) {
    const int begin = std::countr_zero(wanted) * group;
    flowing.own |= static_cast<std::uint64_t>(faces.group_of_faces(row, begin, 0)) << begin;
  }
  return flowing;
}
template <class Faces>
HWY_INLINE std::uint64_t flowing_downwards(Faces& faces, int row, std::uint64_t cells) {
  std::uint64_t flowing = 0;
  for (unsigned wanted = groups_of(cells); wanted; wanted &= wanted - 1) {
    const int begin = std::countr_zero(wanted) * group;
    flowing |= static_cast<std::uint64_t>(faces.group_of_faces(row, begin, 1)) << begin;
  }
  return flowing;
}

template <class Sand>
class FaceFluxes {
 public:
  FaceFluxes(const TalusLaw& law, const TilePatch& patch, Sand& sand, FlowScratch& scratch)
      : T_(all(law.axis_drop)),
        limit_(all(law.axis_limit)),
        surely_at_rest_(all(law.axis_limit * law.axis_limit * (1.0 - 1e-14))),
        share_(all(law.share)),
        patch_(patch),
        sand_(sand),
        scratch_(scratch) {}

  double* right(int row) const { return scratch_.factors.data() + TilePatch::start(row); }
  double* below(int row) const { return scratch_.below.data() + TilePatch::start(row); }

  /// Computes the flux [m per pass] through the faces below eight cells (down: 1), or to the right of them
  /// (0). Returns flags of those through which sand flows.
  HWY_INLINE unsigned group_of_faces(int row, int begin, int down) {
    double* out = (down ? below(row) : right(row)) + begin;
    const double* cells = patch_.heights(row) + begin;
    unsigned flags = 0;
    for (int c = 0; c < group; c += lanes) {
      const FaceSlope face(cells + c, down ? TilePatch::stride : 1, down ? 1 : TilePatch::stride);
      sand_.meet(face.square, hn::Zero(d));
      V flux = hn::Zero(d);
      if (!hn::AllFalse(d, face.square > surely_at_rest_)) {
        const V g = Sqrt(face.square);
        const Mask falls = face.drop > hn::Zero(d);
        const Mask gives = hn::Or(hn::And(falls, sand_.may_give(row, begin + c)),
                                  hn::AndNot(falls, sand_.may_give(row + down, begin + c + 1 - down)));
        const Mask moves = hn::And(gives, g > limit_);
        flux = where(moves, share_ * (all(1.0) - T_ / g) * face.drop);
        flags |= bits(moves) << c;
      }
      hn::Store(flux, d, out + c);
    }
    return flags;
  }

 private:
  V T_, limit_, surely_at_rest_, share_;
  const TilePatch& patch_;
  Sand& sand_;
  FlowScratch& scratch_;
};

/// Sweeps over the active rows with the fluxes that `faces` gives.
template <class Faces, class Sand, class Sink>
HWY_INLINE void sweep_faces(Faces& faces, const TalusLaw& law, const CellFlags& active, RowSpan rows,
                            Sand& sand, Sink& sink, TileFlow& flow) {
  const auto active_row = [&](int row) { return row < rows.begin || row >= rows.end ? 0 : active[row]; };
  std::uint64_t below = flowing_downwards(faces, rows.begin - 1, active_row(rows.begin));
  const auto cells_of = [&](int row) {
    const RightFaces beside = flowing_to_the_right(faces, row, active[row]);
    const std::uint64_t above = below;
    below = flowing_downwards(faces, row, active[row] | active_row(row + 1));
    return beside.own | beside.own << 1 | static_cast<std::uint64_t>(beside.west) | above | below;
  };
  sweep_rows(law, active, rows, sand, sink, flow, cells_of, [&](int row, int c, Mask cells, LaneSum& given) {
    const CellFaces around(faces.right(row) + c, faces.below(row) + c);
    given.add(c, where(cells, around.given()));
    return where(cells, around.gained());
  });
}

template <class Sand, class Sink>
HWY_INLINE void face_flow(const TalusLaw& law, const TilePatch& patch, const CellFlags& active, RowSpan rows,
                          Sand& sand, Sink& sink, FlowScratch& scratch, TileFlow& flow) {
  FaceFluxes<Sand> faces(law, patch, sand, scratch);
  sweep_faces(faces, law, active, rows, sand, sink, flow);
}

}  // namespace HWY_NAMESPACE
}  // namespace sandstroke
HWY_AFTER_NAMESPACE();

#endif
