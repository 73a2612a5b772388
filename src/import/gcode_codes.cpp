#include "import/gcode_codes.h"

#include <string_view>

#include "core/error.h"

namespace sandstroke {
namespace {

struct GcodeRow {
  int first, last;  // numbers times 10
  GcodeRole role;
  const char* why_not = nullptr;  // it is refused with coordinates other than 0; null: it may have any
  std::string_view letters = "";  // with these it is refused, whatever they say
  std::string_view within = "";   // so it is with these once a path has begun
};

constexpr const char* other_curve = "is a curve of another kind than G2 and G3";
constexpr const char* changes_offsets = "changes the offsets of coordinates";
constexpr const char* cuts_thread = "cuts a thread";

constexpr GcodeRow roles[] = {
    {0, 30, GcodeRole::read},  // motion
    {40, 40, GcodeRole::waits},
    {50, 50, GcodeRole::waits, other_curve, "XYZIJQ"},  // without coordinates: high precision
    {51, 51, GcodeRole::waits, other_curve, "IJ"},
    {80, 90, GcodeRole::keeps_path},                           // looking ahead; exact stop
    {100, 100, GcodeRole::waits, changes_offsets, "", "XYZ"},  // without coordinates: retracts the filament
    {110, 110, GcodeRole::waits},
    {150, 150, GcodeRole::keeps_path},  // polar coordinates off
    {170, 190, GcodeRole::read},        // plane
    {200, 210, GcodeRole::read},        // unit
    {220, 230, GcodeRole::waits},       // limits
    {280, 300, GcodeRole::goes_home},   // and G29: probes the bed
    {281, 281, GcodeRole::waits},       // stores home
    {301, 301, GcodeRole::waits},
    {320, 340, GcodeRole::goes_home, cuts_thread, "XYZK"},  // without coordinates, printers probe their bed
    {400, 400, GcodeRole::keeps_path},                      // no compensation of the tool's radius
    {430, 440, GcodeRole::keeps_path},                      // length of the tool
    {431, 431, GcodeRole::keeps_path},
    {490, 490, GcodeRole::keeps_path},
    {500, 500, GcodeRole::waits, "scales, or changes the offsets of coordinates", "",
     "XYZ"},                            // without: scaling off
    {501, 501, GcodeRole::keeps_path},  // mirrors off
    {520, 520, GcodeRole::waits, changes_offsets},
    {530, 530, GcodeRole::goes_home},  // coordinates of the machine
    {540, 590, GcodeRole::read},       // coordinates of the workpiece
    {591, 593, GcodeRole::read},
    {600, 640, GcodeRole::keeps_path},  // exact stops
    {611, 611, GcodeRole::keeps_path},
    {650, 650, GcodeRole::calls},       // macro
    {670, 670, GcodeRole::keeps_path},  // no macro
    {690, 690, GcodeRole::keeps_path},  // no rotation
    {800, 800, GcodeRole::keeps_path},  // no cycle
    {900, 910, GcodeRole::read},        // distances
    {901, 901, GcodeRole::read},
    {911, 911, GcodeRole::read},
    {920, 920, GcodeRole::read},  // offsets
    {921, 922, GcodeRole::read},
    {940, 940, GcodeRole::keeps_path},    // F per minute
    {960, 990, GcodeRole::keeps_path},    // speed of the spindle; retreat of cycles
    {1610, 1620, GcodeRole::goes_home},   // of some printers
    {1870, 1870, GcodeRole::keeps_path},  // smoothing
};

/// True if the row holds the word. A row of whole numbers holds no others: G0 to G3, but not G1.5.
bool row_holds(const GcodeRow& row, int code) {
  return row.first <= code && code <= row.last && (row.first % 10 != 0 || code % 10 == 0);
}

/// Words that are never read, and why.
struct GcodeRefusal {
  int first, last;
  const char* why;
};

constexpr GcodeRefusal refusals[] = {
    {60, 60, other_curve},
    {70, 70, "makes X a diameter"},
    {160, 160, "begins polar coordinates"},
    {410, 429, "moves the path by the tool's radius"},
    {510, 511, "scales or mirrors the path"},
    {680, 681, "turns the path"},
    {730, 760, "is a cycle of several moves"},
    {810, 899, "is a cycle of several moves"},
    {923, 923, "restores offsets from before the program"},
    {930, 930, "makes F a time instead of a speed"},
    {950, 950, "makes F a way per turn instead of a speed"},
};

bool has_coordinates(const GcodeWords& words) {
  for (const char letter : {'X', 'Y', 'Z'})
    if (words[letter] && *words[letter] != 0.0) return true;
  return false;
}

}  // namespace

GcodeRole role_of_g(int code, const GcodeWords& words, bool path_has_begun, const std::string& location) {
  std::string why;
  for (const GcodeRow& row : roles) {
    if (!row_holds(row, code)) continue;
    if (!row.why_not || !(has_coordinates(words) || words.has_any_of(row.letters) ||
                          (path_has_begun && words.has_any_of(row.within))))
      return row.role;
    why = row.why_not;
  }
  for (const GcodeRefusal& refusal : refusals)
    if (refusal.first <= code && code <= refusal.last) why = refusal.why;
  throw_input_error("{}: {} is not supported{}; write the path with G0 to G3", location,
                    gcode_word_text('G', code), why.empty() ? "" : ": it " + why);
}

}  // namespace sandstroke
