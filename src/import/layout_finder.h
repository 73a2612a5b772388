#pragma once

#include <Eigen/Core>
#include <initializer_list>
#include <optional>
#include <string>
#include <vector>

#include "import/column_name.h"
#include "import/sample_table.h"
#include "import/table_layout.h"

namespace sandstroke {

/// Finds columns of a table by what settings name, or by what names mean. The errors of all functions are
/// those of input; they name the columns' `location`.
class LayoutFinder {
 public:
  LayoutFinder(const std::vector<SampleColumn>& columns, const std::string& location);

  /// The columns of a list that the settings name under a key; as many as one of `counts`.
  ColumnChoices named(const std::string& list, const char* key,
                      std::initializer_list<std::size_t> counts) const;
  /// One column by its name, by its name without the unit, or by its number.
  std::size_t one(const std::string& wanted) const;
  /// One column, with - in front if its sign changes.
  ColumnChoice signed_one(const std::string& wanted) const;

  /// The plainest group of columns whose names differ in the axis, with its first `least` axes; all of its
  /// first `most` axes, if it has those. Empty: there is no such group. Error: two groups are equally plain,
  /// or a flat position is plainer than one in space or in another unit.
  /// With `doubts`, these are noted there instead, and there is no such group.
  ColumnChoices found(ColumnName::Means means, int least, int most,
                      std::vector<std::string>* doubts = nullptr) const;
  /// The first of the plainest columns. A warning names another that is as plain, and the key that chooses.
  /// Error: two have the same name.
  std::optional<std::size_t> found_one(ColumnName::Means means, const std::string& key,
                                       std::vector<std::string>& warnings) const;
  /// The first of the plainest columns.
  std::optional<std::size_t> found_one(ColumnName::Means means) const;
  /// A column of z that no other axis goes with: "pos_z" beside x and y.
  std::optional<std::size_t> lone_height() const;
  /// The plainest columns that mean one of these, two at most.
  std::vector<std::size_t> first_two(std::initializer_list<ColumnName::Means> means) const;

  struct Time {
    std::optional<std::size_t> column, fraction;
  };
  /// The plainest time, and the column with the fractions of its seconds, whatever rivals it has.
  Time plainest_time() const;
  /// The same. Warnings name rivals; key: the setting that chooses.
  Time found_time(const std::string& key, std::vector<std::string>& warnings) const;
  /// The time that the settings name: one column, or "sec,nanosec".
  Time named_time(const std::string& wanted) const;

  /// Rows: the axes of these columns by name, else by their order in the table. With two columns, the third
  /// row is the axis that is left.
  Eigen::Matrix3d axes_of(const ColumnChoices& choices) const;

  /// True if the pen is up where the column is not 0, by its name.
  bool is_pen_up(std::size_t column) const;
  std::string all_names() const;

 private:
  struct Named {
    std::string name, unit;  // the column's own unit, or that in its name
    ColumnName parts;
    // Of its values, if they are known: one is a second at least, though they count ms; one is not whole.
    bool reaches_second, has_fractions;
  };
  struct Group;
  /// Error: another group has a height that the plainest lacks, or another unit.
  void check_not_flat(const Group& plainest, const std::vector<Group>& others) const;

  bool is_name(const std::string& text) const;
  std::size_t count_of(const std::string& name) const;
  std::vector<std::vector<std::size_t>> groups_of(ColumnName::Means means) const;
  std::optional<Group> group_of(const std::vector<std::size_t>& columns) const;
  /// Error: several columns have this name. key: the setting that chooses by numbers; empty: it just did.
  void check_only_one(const std::string& name, const std::string& key) const;

  std::string location_;
  std::vector<Named> names_;
};

}  // namespace sandstroke
