#include "import/table_layout.h"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <charconv>
#include <map>
#include <set>

#include "core/error.h"
#include "import/column_name.h"

namespace sandstroke {
namespace {

using Means = ColumnName::Means;

struct Named {
  std::string name;
  ColumnName parts;
};

/// Columns of one meaning whose names differ only in the axis: indices by axis, -1 if there is none.
struct Group {
  int rank = 0;
  std::array<int, 9> axes{-1, -1, -1, -1, -1, -1, -1, -1, -1};
  bool numbered = false;
  bool has(int count) const {
    return std::none_of(axes.begin(), axes.begin() + count, [](int index) { return index < 0; });
  }
};

class LayoutFinder {
 public:
  LayoutFinder(const std::vector<SampleColumn>& columns, const std::string& location) : location_(location) {
    for (const SampleColumn& column : columns) names_.push_back({column.name, column_name(column.name)});
  }

  ColumnChoices named(const std::string& list, const char* key,
                      std::initializer_list<std::size_t> counts) const {
    ColumnChoices choices;
    for (const std::string& wanted : parts_of_list(list)) choices.push_back(find(wanted));
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

  std::size_t one(const std::string& wanted) const { return find_column(wanted); }

  /// Of two groups that are equally plain the first is taken, or they are refused.
  enum class Ties { first, refused };

  /// The plainest group that has its first `least` axes; all of its first `most` axes, if it has those.
  /// Empty: there is no such group.
  ColumnChoices found(Means means, int least, int most, Ties ties = Ties::first) const {
    std::map<std::string, Group> groups;
    for (std::size_t i = 0; i < names_.size(); ++i) {
      const ColumnName& parts = names_[i].parts;
      if (parts.means != means) continue;
      Group& group = groups[parts.group];
      group.rank = parts.rank;
      group.numbered = parts.numbered;
      int& index = group.axes[static_cast<std::size_t>(parts.axis)];
      if (index < 0) index = static_cast<int>(i);
    }
    std::vector<const Group*> plainest;
    for (const auto& [name, group] : groups) {
      if (!group.has(least) || (group.numbered && group.has(4))) continue;  // wider than a vector
      if (!plainest.empty() && group.rank > plainest.front()->rank) continue;
      if (!plainest.empty() && group.rank < plainest.front()->rank) plainest.clear();
      plainest.push_back(&group);
    }
    if (plainest.empty()) return {};
    if (ties == Ties::refused && plainest.size() > 1)
      throw_input_error("{}: columns '{}' and '{}' may both be the position; name its columns with {}",
                        location_, name_of(*plainest[0]), name_of(*plainest[1]), option_and_key("position"));
    ColumnChoices choices;
    const Group& group = *plainest.front();
    for (int axis = 0; axis < (group.has(most) ? most : least); ++axis) {
      const auto index = static_cast<std::size_t>(group.axes[static_cast<std::size_t>(axis)]);
      check_only_one(names_[index].name);
      choices.push_back({index, 1.0});
    }
    return choices;
  }

  std::optional<std::size_t> found_one(Means means) const {
    std::optional<std::size_t> best;
    for (std::size_t i = 0; i < names_.size(); ++i) {
      if (names_[i].parts.means != means) continue;
      if (!best || names_[i].parts.rank < names_[*best].parts.rank) best = i;
    }
    return best;
  }

  /// Rows: the axes of these columns by name, else by their order in the table. With two columns, the third
  /// row is the axis that is left.
  Eigen::Matrix3d axes_of(const ColumnChoices& choices) const {
    std::vector<int> axis;
    for (const ColumnChoice& choice : choices) axis.push_back(names_[choice.column].parts.axis);
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

  std::string all_names() const {
    std::vector<std::string> names;
    for (const Named& named : names_) names.push_back(named.name);
    return fmt::format("{}", fmt::join(names, ", "));
  }

 private:
  static std::vector<int> order_of(const ColumnChoices& choices) {
    std::vector<int> order;
    for (const ColumnChoice& choice : choices)
      order.push_back(
          static_cast<int>(std::count_if(choices.begin(), choices.end(), [&](const ColumnChoice& other) {
            return other.column < choice.column;
          })));
    return order;
  }

  ColumnChoice find(const std::string& wanted) const {
    const bool is_name =
        std::any_of(names_.begin(), names_.end(), [&](const Named& n) { return n.name == wanted; });
    if (!is_name && wanted.size() > 1 && (wanted[0] == '-' || wanted[0] == '+'))
      return {find_column(wanted.substr(1)), wanted[0] == '-' ? -1.0 : 1.0};
    return {find_column(wanted), 1.0};
  }

  /// Finds a column by its name, by its name without the unit, or by its number.
  std::size_t find_column(const std::string& wanted) const {
    check_only_one(wanted);
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

  void check_only_one(const std::string& name) const {
    const auto count =
        std::count_if(names_.begin(), names_.end(), [&](const Named& other) { return other.name == name; });
    if (count > 1)
      throw_input_error("{}: {} columns are named '{}'; give each its own name", location_, count, name);
  }

  const std::string& name_of(const Group& group) const {
    return names_[static_cast<std::size_t>(group.axes[0])].name;
  }

  std::string location_;
  std::vector<Named> names_;
};

/// Turns found columns, which are in the table's axes, as the position's columns are turned.
ColumnChoices along(const ColumnChoices& found, const Eigen::Matrix3d& axes) {
  ColumnChoices turned = found;
  for (std::size_t k = 0; k < found.size(); ++k)
    for (std::size_t axis = 0; axis < found.size(); ++axis)
      if (const double sign = axes(static_cast<int>(k), static_cast<int>(axis)); sign != 0.0)
        turned[k] = {found[axis].column, sign};
  return turned;
}

}  // namespace

std::string option_of(const std::string& key) {
  std::string option = "--" + key;
  std::replace(option.begin(), option.end(), '_', '-');
  return option;
}

std::string option_and_key(const std::string& key) {
  return fmt::format("stroke.table.{} (stroke convert: {})", key, option_of(key));
}

TableLayout table_layout(const std::vector<SampleColumn>& columns, const TableSettings& settings,
                         const std::string& location, const std::optional<Eigen::Matrix3d>& of_first) {
  const LayoutFinder finder(columns, location);
  TableLayout layout;
  if (!settings.position.empty()) {
    layout.position = finder.named(settings.position, "position", {2, 3});
  } else if (!of_first) {
    layout.position = finder.found(Means::position, 2, 3, LayoutFinder::Ties::refused);
    if (layout.position.empty())
      throw_input_error(
          "{}: no columns are named x, y and z; give the names or numbers of the position's columns with {}; "
          "the columns are: {}",
          location, option_and_key("position"), finder.all_names());
  }
  layout.axes = of_first ? *of_first : finder.axes_of(layout.position);
  const auto vector = [&](const std::string& list, const char* key, Means means) {
    if (is_none(list)) return ColumnChoices();
    return list.empty() ? along(finder.found(means, 2, 3), layout.axes) : finder.named(list, key, {2, 3});
  };
  layout.velocity = vector(settings.velocity, "velocity", Means::velocity);
  layout.force = vector(settings.force, "force", Means::force);
  if (!settings.orientation.empty() && !is_none(settings.orientation)) {
    layout.orientation = finder.named(settings.orientation, "orientation", {4, 9});
  } else if (settings.orientation.empty()) {
    layout.orientation = finder.found(Means::orientation, 4, 4);
    if (layout.orientation.empty()) layout.orientation = finder.found(Means::matrix, 9, 9);
  }
  if (!is_none(settings.pressure))
    layout.pressure =
        settings.pressure.empty() ? finder.found_one(Means::pressure) : finder.one(settings.pressure);
  const bool replaced = settings.time.empty() && (settings.rate > 0.0 || settings.speed > 0.0);
  (replaced ? layout.replaced_time : layout.time) =
      settings.time.empty() ? finder.found_one(Means::time) : finder.one(settings.time);
  layout.sample_number = finder.found_one(Means::number);
  return layout;
}

}  // namespace sandstroke
