#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "core/range.h"

namespace sandstroke {

/// A visitor of a file's keys, one after the other: a reader sets the value, a writer prints it, a help page
/// explains it. The function that shows the keys is the only list of them. It does not show a key that means
/// nothing for the choices made (the radius of a flat surface), so a reader refuses that key.
class KeyVisitor {
 public:
  virtual ~KeyVisitor() = default;
  virtual void section(const char* name, const char* help) = 0;
  /// A section that may be absent: true if it is there.
  virtual bool optional_section(const char* name, bool present, const char* help) = 0;
  /// How many tables a list of them ([[name]]) has; `count` are there now.
  virtual int tables(const char* name, int count) = 0;
  /// The section of one table of a list, by its place, counted from 1.
  virtual void table(const char* list, int place, const char* help) = 0;
  /// True if the next key is given, for a key whose presence says more than its value. Help lists no default.
  virtual bool given(const char* key) = 0;
  /// The next key must be given.
  virtual void require(const char* key) = 0;
  virtual void number(const char* key, double& value, Range range, const char* unit, const char* help) = 0;
  virtual void numbers(const char* key, double* values, int count, Range range, const char* unit,
                       const char* help) = 0;
  /// One number or more.
  virtual void profile(const char* key, std::vector<double>& values, Range range, const char* unit,
                       const char* help) = 0;
  virtual void points(const char* key, std::vector<Eigen::Vector2d>& values, const char* unit,
                      const char* help) = 0;
  virtual void integers(const char* key, int* values, int count, int lowest, int highest,
                        const char* help) = 0;
  virtual void flag(const char* key, bool& value, const char* help) = 0;
  virtual void text(const char* key, std::string& value, const char* help) = 0;
  virtual void texts(const char* key, std::vector<std::string>& values, const char* help) = 0;
  /// value: an index into names.
  virtual void choice(const char* key, int& value, const std::vector<std::string>& names,
                      const char* help) = 0;
  /// True for a reader: a preset that was just read sets its values, and later keys override them.
  virtual bool reads() const = 0;
};

/// A choice whose values are an enum, counted from 0 in the order of the names.
template <class Enum>
void choose(KeyVisitor& visitor, const char* key, Enum& value, const std::vector<std::string>& names,
            const char* help) {
  int index = static_cast<int>(value);
  visitor.choice(key, index, names, help);
  value = static_cast<Enum>(index);
}

/// A number that counts where it is given.
inline void show_if_given(KeyVisitor& visitor, const char* key, std::optional<double>& value, Range range,
                          const char* unit, const char* help) {
  if (!(visitor.reads() ? visitor.given(key) : value.has_value())) return;
  double number = value.value_or(0.0);
  visitor.number(key, number, range, unit, help);
  value = number;
}

/// A list of tables ([[name]]) whose keys `show` shows: show(visitor, one of the settings).
template <class Settings, class Show>
void show_tables(KeyVisitor& visitor, const char* name, std::vector<Settings>& list, const char* help,
                 const Show& show) {
  list.resize(static_cast<std::size_t>(visitor.tables(name, static_cast<int>(list.size()))));
  int place = 0;
  for (Settings& settings : list) {
    visitor.table(name, ++place, help);
    show(visitor, settings);
  }
}

}  // namespace sandstroke
