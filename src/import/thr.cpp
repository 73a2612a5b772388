#include "import/thr.h"

#include <cmath>

#include "core/elementary.h"
#include "core/error.h"
#include "core/input_file.h"
#include "import/sample_checks.h"
#include "import/text_parts.h"

namespace sandstroke {
namespace {

struct PolarPoint {
  double theta = 0.0, rho = 0.0;
};

/// The number of chords for a spiral. A chord over h is off by at most h^2 |p''| / 8, and the spiral's second
/// derivative by theta is 2 rho' along the circle and -rho along the radius.
double chords(const PolarPoint& from, const PolarPoint& to) {
  const double turn = std::abs(to.theta - from.theta), out = std::abs(to.rho - from.rho);
  const double rho = std::max(std::abs(from.rho), std::abs(to.rho));
  const double bend = elementary::hypot(rho * turn * turn, 2.0 * out * turn);
  const bool moves = out > 0.0 || (turn > 0.0 && rho > 0.0);
  return std::max(std::ceil(std::sqrt(bend / (8.0 * thr_tolerance))), moves ? 1.0 : 0.0);
}

PolarPoint thr_point(std::string_view line, const std::string& name, std::size_t number) {
  std::string_view rest = line;
  const std::optional<double> theta = finite_number(cut_word(rest)), rho = finite_number(cut_word(rest));
  if (!theta || !rho || !without_blanks(rest).empty()) {
    throw_input_error("{}:{}: '{}' is not a pair of numbers, theta and rho; correct or remove the line", name,
                      number, line.substr(0, 80));
  }
  if (std::abs(*rho) > 1.01) {  // digits are few, and some tracks go a little beyond the table
    throw_input_error(
        "{}:{}: rho is {}, but it must be a fraction of the table's radius, at most 1; divide all rho by the "
        "largest",
        name, number, *rho);
  }
  return {*theta, *rho};
}

}  // namespace

SampleTable parse_thr(std::string_view text, const std::string& name) {
  SampleTable table;
  table.line_tolerance = thr_line_tolerance;
  table.columns = {{"x", "radius", {}}, {"y", "radius", {}}};
  const auto add = [&table](double theta, double rho, std::size_t line) {
    table.columns[0].values.push_back(rho * elementary::sin(theta));
    table.columns[1].values.push_back(rho * elementary::cos(theta));
    table.lines.push_back(line);
  };
  text = without_byte_order_mark(text);
  PolarPoint last;
  std::size_t points = 0;
  for (std::size_t number = 1; !text.empty(); ++number) {
    std::string_view line = cut_line(text);
    line = without_blanks(cut_before(line, '#'));
    if (line.empty() || line.starts_with("//")) continue;
    const PolarPoint next = thr_point(line, name, number);
    if (points++ == 0) {
      add(next.theta, next.rho, number);
    } else {
      const double count = chords(last, next);
      check_curve_points(count, table.size(), name, number);
      for (double k = 1.0; k <= count; ++k) {
        const double fraction = k / count;
        add(std::lerp(last.theta, next.theta, fraction), std::lerp(last.rho, next.rho, fraction), number);
      }
    }
    last = next;
  }
  if (points == 0) throw_input_error("{}: has no points; give lines of theta (rad) and rho (0 to 1)", name);
  table.description = fmt::format(
      "theta-rho track of a sand table: {} points, {} samples along the spirals between them, "
      "theta grows clockwise from the top",
      points, table.size());
  return table;
}

SampleTable read_thr(const std::filesystem::path& path) {
  return parse_thr(read_text_file(path, most_sample_text_bytes), path.string());
}

}  // namespace sandstroke
