#include "import/layout_finder.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <map>
#include <set>

#include "core/error.h"
#include "import/table_option.h"
#include "import/units.h"

namespace sandstroke {
namespace {

using Means = ColumnName::Means;

constexpr const char* means_names[] = {"position", "velocity", "force", "orientation", "orientation"};

/// True for a unit of seconds, or of fractions of them.
bool is_part_of_clock(const std::string& unit, bool seconds) {
  const auto known = known_unit(Quantity::time, unit);
  return known && known->factor == 1.0 && (known->divisor == 1.0) == seconds;
}

/// True if a value of a column in ms, us or ns is a second at least.
bool reaches_second(const SampleColumn& column, const std::string& unit) {
  const auto known = known_unit(Quantity::time, unit);
  return known && known->divisor > 1.0 &&
         std::any_of(column.values.begin(), column.values.end(),
                     [&](double value) { return std::isfinite(value) && value >= known->divisor; });
}

bool has_fractions(const SampleColumn& column) {
  return std::any_of(column.values.begin(), column.values.end(), has_fraction);
}

std::vector<int> order_of(const ColumnChoices& choices) {
  std::vector<int> order;
  for (const ColumnChoice& choice : choices)
    order.push_back(
        static_cast<int>(std::count_if(choices.begin(), choices.end(), [&](const ColumnChoice& other) {
          return other.column < choice.column;
        })));
  return order;
}

/// True for the group of a pose, twist or wrench, as UR robots log it with six numbers: the last three are
/// about the axes.
bool has_six_numbers(const std::string& group) {
  constexpr std::array words{"tcp", "pose", "twist", "wrench"};
  return std::any_of(words.begin(), words.end(),
                     [&](const char* word) { return group.find(word) != std::string::npos; });
}

}  // namespace

/// Columns of one meaning whose names differ only in the axis: indices by axis, -1 if there is none.
struct LayoutFinder::Group {
  int rank = 0;
  std::array<int, 10> axes{-1, -1, -1, -1, -1, -1, -1, -1, -1, -1};
  std::size_t at(int axis) const { return static_cast<std::size_t>(axes[static_cast<std::size_t>(axis)]); }
  bool has(int count) const {
    return std::none_of(axes.begin(), axes.begin() + count, [](int index) { return index < 0; });
  }
};

LayoutFinder::LayoutFinder(const std::vector<SampleColumn>& columns, const std::string& location)
    : location_(location) {
  for (const SampleColumn& column : columns) {
    const ColumnName parts = column_name(column.name);
    const std::string unit = column.unit.empty() ? parts.unit : column.unit;
    names_.push_back({column.name, unit, parts, reaches_second(column, parts.unit), has_fractions(column)});
  }
}

ColumnChoices LayoutFinder::named(const std::string& list, const char* key,
                                  std::initializer_list<std::size_t> counts) const {
  ColumnChoices choices;
  for (const std::string& wanted : parts_of_list(list)) choices.push_back(signed_one(wanted));
  if (std::find(counts.begin(), counts.end(), choices.size()) == counts.end())
    throw_input_error("{}: {} names {} columns ({}); name {}", location_, key, choices.size(), list,
                      fmt::join(counts, " or "));
  for (std::size_t i = 0; i < choices.size(); ++i)
    for (std::size_t k = 0; k < i; ++k)
      if (choices[i].column == choices[k].column)
        throw_input_error("{}: {} names column '{}' twice ({}); name each once", location_, key,
                          names_[choices[i].column].name, list);
  return choices;
}

std::size_t LayoutFinder::one(const std::string& wanted) const {
  check_only_one(wanted, "");
  for (std::size_t i = 0; i < names_.size(); ++i)
    if (names_[i].name == wanted) return i;
  for (std::size_t i = 0; i < names_.size(); ++i)
    if (names_[i].parts.bare == wanted) return i;
  std::size_t number = 0;
  const auto [end, failure] = std::from_chars(wanted.data(), wanted.data() + wanted.size(), number);
  if (failure == std::errc() && end == wanted.data() + wanted.size() && number >= 1 &&
      number <= names_.size())
    return number - 1;
  throw_input_error("{}: column '{}' is missing; the columns are: {}", location_, wanted, all_names());
}

ColumnChoice LayoutFinder::signed_one(const std::string& wanted) const {
  if (!is_name(wanted) && wanted.size() > 1 && (wanted[0] == '-' || wanted[0] == '+'))
    return {one(wanted.substr(1)), wanted[0] == '-' ? -1.0 : 1.0};
  return {one(wanted), 1.0};
}

ColumnChoices LayoutFinder::found(Means means, int least, int most, std::vector<std::string>* doubts) const {
  std::vector<Group> plainest, others;
  for (const std::vector<std::size_t>& columns : groups_of(means)) {
    const std::optional<Group> group = group_of(columns);
    if (!group || !group->has(least)) continue;
    if (!plainest.empty() && group->rank < plainest.front().rank) {
      others.insert(others.end(), plainest.begin(), plainest.end());
      plainest.clear();
    }
    (plainest.empty() || group->rank == plainest.front().rank ? plainest : others).push_back(*group);
  }
  if (plainest.empty()) return {};
  const char* key = means_names[static_cast<int>(means)];
  const Group& group = plainest.front();
  if (plainest.size() > 1 || (doubts && count_of(names_[group.at(0)].name) > 1)) {
    const std::string sentence =
        fmt::format("columns '{}' and '{}' may both be the {}; name its columns with {}",
                    names_[group.at(0)].name, names_[plainest.back().at(0)].name, key, option_and_key(key));
    if (!doubts)
      throw_input_error("{}: {}{}", location_, sentence, means == Means::position ? "" : ", or none");
    doubts->push_back(fmt::format("{} left out: {}", key, sentence));
    return {};
  }
  ColumnChoices choices;
  for (int axis = 0; axis < (group.has(most) ? most : least); ++axis) {
    check_only_one(names_[group.at(axis)].name, key);
    choices.push_back({group.at(axis), 1.0});
  }
  if (means == Means::position) check_not_flat(group, others);
  return choices;
}

void LayoutFinder::check_not_flat(const Group& plainest, const std::vector<Group>& others) const {
  if (plainest.has(3)) return;
  for (const Group& other : others) {
    const std::string &unit = names_[plainest.at(0)].unit, &other_unit = names_[other.at(0)].unit;
    const bool in_space = other.has(3);
    const bool only_plainest_says = other_unit.empty() && !unit.empty() && !is_pixel(unit);
    if (!in_space && (unit == other_unit || only_plainest_says)) continue;
    const auto list = [&](const Group& group) {
      return fmt::format("{},{}{}", names_[group.at(0)].name, names_[group.at(1)].name,
                         group.has(3) ? "," + names_[group.at(2)].name : "");
    };
    throw_input_error(
        "{}: columns '{}' and '{}' may both be the position, and {}; name its columns with {}, such as "
        "\"{}\"",
        location_, names_[plainest.at(0)].name, names_[other.at(0)].name,
        in_space ? "only the second has a height" : "their units differ", option_and_key("position"),
        list(other));
  }
}

std::optional<std::size_t> LayoutFinder::lone_height() const {
  for (std::size_t i = 0; i < names_.size(); ++i) {
    const ColumnName& parts = names_[i].parts;
    if (parts.means == Means::position && parts.axis == 2 && !parts.numbered) return i;
  }
  return std::nullopt;
}

std::optional<std::size_t> LayoutFinder::found_one(Means means) const {
  std::optional<std::size_t> best;
  for (std::size_t i = 0; i < names_.size(); ++i) {
    if (names_[i].parts.means != means) continue;
    if (!best || names_[i].parts.rank < names_[*best].parts.rank) best = i;
  }
  return best;
}

std::optional<std::size_t> LayoutFinder::found_one(Means means, const std::string& key,
                                                   std::vector<std::string>& warnings) const {
  const std::optional<std::size_t> best = found_one(means);
  if (!best) return best;
  check_only_one(names_[*best].name, key);
  for (std::size_t i = *best + 1; i < names_.size(); ++i) {
    if (names_[i].parts.means != means || names_[i].parts.rank != names_[*best].parts.rank) continue;
    warnings.push_back(
        fmt::format("columns '{0}' and '{1}' are equally good, and '{0}' is taken; to take "
                    "'{1}', set {2} to it",
                    names_[*best].name, names_[i].name, option_and_key(key)));
    break;
  }
  return best;
}

std::vector<std::size_t> LayoutFinder::first_two(std::initializer_list<Means> means) const {
  std::vector<std::size_t> columns;
  for (std::size_t i = 0; i < names_.size(); ++i)
    if (std::find(means.begin(), means.end(), names_[i].parts.means) != means.end()) columns.push_back(i);
  std::stable_sort(columns.begin(), columns.end(),
                   [&](std::size_t a, std::size_t b) { return names_[a].parts.rank < names_[b].parts.rank; });
  columns.resize(std::min<std::size_t>(columns.size(), 2));
  return columns;
}

bool LayoutFinder::is_pen_up(std::size_t column) const {
  const Means means = names_[column].parts.means;
  return means == Means::pen_up || means == Means::perhaps_pen_up;
}

LayoutFinder::Time LayoutFinder::plainest_time() const {
  const Time time{found_one(Means::time), {}};
  if (!time.column) return time;
  const std::string& group = names_[*time.column].parts.group;
  const auto part = [&](bool seconds) -> std::optional<std::size_t> {
    for (std::size_t i = 0; i < names_.size(); ++i) {
      const ColumnName& parts = names_[i].parts;
      if (parts.means == Means::time && parts.group == group && is_part_of_clock(parts.unit, seconds))
        return i;
    }
    return std::nullopt;
  };
  const auto seconds = part(true), fraction = part(false);
  const bool in_two = seconds && fraction && (time.column == seconds || time.column == fraction);
  return in_two ? Time{seconds, fraction} : time;
}

LayoutFinder::Time LayoutFinder::found_time(const std::string& key,
                                            std::vector<std::string>& warnings) const {
  const auto [seconds, fraction] = plainest_time();
  if (!fraction) return {found_one(Means::time, key, warnings), {}};
  check_only_one(names_[*seconds].name, key);
  check_only_one(names_[*fraction].name, key);
  if (names_[*seconds].has_fractions || !names_[*fraction].reaches_second) return {seconds, fraction};
  warnings.push_back(
      fmt::format("columns '{0}' and '{1}' are two times, because '{1}' reaches a second, and "
                  "'{1}' is taken; to take '{0}', set {2} to it",
                  names_[*seconds].name, names_[*fraction].name, option_and_key(key)));
  return {fraction, {}};
}

LayoutFinder::Time LayoutFinder::named_time(const std::string& wanted) const {
  const std::vector<std::string> parts = parts_of_list(wanted);
  if (is_name(wanted) || parts.size() != 2) return {one(wanted), {}};
  const Time time{one(parts[0]), one(parts[1])};
  if (!is_part_of_clock(names_[*time.fraction].parts.unit, false))
    throw_input_error(
        "{}: column '{}' does not say whether it counts ms, us or ns of the seconds in '{}'; write its unit "
        "into its name, such as \"nanosec\"",
        location_, parts[1], parts[0]);
  return time;
}

Eigen::Matrix3d LayoutFinder::axes_of(const ColumnChoices& choices) const {
  std::vector<int> axis;
  for (const ColumnChoice& choice : choices) {
    const ColumnName& parts = names_[choice.column].parts;
    axis.push_back(parts.numbered ? -1 : parts.axis);
  }
  const std::set<int> each(axis.begin(), axis.end());
  if (each.size() < axis.size() || (!each.empty() && (*each.begin() < 0 || *each.rbegin() > 2)))
    axis = order_of(choices);
  Eigen::Matrix3d axes = Eigen::Matrix3d::Zero();
  for (std::size_t k = 0; k < choices.size(); ++k) axes(static_cast<int>(k), axis[k]) = choices[k].sign;
  for (int k = static_cast<int>(choices.size()); k < 3; ++k)
    for (int left = 0; left < 3 && axes.row(k).isZero(); ++left)
      if (axes.col(left).isZero()) axes(k, left) = 1.0;
  return axes;
}

std::string LayoutFinder::all_names() const {
  std::vector<std::string> names;
  for (const Named& named : names_) names.push_back(named.name);
  return fmt::format("{}", fmt::join(names, ", "));
}

bool LayoutFinder::is_name(const std::string& text) const {
  return std::any_of(names_.begin(), names_.end(), [&](const Named& named) { return named.name == text; });
}

/// Columns of one meaning and group. If two of a group have the same axis, as x and X, or x [m] and x [px],
/// only columns whose names are alike except in the axis are together.
std::vector<std::vector<std::size_t>> LayoutFinder::groups_of(Means means) const {
  std::map<std::string, std::vector<std::size_t>> groups;
  for (std::size_t i = 0; i < names_.size(); ++i)
    if (names_[i].parts.means == means) groups[names_[i].parts.group].push_back(i);
  std::vector<std::vector<std::size_t>> parted;
  for (const auto& [group, columns] : groups) {
    std::map<std::string, std::vector<std::size_t>> alike;
    std::map<int, std::set<std::string>> names_of_axes;
    for (const std::size_t i : columns) {
      alike[names_[i].parts.shape].push_back(i);
      names_of_axes[names_[i].parts.axis].insert(names_[i].name);
    }
    const bool clash = std::any_of(names_of_axes.begin(), names_of_axes.end(),
                                   [](const auto& names) { return names.second.size() > 1; });
    if (!clash)
      parted.push_back(columns);
    else
      for (const auto& [shape, same] : alike) parted.push_back(same);
  }
  return parted;
}

/// None: they are numbered, and not the parts of a vector.
std::optional<LayoutFinder::Group> LayoutFinder::group_of(const std::vector<std::size_t>& columns) const {
  Group group;
  const ColumnName& first = names_[columns.front()].parts;
  group.rank = first.rank;
  for (const std::size_t i : columns) {
    int& index = group.axes[static_cast<std::size_t>(names_[i].parts.axis)];
    if (index < 0) index = static_cast<int>(i);
  }
  if (!first.numbered) return group;
  if (group.axes[0] < 0) std::rotate(group.axes.begin(), group.axes.begin() + 1, group.axes.end());
  const auto count = std::count_if(group.axes.begin(), group.axes.end(), [](int i) { return i >= 0; });
  const bool is_vector = count == 3 || (count == 2 && first.dotted);
  const bool is_of_six = count == 6 && group.has(6) && has_six_numbers(first.group);
  return is_vector || is_of_six ? std::optional(group) : std::nullopt;
}

std::size_t LayoutFinder::count_of(const std::string& name) const {
  return static_cast<std::size_t>(
      std::count_if(names_.begin(), names_.end(), [&](const Named& named) { return named.name == name; }));
}

void LayoutFinder::check_only_one(const std::string& name, const std::string& key) const {
  std::vector<std::size_t> numbers;
  for (std::size_t i = 0; i < names_.size(); ++i)
    if (names_[i].name == name) numbers.push_back(i + 1);
  if (numbers.size() > 1)
    throw_input_error(
        "{}: {} columns are named '{}', which are the numbers {}; give each its own name, or choose columns "
        "by "
        "their numbers{}",
        location_, numbers.size(), name, fmt::join(numbers, " and "),
        key.empty() ? "" : " with " + option_and_key(key));
}

}  // namespace sandstroke
