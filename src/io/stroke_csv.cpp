#include "io/stroke_csv.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>

#include "core/error.h"
#include "core/input_file.h"

namespace sandstroke {
namespace {

using Eigen::Vector3d;

Unit unit(const std::string& name, const std::map<std::string, Unit>& units, const char* quantity) {
  if (const auto found = units.find(name); found != units.end()) return found->second;
  std::vector<std::string> names;
  for (const auto& [known, ratio] : units) names.push_back(known);
  throw_input_error("'{}' is not a unit of {}; take one of: {}", name, quantity, fmt::join(names, ", "));
}

std::string_view trimmed(std::string_view text) {
  constexpr std::string_view blank = " \t\r";
  const std::size_t begin = text.find_first_not_of(blank);
  if (begin == std::string_view::npos) return {};
  return text.substr(begin, text.find_last_not_of(blank) - begin + 1);
}

std::vector<std::string_view> split(std::string_view line) {
  std::vector<std::string_view> fields;
  while (true) {
    const std::size_t comma = line.find(',');
    fields.push_back(trimmed(line.substr(0, comma)));
    if (comma == std::string_view::npos) return fields;
    line.remove_prefix(comma + 1);
  }
}

/// Reads the rows into a stroke whose times may still be equal.
class TableReader {
 public:
  TableReader(const std::string& name, const StrokeCsvFormat& format) : name_(name), format_(format) {
    if (!format.columns.empty()) take_header(format.columns);
  }

  /// The next part of the text, cut anywhere.
  void read(std::string_view part) {
    for (std::size_t end; (end = part.find('\n')) != std::string_view::npos; part.remove_prefix(end + 1)) {
      extend_line(part.substr(0, end));
      end_line();
    }
    extend_line(part);
  }

  void end() {
    if (!rest_.empty()) end_line();
    if (columns_.empty())
      throw_input_error("{}: is empty; give a table with a header row and one row per sample", name_);
    if (lines_.empty()) throw_input_error("{}: has no samples; add at least one row", name_);
  }

  Stroke& stroke() { return stroke_; }
  const std::vector<std::size_t>& lines() const { return lines_; }  ///< of each sample

 private:
  using Indices = std::vector<std::size_t>;

  void extend_line(std::string_view part) {
    constexpr std::size_t most = 1'000'000;  // bytes
    if (rest_.size() + part.size() > most)
      throw_input_error("{}:{}: the line is longer than {} MB; write one sample per line", name_, line_ + 1,
                        most / 1'000'000);
    rest_ += part;
  }

  void end_line() {
    std::string_view line = rest_;
    if (++line_ == 1 && line.starts_with("\xEF\xBB\xBF")) line.remove_prefix(3);  // byte-order mark
    take_line(trimmed(line));
    rest_.clear();
  }

  void take_line(std::string_view line) {
    if (line.empty() || line == format_.skip) return;
    if (line == format_.pen_up) {
      if (!stroke_.contact.empty()) stroke_.contact.back() = pen_lifts;
      return;
    }
    const std::vector<std::string_view> fields = split(line);
    if (columns_.empty()) {
      take_header({fields.begin(), fields.end()});
    } else {
      take_row(fields);
    }
  }

  void take_header(const std::vector<std::string>& columns) {
    columns_ = columns;
    position_ = find(format_.position.names);
    if (format_.velocity) velocity_ = find(format_.velocity->names);
    if (format_.force) force_ = find(format_.force->names);
    if (format_.time) time_ = find({*format_.time}).front();
  }

  Indices find(const std::vector<std::string>& names) const {
    Indices found;
    for (const std::string& wanted : names) {
      const auto count = std::count(columns_.begin(), columns_.end(), wanted);
      const std::string place = format_.columns.empty() ? fmt::format("{}:{}", name_, line_) : "--columns";
      if (count == 0) {
        throw_input_error("{}: column '{}' is missing; the columns are: {}", place, wanted,
                          fmt::join(columns_, ", "));
      }
      if (count > 1)
        throw_input_error("{}: {} columns are named '{}'; give each its own name", place, count, wanted);
      found.push_back(
          static_cast<std::size_t>(std::find(columns_.begin(), columns_.end(), wanted) - columns_.begin()));
    }
    return found;
  }

  void take_row(const std::vector<std::string_view>& fields) {
    if (fields.size() != columns_.size()) {
      throw_input_error("{}:{}: {} fields instead of {} ({}); correct or remove the line", name_, line_,
                        fields.size(), columns_.size(), fmt::join(columns_, ", "));
    }
    const std::size_t i = lines_.size();
    lines_.push_back(line_);
    stroke_.time.push_back(format_.time ? format_.time_unit.to_si(number(fields, time_))
                                        : static_cast<double>(i) / format_.rate);
    stroke_.position.push_back(vector(fields, position_, format_.position.unit));
    if (format_.velocity) stroke_.velocity.push_back(vector(fields, velocity_, format_.velocity->unit));
    if (format_.force) stroke_.force.push_back(vector(fields, force_, format_.force->unit));
    if (!format_.pen_up.empty()) stroke_.contact.push_back(pen_down);
  }

  Vector3d vector(const std::vector<std::string_view>& fields, const Indices& indices,
                  const Unit& unit_of) const {
    Vector3d found = Vector3d::Zero();
    for (std::size_t axis = 0; axis < indices.size(); ++axis)
      found[static_cast<Eigen::Index>(axis)] = unit_of.to_si(number(fields, indices[axis]));
    return found;
  }

