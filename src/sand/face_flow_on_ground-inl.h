// The flow of RelaxationLaw::faces on a ground (rules/talus.h). Included once per instruction set, like
// lanes-inl.h.
#if defined(SANDSTROKE_SAND_FACE_FLOW_ON_GROUND_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SANDSTROKE_SAND_FACE_FLOW_ON_GROUND_INL_H_
#undef SANDSTROKE_SAND_FACE_FLOW_ON_GROUND_INL_H_
#else
#define SANDSTROKE_SAND_FACE_FLOW_ON_GROUND_INL_H_
#endif

#include "sand/face_flow-inl.h"
#include "sand/law_on_ground-inl.h"

HWY_BEFORE_NAMESPACE();
namespace sandstroke {
namespace HWY_NAMESPACE {

/// The slope at the face to the right of a cell, or below it, on a ground.
template <bool even>
struct FaceOnGround {
  V drop;      ///< to the neighbour; NaN at a wall
  V square;    ///< the square of dx |g|, as if T were the law's; 0 where the giver has no sand
  Mask falls;  ///< the cell gives, not its neighbour

  /// row: of the cell, within the rim. down: 1 for the face below it.
  HWY_INLINE FaceOnGround(const LawOnGround<even>& ground, const TilePatch& patch, int row, int c, int down) {
    constexpr int stride = TilePatch::stride;
    const double* cell = patch.heights(row) + c;
    const int along = down ? stride : 1;
    const int next_row = row + down, next_col = c + 1 - down;
    const V m = hn::LoadU(d, cell), next = hn::LoadU(d, cell + along), zero = hn::Zero(d);
    drop = m - next;
    falls = drop > zero;
    const V z = ground.sand(row, c, m), next_z = ground.sand(next_row, next_col, next);
    const Mask has_sand = hn::And(ground.has_sand(hn::IfThenElse(falls, z, next_z)), hn::Abs(drop) > zero);
    square = zero;
    if (hn::AllFalse(d, has_sand)) return;
    // A giver at the rim's outer edge gives to no cell that counts; what lies behind it is not loaded.
    const int back = down && row == -TilePatch::rim ? 0 : along;
    const int ahead = down && row == TilePatch::side ? along : 2 * along;
    const V behind =
        Max(zero, hn::IfThenElse(falls, m - hn::LoadU(d, cell - back), next - hn::LoadU(d, cell + ahead)));
    V slope = with_crest(hn::Abs(drop), behind);
    if constexpr (!even)
      slope *= ground.weight(hn::LoadU(d, ground.axis_drops(row) + c),
                             hn::LoadU(d, ground.axis_drops(next_row) + next_col));
    const V sideways = all(0.5) * (slope_across(ground, patch, m, z, row, c, down) +
                                   slope_across(ground, patch, next, next_z, next_row, next_col, down));
    square = where(has_sand, slope * slope + sideways * sideways);
  }

 private:
  /// dx times the slope across the face at one of its cells.
  static HWY_INLINE V slope_across(const LawOnGround<even>& ground, const TilePatch& patch, V here, V z,
                                   int row, int col, int down) {
    const int row_step = 1 - down, col_step = down;
    const V before = hn::LoadU(d, patch.heights(row - row_step) + col - col_step),
            after = hn::LoadU(d, patch.heights(row + row_step) + col + col_step);
    return central_difference(
        here, counted(ground, here, z, row, col, before, row - row_step, col - col_step), before == before,
        counted(ground, here, z, row, col, after, row + row_step, col + col_step), after == after);
  }
  /// The height there, but no further from the one here than the sand at the higher of them twice.
  static HWY_INLINE V counted(const LawOnGround<even>& ground, V here, V z, int row, int col, V there,
                              int there_row, int there_col) {
    const V two = all(2.0), z_there = ground.sand(there_row, there_col, there);
    const V height =
        hn::IfThenElse(there > here, Min(there, here + two * z_there), Max(there, here - two * z));
    if constexpr (even) {
      return height;
    } else {
      const V weight = ground.weight(hn::LoadU(d, ground.axis_drops(row) + col),
                                     hn::LoadU(d, ground.axis_drops(there_row) + there_col));
      return hn::IfThenElse(weight == all(1.0), height, here + (height - here) * weight);
    }
  }
};

/// The fluxes around the active cells, limited to what each giver has.
template <bool even, class Sand>
class FacesOnGround {
 public:
  FacesOnGround(const TalusLaw& law, const GroundPatch& ground, const TilePatch& patch,
                const CellFlags& active, RowSpan rows, Sand& sand, FlowScratch& scratch)
      : ground_(law, ground),
        limit_(all(law.axis_limit)),
        surely_at_rest_(all(law.axis_limit * law.axis_limit * (1.0 - 1e-14))),
        share_(all(law.share)),
        patch_(patch),
        active_(active),
        rows_(rows),
        sand_(sand),
        scratch_(scratch) {
    for (int row = rows.begin - 2; row <= rows.end; ++row) {
      const WideRow cells = counting(row), next = counting(row + 1);
      for_groups_of({cells.own | cells.own >> 1 | static_cast<std::uint64_t>(cells.east) << (side - 1),
                     cells.west || (cells.own & 1) != 0, cells.east},
                    [&](int begin) { compute(row, begin, 0); });
      for_groups_of({cells.own | next.own, cells.west || next.west, cells.east || next.east},
                    [&](int begin) { compute(row, begin, 1); });
    }
    for (int row = rows.begin - 1; row <= rows.end; ++row)
      for_groups_of(counting(row), [&](int begin) { find_scales(row, begin); });
  }

