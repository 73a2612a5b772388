#pragma once

#include <cmath>

#include "fuzz.h"
#include "import/stroke_of_table.h"

namespace sandstroke {

/// Requires what every reader of samples guarantees.
inline void require_sound(const SampleTable& table) {
  require(table.size() > 0);
  for (const SampleColumn& column : table.columns) {
    require(column.values.size() == table.size());
    for (const double value : column.values) require(!std::isinf(value));  // NaN: the file has no number
  }
  require(table.lines.empty() || table.lines.size() == table.size());
  require(table.lifts.empty() || table.lifts.size() == table.size());
}

/// Requires it of a path, too, whose lines are drawn at a speed.
inline void require_path(const SampleTable& table) {
  require_sound(table);
  TableSettings settings;
  settings.position_unit = "0.2";
  settings.speed = 0.05;
  const Stroke stroke = stroke_of_table(table, settings, "path").stroke;
  require(stroke.size() >= 1 && stroke.size() <= 3 * table.size());
  check_stroke(stroke, "path");
}

}  // namespace sandstroke
