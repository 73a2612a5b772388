#include "sand/resistive_kernels.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "sand/resistive_kernels.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "rules/force.h"
#include "sand/lanes-inl.h"
#include "sand/sand_pressure-inl.h"

HWY_BEFORE_NAMESPACE();
namespace sandstroke {
namespace HWY_NAMESPACE {

struct Vector {
  V x, y, z;
  HWY_INLINE V dot(const Vector& o) const { return x * o.x + y * o.y + z * o.z; }
  HWY_INLINE Vector times(V s) const { return {s * x, s * y, s * z}; }
  HWY_INLINE Vector plus(const Vector& o) const { return {x + o.x, y + o.y, z + o.z}; }
};

HWY_INLINE V between_0_and_1(V x) { return Min(Max(x, hn::Zero(d)), all(1.0)); }

/// Coefficients of 1, x1, x2, x3, x1^2, x2^2, x3^2, x1 x2, x2 x3, x3 x1, x1^3, x2^3, x3^3, x1 x2^2, x2 x1^2,
/// x2 x3^2, x3 x2^2, x3 x1^2, x1 x3^2, x1 x2 x3 (Agarwal, Goldman, Kamrin 2023, table 1).
constexpr double table[3][20] = {
    {0.00212, -0.02320, -0.20890, -0.43083, -0.00259, 0.48872, -0.00415, 0.07204, -0.02750, -0.08772,
     0.01992, -0.45961, 0.40799,  -0.10107, -0.06576, 0.05664, -0.09269, 0.01892, 0.01033,  0.15120},
    {-0.06796, -0.10941, 0.04725, -0.06914, -0.05835, -0.65880, -0.11985, -0.25739, -0.26834, 0.02692,
     -0.00736, 0.63758,  0.08997, 0.21069,  0.04748,  0.20406,  0.18519,  0.04934,  0.13527,  -0.33207},
    {-0.02634, -0.03436, 0.45256,  0.00835,  0.02553, -1.31290, -0.05532, 0.06790,  -0.16404, 0.02287,
     0.02927,  0.95406,  -0.00131, -0.11028, 0.01487, -0.02730, 0.10911,  -0.04097, 0.07881,  -0.27519}};

HWY_INLINE V polynomial(const double* c, V x1, V x2, V x3) {
  const V in_x3 = all(c[3]) + x3 * (all(c[6]) + x3 * all(c[12]) + x1 * all(c[18]) + x2 * all(c[15])) +
                  x1 * (all(c[9]) + x1 * all(c[17]) + x2 * all(c[19])) + x2 * (all(c[8]) + x2 * all(c[16]));
  const V in_x2 =
      all(c[2]) + x2 * (all(c[5]) + x2 * all(c[11]) + x1 * all(c[13])) + x1 * (all(c[7]) + x1 * all(c[14]));
  const V in_x1 = all(c[1]) + x1 * (all(c[4]) + x1 * all(c[10]));
  return all(c[0]) + x1 * in_x1 + x2 * in_x2 + x3 * in_x3;
}

/// The theory's stress on a plate whose normal n points down: a tilt of -90 to 90 degrees, which is all that
/// its polynomials were fitted to. In vectors, with gravity along -z: x1, x2 and x3 are the cosines between
/// motion and gravity, normal and gravity, and normal and motion; alpha = f1 n + f2 u - f3 z.
HWY_INLINE Vector plate_stress(const Vector& n, const Vector& u) {
  const V x1 = Neg(u.z), x2 = Neg(n.z), x3 = u.dot(n);
  const V f1 = polynomial(table[0], x1, x2, x3), f2 = polynomial(table[1], x1, x2, x3),
          f3 = polynomial(table[2], x1, x2, x3);
  Vector alpha = n.times(f1).plus(u.times(f2));
  alpha.z -= f3;
  return alpha;
}

/// resistive_stress() of a vector of elements. If an element faces up, the plate's normal is that of its
/// other side. An upright plate has both normals, and the polynomials give 0.192 and 0.229 when it is dragged
/// face on. So the first value blends into the second from an upright element to one that faces up by 1
/// degree.
HWY_INLINE Vector stress(const Vector& n, const Vector& u, V tool_friction) {
  constexpr double goes_over = 0.02;
  const V zero = hn::Zero(d), one = all(1.0);
  const V up = between_0_and_1(n.z * all(1.0 / goes_over));
  const Mask between = hn::And(up > zero, up < one);
  Vector alpha = plate_stress(n.times(hn::IfThenElse(up < one, one, all(-1.0))), u);
  if (!hn::AllFalse(d, between)) {
    const Vector other = plate_stress(n.times(all(-1.0)), u);
    const V part = where(between, up);
    alpha = alpha.times(one - part).plus(other.times(part));
  }
  const V across = alpha.dot(n);
  const Vector along = alpha.plus(n.times(Neg(across)));
  const V along2 = along.dot(along), most = tool_friction * hn::Abs(across);
  const Mask slides = along2 > most * most;
  const V fraction = hn::IfThenElse(slides, most / Sqrt(Max(along2, all(1e-300))), all(1.0));
  return n.times(across).plus(along.times(fraction));
}

/// The cosine between motion and normal below 0 over which trailing elements fade out. Otherwise the drag on
/// an upright side that moves along itself would switch on and off as its motion trembles.
constexpr double fade = 0.02;

/// The sums over all elements that make up the wrench.
class WrenchSum {
 public:
  HWY_INLINE WrenchSum() {}  // an implicit one would not have the instruction set's attributes
  /// whole: an element's force once it has fully yielded, `size` [N/m] per depth in the scene's own sand.
  HWY_INLINE void add(int index, const Vector& r, const Vector& force, const Vector& whole, V size,
                      const PressureLanes& pressure) {
    force_x_.add(index, force.x);
    force_y_.add(index, force.y);
    force_z_.add(index, force.z);
    torque_x_.add(index, r.y * force.z - r.z * force.y);
    torque_y_.add(index, r.z * force.x - r.x * force.z);
    torque_z_.add(index, r.x * force.y - r.y * force.x);
    whole_x_.add(index, whole.x);
    whole_y_.add(index, whole.y);
    whole_z_.add(index, whole.z);
    growth_.add(index, size * (pressure.growth + hn::Abs(pressure.change)));
    strength_.add(index, size * Max(pressure.depth, hn::Zero(d)));
  }
  Wrench total(double yield_way) const {
    Wrench wrench;
    wrench.force << force_x_.total(), force_y_.total(), force_z_.total();
    wrench.torque << torque_x_.total(), torque_y_.total(), torque_z_.total();
    wrench.strength = strength_.total();
    wrench.stiffness = growth_.total() + wrench.strength / yield_way;
    wrench.whole = length_of({whole_x_.total(), whole_y_.total(), whole_z_.total()});
    return wrench;
  }

