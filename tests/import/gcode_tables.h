#pragma once

#include <string>
#include <vector>

#include "complaint.h"
#include "import/gcode.h"

namespace sandstroke {

inline SampleTable gcode_table(const std::string& text) { return parse_gcode(text, "path.gcode"); }

inline std::string gcode_complaint(const std::string& text) {
  return complaint_of([&] { gcode_table(text); });
}

inline std::vector<double> gcode_values(const SampleTable& table, const std::string& name) {
  return column(table, name).values;
}

}  // namespace sandstroke
