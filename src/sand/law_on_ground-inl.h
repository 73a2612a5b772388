// The laws paper and isotropic on a ground (rules/talus.h). Included once per instruction set, like
// lanes-inl.h.
#if defined(SANDSTROKE_SAND_LAW_ON_GROUND_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SANDSTROKE_SAND_LAW_ON_GROUND_INL_H_
#undef SANDSTROKE_SAND_LAW_ON_GROUND_INL_H_
#else
#define SANDSTROKE_SAND_LAW_ON_GROUND_INL_H_
#endif

#include <numbers>

#include "sand/flow_in_step-inl.h"
#include "sand/ground_patch.h"
#include "sand/slopes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace sandstroke {
namespace HWY_NAMESPACE {

/// Each lower neighbour's drop, or 0.
HWY_INLINE V falling(V drop) { return where(drop > hn::Zero(d), drop); }

/// T and the sand of the cells in a vector. even: T is known to be the law's in all cells, with the same bits
/// as if each had its own.
template <bool even>
class LawOnGround {
 public:
  LawOnGround(const TalusLaw& law, const GroundPatch& ground)
      : law_drop(all(law.axis_drop)),
        thinnest_(all(law.thinnest)),
        most_given_(all(law.most_given)),
        half_(all(0.5)),
        one_(all(1.0)),
        is_even_(ground.has_only(law.axis_drop)),
        ground_(ground) {}

  HWY_INLINE const double* axis_drops(int row) const { return ground_.axis_drops.row(row); }
  /// T towards a neighbour, from both cells' T.
  HWY_INLINE V between(V here, V there) const { return half_ * (here + there); }
  /// By what a drop to a neighbour is multiplied, so that it may be as large as the law's T.
  HWY_INLINE V weight(V here, V there) const {
    return even || is_even_ ? one_ : law_drop / between(here, there);
  }
  /// z [m].
  HWY_INLINE V sand(int row, int c, V height) const {
    return height - hn::LoadU(d, ground_.floor.row(row) + c);
  }
  HWY_INLINE Mask has_sand(V z) const { return z > thinnest_; }  // false in walls
  HWY_INLINE V most_given(V z) const { return most_given_ * z; }

  V law_drop;

 private:
  V thinnest_, most_given_, half_, one_;
  bool is_even_;
  const GroundPatch& ground_;
};

/// The square of dx |g| by `isotropic`, as if T were the law's.
template <bool even>
HWY_INLINE V squared_slope_on(const LawOnGround<even>& ground, const Around& a, int row, int c) {
  const Around T(ground.axis_drops(row), c);
  const V zero = hn::Zero(d);
  const auto slope = [&](V neighbour, V its_T) { return (a.m - neighbour) * ground.weight(T.m, its_T); };
  const V gx = higher(slope(a.w, T.w), higher(slope(a.e, T.e), zero)),
          gy = higher(slope(a.n, T.n), higher(slope(a.s, T.s), zero));
  return gx * gx + gy * gy;
}

HWY_INLINE void flag_films(int row, int c, Mask emptied, FlowScratch& scratch) {
  const std::uint64_t flags = bits(emptied);
  if (!flags) return;
  WideRow& films = scratch.films[row + 1];
  if (c < 0)
    films.west |= c + lanes == 0 && (flags >> (lanes - 1) & 1) != 0;
  else if (c >= side)
    films.east |= c == side && (flags & 1) != 0;
  else
    films.own |= flags << c;
}

struct IsotropicOnGround {
  LawOnGround<false> ground;
  V limit, surely_at_rest, share, one;
  FlowScratch* scratch;  ///< for the films
  IsotropicOnGround(const TalusLaw& law, const GroundPatch& patch, FlowScratch& of_pass)
      : ground(law, patch),
        limit(all(law.axis_limit)),
        surely_at_rest(all(law.axis_limit * law.axis_limit * (1.0 - 1e-14))),
        share(all(law.share)),
        one(all(1.0)),
        scratch(&of_pass) {}

  template <class Sand>
  HWY_INLINE unsigned operator()(const double* heights, int row, int c, double* factors, Mask may_give,
                                 Sand& sand) const {
    const Around a(heights, c);
    const V z = ground.sand(row, c, a.m);
    const Mask has_sand = ground.has_sand(z);
    if (hn::AllFalse(d, has_sand)) {
      hn::Store(hn::Zero(d), d, factors + c);
      return 0;
    }
    const V square = where(has_sand, squared_slope_on(ground, a, row, c));
    sand.meet(square, hn::Zero(d));
    if (hn::AllFalse(d, square > surely_at_rest)) {
      hn::Store(hn::Zero(d), d, factors + c);
      return 0;
    }
    const V g = Sqrt(square);
    const Mask moves = hn::And(may_give, g > limit);
    const V given = (falling(a.m - a.w) + falling(a.m - a.e)) + (falling(a.m - a.n) + falling(a.m - a.s));
    const V by_slope = share * (one - ground.law_drop / g), all_it_may = ground.most_given(z) / given;
    flag_films(row, c, hn::And(moves, all_it_may < by_slope), *scratch);
    hn::Store(where(moves, Min(by_slope, all_it_may)), d, factors + c);
    return bits(moves);
  }
};

struct PaperOnGround {
  LawOnGround<false> ground;
  V tolerated, share, diagonal;
  PaperOnGround(const TalusLaw& law, const GroundPatch& patch)
      : ground(law, patch),
        tolerated(all(law.tolerated)),
        share(all(law.share)),
        diagonal(all(std::numbers::sqrt2)) {}