  double* right(int row) const { return scratch_.factors.data() + TilePatch::start(row); }
  double* below(int row) const { return scratch_.below.data() + TilePatch::start(row); }

  /// Limits the fluxes [m per pass] through the faces below eight cells (down: 1), or to the right of them
  /// (0). Returns flags of those through which sand flows.
  HWY_INLINE unsigned group_of_faces(int row, int begin, int down) const {
    double* out = (down ? below(row) : right(row)) + begin;
    const double* own = scales(row) + begin;
    const double* next = down ? own + TilePatch::stride : own + 1;
    unsigned flags = 0;
    for (int c = 0; c < group; c += lanes) {
      const V flux = hn::Load(d, out + c);
      const Mask flows = flux != hn::Zero(d);
      const V scale = hn::IfThenElse(flux > hn::Zero(d), hn::Load(d, own + c), hn::LoadU(d, next + c));
      hn::Store(where(flows, flux * scale), d, out + c);
      flags |= bits(flows) << c;
    }
    return flags;
  }

 private:
  HWY_INLINE std::uint64_t active_row(int row) const {
    return row < rows_.begin || row >= rows_.end ? 0 : active_[row];
  }
  /// The active cells, and those around them that may give: what they give depends on all of their faces.
  HWY_INLINE WideRow counting(int row) const {
    if (row < rows_.begin - 1 || row > rows_.end) return {};
    const WideRow near = widened(active_row(row - 1) | active_row(row) | active_row(row + 1)),
                  giving = sand_.givers(row);
    return {active_row(row) | (near.own & giving.own), near.west && giving.west, near.east && giving.east};
  }
  template <class Body>
  static HWY_INLINE void for_groups_of(const WideRow& cells, const Body& body) {
    if (cells.west) body(-group);
    for (unsigned wanted = groups_of(cells.own); wanted; wanted &= wanted - 1)
      body(std::countr_zero(wanted) * group);
    if (cells.east) body(side);
  }
  /// Whether faces of a group are beside active cells. Of others the rim does not tell all.
  HWY_INLINE bool is_seen(int row, int begin, int down) const {
    const std::uint64_t cells =
        down ? active_row(row) | active_row(row + 1) : active_row(row) | active_row(row) >> 1;
    if (begin < 0) return !down && (active_row(row) & 1) != 0;
    return begin < side && (groups_of(cells) >> (begin / group) & 1) != 0;
  }
  HWY_INLINE Mask may_give(int row, int c) const {
    return row < -1 || row > side ? hn::FirstN(d, 0) : sand_.may_give(row, c);
  }

  /// Fluxes through the faces below eight cells (down: 1), or to the right of them (0), before the limit.
  HWY_INLINE void compute(int row, int begin, int down) {
    if (!down && row < rows_.begin - 1) return;
    double* out = (down ? below(row) : right(row)) + begin;
    const bool seen = is_seen(row, begin, down);
    for (int c = 0; c < group; c += lanes) {
      const FaceOnGround<even> face(ground_, patch_, row, begin + c, down);
      if (seen) sand_.meet(face.square, hn::Zero(d));
      V flux = hn::Zero(d);
      if (!hn::AllFalse(d, face.square > surely_at_rest_)) {
        const V g = Sqrt(face.square);
        const Mask gives = hn::Or(hn::And(face.falls, may_give(row, begin + c)),
                                  hn::AndNot(face.falls, may_give(row + down, begin + c + 1 - down)));
        flux = where(hn::And(gives, g > limit_), share_ * (all(1.0) - ground_.law_drop / g) * face.drop);
      }
      hn::Store(flux, d, out + c);
    }
  }
  double* scales(int row) const { return scratch_.scales.data() + TilePatch::start(row); }
  /// By what the fluxes out of eight cells are multiplied.
  HWY_INLINE void find_scales(int row, int begin) {
    for (int c = begin; c < begin + group; c += lanes) {
      const V out = CellFaces(right(row) + c, below(row) + c).given();
      const V most = ground_.most_given(ground_.sand(row, c, hn::Load(d, patch_.heights(row) + c)));
      const Mask emptied = out > most;
      hn::Store(hn::IfThenElse(emptied, most / out, all(1.0)), d, scales(row) + c);
      flag_films(row, c, emptied, scratch_);
    }
  }

  LawOnGround<even> ground_;
  V limit_, surely_at_rest_, share_;
  const TilePatch& patch_;
  const CellFlags& active_;
  RowSpan rows_;
  Sand& sand_;
  FlowScratch& scratch_;
};

template <bool even, class Sand, class Sink>
HWY_INLINE void face_flow_on_ground(const TalusLaw& law, const TilePatch& patch, const CellFlags& active,
                                    RowSpan rows, const GroundPatch& ground, Sand& sand, Sink& sink,
                                    FlowScratch& scratch, TileFlow& flow) {
  const FacesOnGround<even, Sand> faces(law, ground, patch, active, rows, sand, scratch);
  sweep_faces(faces, law, active, rows, sand, sink, flow);
}

}  // namespace HWY_NAMESPACE
}  // namespace sandstroke
HWY_AFTER_NAMESPACE();

#endif
