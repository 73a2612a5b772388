#include "sand/sand_plane_kernels.h"

#include <Eigen/LU>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "sand/sand_plane_kernels.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "sand/lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace sandstroke {
namespace HWY_NAMESPACE {

Eigen::Vector3d LeastDeviations(const SeenSand& sand, double reach) {
  constexpr int turns = 4;
  const V one = all(1.0), least = all(1e-4 * reach);
  Eigen::Vector3d plane = Eigen::Vector3d::Zero();
  for (int turn = 0; turn < turns; ++turn) {
    const V a = all(plane[0]), b = all(plane[1]), c = all(plane[2]);
    LaneSum w, wx, wy, wxx, wxy, wyy, wz, wxz, wyz;
    V most_off = hn::Zero(d);
    for (int i = 0; i < plane_samples; i += lanes) {
      const V x = hn::Load(d, sand.x + i), y = hn::Load(d, sand.y + i), z = hn::Load(d, sand.height + i),
              there = hn::Load(d, sand.there + i);
      const V off = there * hn::Abs(z - (a + x * b + y * c));
      most_off = Max(most_off, off);
      const V weight = turn == 0 ? there : there * (one / (off + least));
      const V weight_x = weight * x, weight_y = weight * y;
      w.add(i, weight);
      wx.add(i, weight_x);
      wy.add(i, weight_y);
      wz.add(i, weight * z);
      wxx.add(i, weight_x * x);
      wxy.add(i, weight_x * y);
      wyy.add(i, weight_y * y);
      wxz.add(i, weight_x * z);
      wyz.add(i, weight_y * z);
    }
    if (turn > 0 && largest(most_off) < 1e-6 * reach) break;  // all samples lie in the plane
    const double x = wx.total(), y = wy.total(), xy = wxy.total();
    const Eigen::Matrix3d normal{{w.total(), x, y}, {x, wxx.total(), xy}, {y, xy, wyy.total()}};
    plane = normal.inverse() * Eigen::Vector3d(wz.total(), wxz.total(), wyz.total());
  }
  return plane;
}

}  // namespace HWY_NAMESPACE
}  // namespace sandstroke
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace sandstroke {

HWY_EXPORT(LeastDeviations);

Eigen::Vector3d least_deviations(const SeenSand& sand, double reach) {
  return HWY_DYNAMIC_DISPATCH(LeastDeviations)(sand, reach);
}

}  // namespace sandstroke
#endif
