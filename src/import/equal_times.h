#pragma once

#include <string>
#include <vector>

#include "haptics/stroke.h"
#include "haptics/table_settings.h"

namespace sandstroke {

/// Lets the times of a stroke increase. After a drop pen strokes are still apart.
///
/// spread: the samples of a run of k equal stamps are placed evenly up to the next stamp, 1/k of the way
/// apart. A run that ends a pen stroke (or the file) is placed with the spacing before it instead, where that
/// is less: what follows is no part of the drawing. Error: input, naming the line (lines: of each sample, or
/// empty), where times decrease, or are equal with EqualTimes::error.
void settle_equal_times(Stroke& stroke, const std::vector<std::size_t>& lines, EqualTimes rule,
                        const std::string& name);

}  // namespace sandstroke
