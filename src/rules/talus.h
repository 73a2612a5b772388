#pragma once

#include <Eigen/Core>

#include "core/compensated_sum.h"

namespace sandstroke {

/// Heights of a bed's cells, height(row, col) in m; row-major, as files and pictures take it.
using HeightGrid = Eigen::Array<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
/// Cells that neither give nor take sand.
using WallGrid = Eigen::Array<bool, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// How sand that lies too steep flows. m is a cell's height, m_i its neighbour's, and T_i = tan(talus) times
/// the distance between the two. c, the share, is 1/2 for paper and 1/4 for the others.
///   paper:     dm = c max_i(m - m_i - T_i) over the 8 neighbours, shared among those with m - m_i > T_i in
///              proportion to m - m_i (section 3.2)
///   isotropic: upwind slope |g| = sqrt(gx^2 + gy^2), gx = max(0, m - west, m - east)/dx; each lower axis
///              neighbour gets c (1 - tan(talus)/|g|) (m - m_i); monotone for c <= 1/4
///   faces:     the same with |g| at the face between the two cells, so that a crest that slides on one side
///              gives nothing to the other. Along the face's normal the slope is the drop M = m - m_i, and
///              n^2 / (3 max(M, N)) with n = min(M, N) where the giver falls by N to its other side, too.
///              (Heights are means: those of a crest of slope T whose top is in the cell drop by M and N with
///              M + N^2 / (3 M) = T dx, N <= M.) Across it the slope is the mean of both cells' central
///              differences, one-sided at walls.
enum class RelaxationLaw { paper, isotropic, faces };

/// On a ground (TalusGround), T of two neighbours is the mean of theirs, as tan. With w = T of the law over
/// that mean:
///   paper:     T_i is that mean, times the distance in cells
///   isotropic: gx = max(0, w (m - west), w (m - east))/dx, and so on: each slope as a part of what it may be
///   faces:     so with the slope along the face's normal, and with each difference across it. No height
///   counts
///              there as higher over its neighbour than twice its sand: stone that stands up beside a face is
///              no slope of sand.
/// A cell gives at most its sand z = m - s: what it gives is scaled by min(1, z / sum of it). A cell whose
/// sand is thinner than 2^-32 cells gives nothing, and its slopes do not count.

/// tan(talus angle [deg]): rise over run.
double talus_slope(double talus_angle);

/// A law with its numbers: which slopes are too steep, as height differences [m] between neighbours.
struct TalusLaw {
  RelaxationLaw law;
  double share;          ///< c
  double axis_drop;      ///< T of an axis neighbour: tan(talus) dx
  double diagonal_drop;  ///< T of a diagonal neighbour: tan(talus) sqrt(2) dx
  double axis_limit;     ///< a cell with a larger drop gives: T (1 + tolerance)
  double diagonal_limit;
  double tolerated;         ///< 1 + tolerance
  double thinnest;          ///< m: thinner sand on a floor counts as none
  double most_given = 1.0;  ///< how many times its sand a cell may give in a pass
};
/// Of each cell of a bed:
struct TalusGround {
  HeightGrid axis_drops;  ///< T of an axis neighbour of the same kind [m]: tan(talus) dx
  HeightGrid floor;       ///< s [m], which no sand gets below; -infinity: none
};
/// talus_angle [deg]. tolerance: a fraction of tan(talus). cell_size [m].
TalusLaw talus_law(RelaxationLaw law, double share, double talus_angle, double tolerance, double cell_size);

/// The outcome of one pass.
struct TalusPass {
  HeightGrid heights;  ///< m, afterwards
  bool flows;          ///< some cell gives
  double residual;     ///< before the pass: the steepest slope over tan(talus), less 1; at least 0
};

/// One pass over all cells at once, from the old heights to the new: the talus condition and what it moves.
/// Adds the heights [m] that cells give to `moved`. Nothing crosses the border, nor gets into or out of
/// walls. ground: null where the sand is deep and of one kind.
TalusPass talus_pass(const HeightGrid& heights, const WallGrid& walls, const TalusGround* ground,
                     const TalusLaw& law, CompensatedSum& moved);

}  // namespace sandstroke
