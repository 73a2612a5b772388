#pragma once

#include <vector>

namespace sandstroke {

/// The distance [samples] of each sample of a rows x cols grid to the edge of the covered ones: positive
/// inside, negative outside. The edge lies half a sample before the nearest sample of the other kind. Exact
/// (Felzenszwalb & Huttenlocher, Theory of Computing 8, 2012) but for rounding to multiples of 2^-20, which
/// makes sums of distances exact.
std::vector<double> signed_distance(const std::vector<unsigned char>& covered, int rows, int cols);
/// The same, but 0 outside, at half the work.
std::vector<double> distance_inside(const std::vector<unsigned char>& covered, int rows, int cols);

}  // namespace sandstroke
