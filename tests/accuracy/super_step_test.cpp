// Super time stepping against the exact cone and against the small-step limit of the same law: how near, and
// in how many passes. (Times are the business of tests/bench.)
#include <gtest/gtest.h>

#include <cmath>

#include "sand/initial_surface.h"
#include "sand/relaxation.h"
#include "sanitized.h"
#include "validation/study/exact_shapes.h"

namespace sandstroke {
namespace {

/// The cone that peers are measured with: a cylinder of R = 60, H = 80 cells on 512^2, or as much on another
/// side.
struct PeersCone {
  int side;
  double radius = 60.0 * side / 512, height = 80.0 * side / 512;
  ExactCone exact = collapsed_cylinder(radius, height, RelaxationSettings{}.talus_angle);

  HeightField start() const {
    SurfaceSettings cylinder;
    cylinder.kind = SurfaceKind::cylinder;
    cylinder.radius = radius;
    cylinder.height = height;
    return make_surface(cylinder, side, side, 1.0);
  }
  /// RMS over the field / apex.
  double error(const HeightField& bed) const {
    double sum = 0.0;
    for (int row = 0; row < side; ++row)
      for (int col = 0; col < side; ++col)
        sum += std::pow(bed(row, col) - exact(bed.x_of(col), bed.y_of(row)), 2);
    return std::sqrt(sum) / side / exact.top();
  }
  double distance(const HeightField& a, const HeightField& b) const {
    return std::sqrt((a.grid() - b.grid()).square().sum()) / side / exact.top();
  }
};

RelaxationOutcome relax(HeightField& bed, RelaxationMethod method, double share = 0.0) {
  RelaxationSettings settings;
  settings.law = RelaxationLaw::isotropic;
  settings.method = method;
  settings.share = share;
  return make_relaxer(settings, bed.cell_size())->relax(bed);
}

TEST(SuperSteps, ReachThePeersConeInAFortiethOfThePasses) {
  if (sanitized) GTEST_SKIP() << "long; what it runs through, shorter tests do";
  const PeersCone cone{512};
  HeightField super = cone.start(), plain = cone.start(), small_steps = cone.start();
  const RelaxationOutcome few = relax(super, RelaxationMethod::rkl),
                          many = relax(plain, RelaxationMethod::passes);
  relax(small_steps, RelaxationMethod::passes, 0.1);
  ASSERT_TRUE(few.converged && many.converged);
  EXPECT_LE(40 * few.passes, many.passes);
  EXPECT_LT(cone.error(super), 0.003);
  EXPECT_LT(cone.error(super), 1.1 * cone.error(plain));
  EXPECT_LT(cone.distance(super, small_steps), 0.001);
}

TEST(SuperSteps, PassesGrowLikeTheSideNotLikeItsSquare) {
  std::int64_t last = 0;
  for (const int side : {256, 512, 1024}) {
    const PeersCone cone{side};
    HeightField bed = cone.start();
    const std::int64_t passes = relax(bed, RelaxationMethod::rkl).passes;
    if (last > 0) {
      EXPECT_LT(static_cast<double>(passes), 2.5 * static_cast<double>(last));
    }
    EXPECT_LT(cone.error(bed), 0.001);
    last = passes;
  }
}

TEST(SuperSteps, StayNearTheSmallStepLimitOnTenRoughBeds) {
  if (sanitized) GTEST_SKIP() << "long; what it runs through, shorter tests do";
  for (unsigned seed = 1; seed <= 10; ++seed) {
    SurfaceSettings noise;
    noise.kind = SurfaceKind::noise;
    noise.amplitude = seed % 2 ? 20.0 : 10.0;  // cells
    noise.wavelength = 0.0;
    noise.seed = seed;
    HeightField super = make_surface(noise, 128, 128, 1.0), plain = super, small_steps = super;
    const HeightGrid start = super.grid();
    const std::int64_t few = relax(super, RelaxationMethod::rkl).passes;
    const std::int64_t many = relax(plain, RelaxationMethod::passes).passes;
    relax(small_steps, RelaxationMethod::passes, 0.02);
    const double moved = (small_steps.grid() - start).abs().sum();
    EXPECT_LE(2 * few, many) << seed;
    EXPECT_LT((super.grid() - small_steps.grid()).abs().sum() / moved, 0.01) << seed;
  }
}

}  // namespace
}  // namespace sandstroke