  double number(const std::vector<std::string_view>& fields, std::size_t column) const {
    std::string_view field = fields[column];
    if (field.starts_with('+')) field.remove_prefix(1);
    double value = 0.0;
    const auto [end, failure] = std::from_chars(field.data(), field.data() + field.size(), value);
    if (failure == std::errc() && end == field.data() + field.size() && std::isfinite(value)) return value;
    throw_input_error("{}:{}: column '{}': '{}' is not a finite number; correct or remove the line", name_,
                      line_, columns_[column], fields[column]);
  }

  const std::string& name_;
  const StrokeCsvFormat& format_;
  std::vector<std::string> columns_;
  Indices position_, velocity_, force_;
  std::size_t time_ = 0;
  std::size_t line_ = 0;  // the last whole one
  std::string rest_;      // of the text: a line that has not ended
  Stroke stroke_;
  std::vector<std::size_t> lines_;
};

void check_times(const Stroke& stroke, const std::vector<std::size_t>& lines, const std::string& name,
                 bool equal_allowed) {
  for (std::size_t i = 1; i < stroke.size(); ++i) {
    if (stroke.time[i] < stroke.time[i - 1]) {
      throw_input_error("{}:{}: time {} s is earlier than {} s in line {}; sort or correct the lines", name,
                        lines[i], stroke.time[i], stroke.time[i - 1], lines[i - 1]);
    }
    if (stroke.time[i] == stroke.time[i - 1] && !equal_allowed) {
      throw_input_error(
          "{}:{}: time {} s also stands in line {}; add --equal-times drop (keep the first) or spread (space "
          "them evenly)",
          name, lines[i], stroke.time[i], lines[i - 1]);
    }
  }
}

void drop_equal_times(Stroke& stroke) {
  const std::vector<double> time = stroke.time;
  std::vector<std::size_t> kept;
  for (std::size_t i = 0; i < time.size(); ++i) {
    if (i == 0 || time[i] != time[i - 1]) {
      kept.push_back(i);
    } else if (!stroke.contact.empty() && stroke.contact[i] == pen_lifts) {
      stroke.contact[kept.back()] = pen_lifts;
    }
  }
  const auto keep = [&kept](auto& column) {
    if (column.empty()) return;
    for (std::size_t k = 0; k < kept.size(); ++k) column[k] = column[kept[k]];
    column.resize(kept.size());
  };
  keep(stroke.time);
  keep(stroke.position);
  keep(stroke.velocity);
  keep(stroke.force);
  keep(stroke.contact);
}

void spread_equal_times(Stroke& stroke, const std::string& name) {
  std::vector<double>& time = stroke.time;
  for (std::size_t begin = 0, end = 0; begin < time.size(); begin = end) {
    for (end = begin + 1; end < time.size() && time[end] == time[begin]; ++end) {
    }
    if (end - begin == 1) continue;
    const bool has_next = end < time.size();
    if (!has_next && begin == 0)
      throw_input_error("{}: all {} samples have the same time; use --rate instead", name, time.size());
    const bool ends_pen_stroke =
        !has_next || (!stroke.contact.empty() && stroke.contact[end - 1] == pen_lifts);
    double spacing = has_next ? (time[end] - time[begin]) / static_cast<double>(end - begin) : time[begin];
    if (ends_pen_stroke && begin > 0) {
      const double before = time[begin] - time[begin - 1];
      spacing = has_next ? std::min(spacing, before) : before;
    }
    for (std::size_t i = begin + 1; i < end; ++i)
      time[i] = time[begin] + static_cast<double>(i - begin) * spacing;
  }
}

Stroke finished(TableReader& table, const std::string& name, const StrokeCsvFormat& format) {
  table.end();
  Stroke& stroke = table.stroke();
  check_times(stroke, table.lines(), name, format.equal_times != EqualTimes::error);
  if (format.equal_times == EqualTimes::drop) drop_equal_times(stroke);
  if (format.equal_times == EqualTimes::spread) spread_equal_times(stroke, name);
  stroke.nominal_rate = format.time ? 0.0 : format.rate;
  check_stroke(stroke, name);
  return std::move(stroke);
}

}  // namespace

Unit position_unit(const std::string& name, double pixel_size) {
  if (name == "px") {
    if (!(pixel_size > 0.0)) throw_input_error("unit px needs the size of a pixel; give --pixel-size in m");
    return {pixel_size, 1.0};
  }
  return unit(
      name,
      {{"m", {1, 1}}, {"cm", {1, 100}}, {"mm", {1, 1e3}}, {"um", {1, 1e6}}, {"in", {254, 1e4}}, {"px", {}}},
      "length");
}

Unit time_unit(const std::string& name) {
  return unit(name, {{"s", {1, 1}}, {"ms", {1, 1e3}}, {"us", {1, 1e6}}, {"ns", {1, 1e9}}}, "time");
}

Unit speed_unit(const std::string& name) {
  return unit(name, {{"m/s", {1, 1}}, {"cm/s", {1, 100}}, {"mm/s", {1, 1e3}}}, "speed");
}

Unit force_unit(const std::string& name) { return unit(name, {{"N", {1, 1}}, {"mN", {1, 1e3}}}, "force"); }

Stroke parse_stroke_csv(std::string_view text, const std::string& name, const StrokeCsvFormat& format) {
  TableReader table(name, format);
  table.read(text);
  return finished(table, name, format);
}

Stroke read_stroke_csv(const std::filesystem::path& path, const StrokeCsvFormat& format) {
  const std::string name = path.string();
  InputFile file(path, InputFile::Pipe::taken);
  TableReader table(name, format);
  for (std::string_view part = file.next_block(); !part.empty(); part = file.next_block()) table.read(part);
  return finished(table, name, format);
}

}  // namespace sandstroke