 private:
  LaneSum force_x_, force_y_, force_z_, torque_x_, torque_y_, torque_z_, whole_x_, whole_y_, whole_z_,
      growth_, strength_;
};

Wrench ResistiveWrench(const ResistiveTick& tick) {
  const ToolElements& e = tick.elements;
  const SandBefore& before = tick.before;
  const V zero = hn::Zero(d), one = all(1.0);
  const SandBefore::Mean& mean = before.mean();
  const V slope_x = all(before.slope().x()), slope_y = all(before.slope().y());
  const V tip_z = all(tick.tip_height), highest = all(before.highest() - tick.tip_height);
  const Vector motion = {all(tick.motion.tip.x()), all(tick.motion.tip.y()), all(tick.motion.tip.z())};
  const Eigen::Matrix3d& spin = tick.motion.spin;
  const auto spin_of = [&](int axis) {
    return Vector{all(spin(axis, 0)), all(spin(axis, 1)), all(spin(axis, 2))};
  };
  const Vector spin_x = spin_of(0), spin_y = spin_of(1), spin_z = spin_of(2);
  const bool spins = !spin.isZero(0.0);
  double *ways_x = tick.ways, *ways_y = tick.ways + e.size(), *ways_z = tick.ways + 2 * e.size();
  const hn::RebindToSigned<decltype(d)> di;
  WrenchSum sum;
  for (std::size_t i = 0; i < e.size(); i += lanes) {
    const int index = static_cast<int>(i);
    const Vector r = {hn::Load(d, e.x() + i), hn::Load(d, e.y() + i), hn::Load(d, e.z() + i)};
    const V rise = slope_x * r.x + slope_y * r.y;
    if (hn::AllFalse(d, highest + Max(rise, zero) > r.z)) {
      for (double* ways : {ways_x, ways_y, ways_z}) hn::Store(zero, d, ways + i);
      continue;
    }
    const Vector n = {hn::Load(d, e.normal_x() + i), hn::Load(d, e.normal_y() + i),
                      hn::Load(d, e.normal_z() + i)};
    Vector way =
        Vector{hn::Load(d, ways_x + i), hn::Load(d, ways_y + i), hn::Load(d, ways_z + i)}.plus(motion);
    if (spins) way = way.plus({spin_x.dot(r), spin_y.dot(r), spin_z.dot(r)});
    const V length = Sqrt(way.dot(way)), per_length = one / Max(length, all(1e-300));
    const Vector u = way.times(where(length > zero, per_length));  // a tiny way's square may underflow
    // The more level an element looks and moves, the more it feels the sand before its side. Here in cosines
    // squared, of the direction halfway between both.
    const V facing = u.dot(n);
    const V sideways_x = n.x + u.x, sideways_y = n.y + u.y,
            sideways = (sideways_x * sideways_x + sideways_y * sideways_y) /
                       Max(all(2.0) * (one + facing), all(1.0));
    const V far = (all(mean.height) + all(mean.height_ahead.x()) * u.x + all(mean.height_ahead.y()) * u.y) /
                  Max(all(mean.weight) + all(mean.weight_ahead.x()) * u.x + all(mean.weight_ahead.y()) * u.y,
                      all(1e-9 * mean.weight)),
            near = hn::GatherIndex(d, before.heights(), hn::Load(di, before.side_of() + i));
    const V below = far + rise + Min(sideways, one) * (near - far - rise) - (tip_z + r.z);
    const Mask in_sand = hn::And(below > zero, near > all(-1e300));
    const PressureLanes pressure = pressure_at(tick.places, i, tip_z + r.z, where(in_sand, below));
    way = way.times(where(in_sand, Min(per_length, one)));
    hn::Store(way.x, d, ways_x + i);
    hn::Store(way.y, d, ways_y + i);
    hn::Store(way.z, d, ways_z + i);
    const V mobilised = Min(length, one);
    const V leads = between_0_and_1(facing * all(1.0 / fade) + one);
    const V area = where(in_sand, hn::Load(d, e.area() + i) * leads) * all(tick.resistance);
    if (hn::AllFalse(d, area > zero)) continue;
    const Vector alpha = stress(n, u, all(tick.tool_friction));
    const V size = Sqrt(alpha.dot(alpha)) * area;
    const V pushes = area * pressure.depth;
    sum.add(index, r, alpha.times(pushes * mobilised), alpha.times(pushes), size, pressure);
  }
  return sum.total(tick.motion.yield_way);
}

VolumeBelow VolumeBelowPlane(const ToolElements& e, double height, const Eigen::Vector2d& slope,
                             const StrengthByPlace* places, double tip_height) {
  const V slope_x = all(slope.x()), slope_y = all(slope.y()), height0 = all(height), zero = hn::Zero(d),
          tip_z = all(tip_height);
  LaneSum volume, moment_x, moment_y, area;
  for (std::size_t i = 0; i < e.size(); i += lanes) {
    const int index = static_cast<int>(i);
    const V x = hn::Load(d, e.x() + i), y = hn::Load(d, e.y() + i);
    const V z = hn::Load(d, e.z() + i), depth = height0 + slope_x * x + slope_y * y - z;
    const PressureLanes pressure = pressure_at(places, i, tip_z + z, Max(depth, zero));
    // The column from each element up to the plane.
    const V level = where(depth > zero, Neg(hn::Load(d, e.normal_z() + i)) * hn::Load(d, e.area() + i));
    const V above = level * pressure.depth;
    area.add(index, level * (pressure.growth + pressure.change));
    volume.add(index, above);
    moment_x.add(index, x * above);
    moment_y.add(index, y * above);
  }
  return {volume.total(), {moment_x.total(), moment_y.total()}, area.total()};
}

Eigen::Vector3d StressOf(const Eigen::Vector3d& normal, const Eigen::Vector3d& motion, double tool_friction) {
  const auto as_vector = [](const Eigen::Vector3d& v) { return Vector{all(v.x()), all(v.y()), all(v.z())}; };
  const Vector alpha = stress(as_vector(normal), as_vector(motion), all(tool_friction));
  return {hn::GetLane(alpha.x), hn::GetLane(alpha.y), hn::GetLane(alpha.z)};
}

}  // namespace HWY_NAMESPACE
}  // namespace sandstroke
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace sandstroke {

HWY_EXPORT(ResistiveWrench);
HWY_EXPORT(StressOf);
HWY_EXPORT(VolumeBelowPlane);

Wrench resistive_wrench(const ResistiveTick& tick) { return HWY_DYNAMIC_DISPATCH(ResistiveWrench)(tick); }
VolumeBelow volume_below(const ToolElements& elements, double height, const Eigen::Vector2d& slope,
                         const StrengthByPlace* places, double tip_height) {
  return HWY_DYNAMIC_DISPATCH(VolumeBelowPlane)(elements, height, slope, places, tip_height);
}
Eigen::Vector3d resistive_stress(const Eigen::Vector3d& normal, const Eigen::Vector3d& motion,
                                 double tool_friction) {
  return HWY_DYNAMIC_DISPATCH(StressOf)(normal, motion, tool_friction);
}

}  // namespace sandstroke
#endif
