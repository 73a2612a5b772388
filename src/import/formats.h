#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "haptics/table_settings.h"
#include "import/sample_table.h"

namespace sandstroke {

/// Reads samples from a file of any format except tables of text: theta-rho, G-code, UNIPEN, InkML, SVG,
/// HPGL, MATLAB, NumPy, bags of ROS 1 and 2, MCAP. The content tells the format, or the ending where the
/// content cannot (theta-rho). None: it is text of none of these formats, so perhaps a table; or a pipe (also
/// "-", standard input), which is left alone. settings.part names one of several recordings in a file: a
/// topic of a bag, a variable of a MATLAB file, an array of a NumPy archive. Error: io; input, also if the
/// file is of a known kind that holds no samples or is not read: the sentence names it and the way out.
std::optional<SampleTable> read_known_format(const std::filesystem::path& path,
                                             const TableSettings& settings = {});

}  // namespace sandstroke