  /// The largest drop of a cell as a part of what it may be.
  HWY_INLINE V steepest(const double* row_heights, int row, int c) const {
    const Around a(row_heights, c), T(ground.axis_drops(row), c);
    const Corners k(row_heights, c), D(ground.axis_drops(row), c);
    const auto axis = [&](V there, V its_T) { return (a.m - there) / ground.between(T.m, its_T); };
    const auto corner = [&](V there, V its_T) {
      return (a.m - there) / (ground.between(T.m, its_T) * diagonal);
    };
    V most = hn::Zero(d);
    for (const V part : {axis(a.w, T.w), axis(a.e, T.e), axis(a.n, T.n), axis(a.s, T.s), corner(k.nw, D.nw),
                         corner(k.ne, D.ne), corner(k.sw, D.sw), corner(k.se, D.se)})
      most = higher(part, most);
    return most;
  }

  template <class Sand>
  HWY_INLINE unsigned operator()(const double* row_heights, int row, int c, double* factors, Mask may_give,
                                 Sand& sand) const {
    const Around a(row_heights, c), T(ground.axis_drops(row), c);
    const Corners k(row_heights, c), D(ground.axis_drops(row), c);
    const V z = ground.sand(row, c, a.m), zero = hn::Zero(d);
    Mask too_steep = zero > zero;
    V excess = zero;
    const auto part = [&](V neighbour, V limit) {
      const V drop = a.m - neighbour;
      too_steep = hn::Or(too_steep, drop > limit * tolerated);
      excess = higher(drop - limit, excess);
      return where(drop > limit, drop);
    };
    const auto axis = [&](V neighbour, V its_T) { return part(neighbour, ground.between(T.m, its_T)); };
    const auto corner = [&](V neighbour, V its_T) {
      return part(neighbour, ground.between(T.m, its_T) * diagonal);
    };
    const V axis_sum = (axis(a.w, T.w) + axis(a.e, T.e)) + (axis(a.n, T.n) + axis(a.s, T.s));
    const V corner_sum =
        (corner(k.nw, D.nw) + corner(k.se, D.se)) + (corner(k.ne, D.ne) + corner(k.sw, D.sw));
    const Mask has_sand = ground.has_sand(z);
    sand.meet(where(has_sand, steepest(row_heights, row, c) * ground.law_drop), zero);
    const Mask moves = hn::And(hn::And(may_give, has_sand), too_steep);
    const V dm = Min(share * excess, ground.most_given(z));
    hn::Store(where(moves, dm / (axis_sum + corner_sum)), d, factors + c);
    return bits(moves);
  }
};

/// Inflow less outflow by `paper`, with the factors of PaperOnGround.
struct PaperGainOnGround {
  LawOnGround<false> ground;
  V diagonal;
  PaperGainOnGround(const TalusLaw& law, const GroundPatch& patch)
      : ground(law, patch), diagonal(all(std::numbers::sqrt2)) {}

  HWY_INLINE V operator()(const double* row_heights, const double* factors, int row, int c, Mask cells,
                          LaneSum& given) const {
    const Around m(row_heights, c), f(factors, c), T(ground.axis_drops(row), c);
    const Corners k(row_heights, c), fk(factors, c), D(ground.axis_drops(row), c);
    const auto axis = [&](V m_i, V f_i, V T_i) {
      const V limit = ground.between(T.m, T_i);
      return exchange(m.m, f.m, m_i, f_i, limit, hn::Neg(limit));
    };
    const auto corner = [&](V m_i, V f_i, V T_i) {
      const V limit = ground.between(T.m, T_i) * diagonal;
      return exchange(m.m, f.m, m_i, f_i, limit, hn::Neg(limit));
    };
    Exchange flow = (axis(m.w, f.w, T.w) + axis(m.e, f.e, T.e)) + (axis(m.n, f.n, T.n) + axis(m.s, f.s, T.s));
    flow = flow + ((corner(k.nw, fk.nw, D.nw) + corner(k.se, fk.se, D.se)) +
                   (corner(k.ne, fk.ne, D.ne) + corner(k.sw, fk.sw, D.sw)));
    given.add(c, where(cells, flow.out));
    return where(cells, hn::Neg(flow.in + flow.out));
  }
};

}  // namespace HWY_NAMESPACE
}  // namespace sandstroke
HWY_AFTER_NAMESPACE();

#endif
