#pragma once

#include <vector>

namespace sandstroke {

/// How far each sample of a rows x cols grid lies inside the covered ones [samples]: to the edge halfway
/// between it and the nearest sample that is not covered; negative outside. Exact (Felzenszwalb &
/// Huttenlocher, Theory of Computing 8, 2012) but for rounding to multiples of 2^-20, so that sums of them
/// are exact.
std::vector<double> signed_distance(const std::vector<unsigned char>& covered, int rows, int cols);
/// The same, but 0 outside: at half the work.
std::vector<double> distance_inside(const std::vector<unsigned char>& covered, int rows, int cols);

}  // namespace sandstroke
