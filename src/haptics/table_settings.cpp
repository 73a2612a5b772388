#include "haptics/table_settings.h"

namespace sandstroke {

void describe_table(KeyVisitor& v, TableSettings& t) {
  v.text("position", t.position,
         "columns of the tip, by name or number: \"x,y,z\" with z up, or \"x,y\" (then z = 0); \"-x,z,y\" "
         "negates x and swaps the others");
  v.text("position_unit", t.position_unit,
         "unit of the position: m, cm, mm, um, nm, dm, km, in, ft, px, or its length in metres");
  v.number("pixel_size", t.pixel_size, not_negative, "m", "size of a pixel, for unit px");
  v.text("time", t.time, "column of the time: numbers, or ISO 8601; or two columns, \"sec,nanosec\"");
  v.text("time_unit", t.time_unit, "unit of the time: s, ms, us, ns, min, h or day");
  v.number("rate", t.rate, not_negative, "Hz", "samples per second, instead of times");
  v.number("speed", t.speed, not_negative, "m/s", "speed of the tip on the bed, instead of times");
  choose(v, "equal_times", t.equal_times, {"error", "drop", "spread"},
         "what to do with samples of equal times: stop with an error, keep the first, or space them evenly");
  choose(
      v, "missing", t.missing, {"gap", "error"},
      "what to do with samples that lack a value (an empty cell, or NaN): leave them out and lift the tool "
      "there, or stop with an error");
  v.text("velocity", t.velocity,
         "columns of the tip's velocity, or none; the stroke keeps it, but runs do not use it");
  v.text("velocity_unit", t.velocity_unit, "unit of the velocity: m/s, cm/s or mm/s");
  v.text("force", t.force, "columns of the recorded force, or none");
  v.text("force_unit", t.force_unit, "unit of the force: N, mN, kN, gf, kgf, lbf, or its size in newtons");
  choose(v, "force_sign", t.force_sign, force_sign_names,
         "on device: the force of the sand on the device; by hand: the force of the hand, its opposite");
  v.text("orientation", t.orientation,
         "4 columns of a quaternion x,y,z,w, or 9 of a rotation matrix, row by row; or none");
  v.text("pressure", t.pressure, "column of the pen's pressure, in any unit, or none");
  v.text("stroke_number", t.stroke_number,
         "column whose value changes where another stroke of the pen begins, or none");
  v.text("pen_state", t.pen_state,
         "column of the pen's state: down where it is not 0; \"-NAME\": down where it is 0; or none");
  v.text("part", t.part,
         "one of several recordings in a file: a topic of a bag (/tf:FRAME for a frame of several), a "
         "variable of a MATLAB file");
  v.text("columns", t.columns, "names of all columns, if no header line has them: \"x,y,t\"");
  choose(v, "separator", t.separator, {"found", "comma", "semicolon", "tab", "blanks"},
         "separator between columns");
  choose(v, "decimal", t.decimal, {"found", "point", "comma"}, "decimal mark");
  v.text("encoding", t.encoding, "encoding of the text, such as UTF-16LE");
  v.integers("skip_lines", &t.skip_lines, 1, 0, 1'000'000, "number of lines to skip at the beginning");
  v.text("skip", t.skip, "lines that begin with one of these words are skipped: \"START,END\"");
  v.text("pen_up", t.pen_up,
         "lines that begin with one of these words lift the pen; for G-code, the word that lifts it: "
         "\"M280 S90\", \"M3 S30\", \"M5\", \"G0\", or none");
  v.text("pen_down", t.pen_down,
         "for G-code, the word that lowers the pen, if it is not the one of pen_up with another number: "
         "\"M106\"");
  v.number(
      "gap_threshold", t.gap_threshold, not_negative, "s",
      "samples further apart in time are not joined: the tool lifts; 0: five times the usual spacing, at "
      "least 0.1 s, or no gaps if speed is given");
  int device = t.frame == "device" ? 1 : 0;
  v.choice("frame", device, {"bed", "device"}, "axes of the positions");
  t.frame = device == 1 ? "device" : "bed";
  v.text("merge", t.merge,
         "a second table in the same folder, with force or orientation (named as above) at its own times");
  v.text("merge_part", t.merge_part,
         "one of several recordings in the second file, which may be the first one");
  v.text("merge_time", t.merge_time, "column of the time in the second table");
  v.text("merge_time_unit", t.merge_time_unit,
         "unit of the time in the second table: s, ms, us, ns, min, h or day");
  v.number("merge_rate", t.merge_rate, not_negative, "Hz",
           "samples per second of the second table, instead of times");
  v.number("merge_shift", t.merge_shift, any_number, "s",
           "seconds that are added to the times of the second table");
}

}  // namespace sandstroke
