#pragma once

#include <string>
#include <vector>

#include "haptics/stroke.h"
#include "haptics/table_settings.h"

namespace sandstroke {

/// Makes the times of a stroke increase. Pen strokes stay apart after a drop.
///
/// spread: k samples in a row with equal stamps are placed evenly up to the next stamp, 1/k of the way apart.
/// If they end a pen stroke (or the file), they take the spacing before them instead, if that is less: what
/// follows is not part of the drawing. Error: input, naming the line (lines: of each sample, or empty; they
/// stay those of the samples), if times decrease, or are equal with EqualTimes::error.
void settle_equal_times(Stroke& stroke, std::vector<std::size_t>& lines, EqualTimes rule,
                        const std::string& name);

}  // namespace sandstroke
