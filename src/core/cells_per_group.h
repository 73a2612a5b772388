#pragma once

namespace sandstroke {

/// Cells, and elements of a surface, are computed in groups of this many neighbours, whatever the width of
/// the machine's vectors.
inline constexpr int cells_per_group = 8;

}  // namespace sandstroke
