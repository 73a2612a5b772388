#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include <toml++/toml.h>

#include "core/range.h"

namespace sandstroke {

/// Text, such as a file's name, as a TOML string. TOML's basic strings escape as JSON's do. Error: input, if
/// it is not UTF-8.
std::string toml_string(const std::string& text);

/// "above 0 and below 90"; empty for any number.
std::string range_text(Range range);

/// One table of a TOML file, read key by key. Errors name file, line, key, value and remedy (Error: input).
/// Keys that nobody reads are errors, too: call reject_unread() last. Keys may be dotted ("bed.cells"), and
/// name a table of a list by its place, counted from 1 ("stone.1.radius").
/// Copies share the document.
class TomlReader {
 public:
  static TomlReader from_file(const std::filesystem::path& path);
  static TomlReader from_text(std::string_view text, const std::string& name);

  /// Sets one key from "key=value" (--set), or takes one out by "!key" (--unset). The value is TOML, or else
  /// a string.
  void override_with(const std::string& assignment);
  const std::string& name() const;  ///< of the file
  /// The assignments of keys that a sentence names, as "--set key=value, --set ..."; empty: none.
  std::string overrides_in(std::string_view sentence) const;

  bool has(std::string_view key) const;
  /// Passes over a key that has no meaning any more, whatever its value.
  void skip(std::string_view key) const;

  // Each returns the fallback if the key is absent. unit: the unit of the numbers, for the error if somebody
  // writes one behind a number; empty: none.
  double number(std::string_view key, double fallback, Range range = any_number,
                std::string_view unit = "") const;
  int integer(std::string_view key, int fallback, int lowest, int highest) const;
  bool boolean(std::string_view key, bool fallback) const;
  std::string text(std::string_view key, const std::string& fallback) const;
  /// Exactly `fallback.size()` numbers.
  std::vector<double> numbers(std::string_view key, const std::vector<double>& fallback,
                              Range range = any_number, std::string_view unit = "") const;
  /// One number or an array of at least one.
  std::vector<double> profile(std::string_view key, const std::vector<double>& fallback,
                              Range range = any_number, std::string_view unit = "") const;
  /// An array of points with two coordinates each ([[x, y], ...]); empty where absent.
  std::vector<std::vector<double>> points(std::string_view key) const;
  /// One of the names; returns its index.
  int choice(std::string_view key, int fallback, const std::vector<std::string>& names) const;
  /// An array of strings.
  std::vector<std::string> texts(std::string_view key, const std::vector<std::string>& fallback) const;
  /// The dotted keys of all values in table `key` (empty: in the file), whatever their names, relative to
  /// the table and in the order of the file. A table that holds one of the keys `leaves` counts as a value.
  std::vector<std::string> keys_in(std::string_view key, const std::vector<std::string>& leaves = {}) const;
  /// A value as TOML text, on one line. literals(): each element of an array.
  std::string literal(std::string_view key) const;
  std::vector<std::string> literals(std::string_view key) const;
  bool is_table(std::string_view key) const;
  /// The tables of [[key]], in order.
  std::vector<TomlReader> tables(std::string_view key) const;

  /// The number of tables of [[key]]. Keys in them are named by their places ("stone.1.radius").
  int count_tables(std::string_view key) const;

  void require(std::string_view key) const;
  /// Throws for the first key in the whole document that no call above has read. conditions: where keys apply
  /// that are not always read ("bed.surface.kind is noise"), by their names. leave_out: gets such a key and
  /// where it applies; true if it shall be passed over.
  using Conditions = std::function<std::map<std::string, std::string>()>;
  using LeaveOut = std::function<bool(const std::string& key, const std::string& condition)>;
  void reject_unread(const Conditions& conditions = {}, const LeaveOut& leave_out = {}) const;

  /// Throws an Error: file, line of the key, key, then the sentence.
  [[noreturn]] void fail(std::string_view key, const std::string& sentence) const;

 private:
  struct Document;
  TomlReader(std::shared_ptr<Document> document, toml::table* table, std::string prefix);
  const toml::node* find(std::string_view key) const;
  void take_out(const std::string& key);
  [[noreturn]] void fail_in_list(const std::string& assignment, const std::string& list,
                                 const std::string& place, std::size_t tables, bool found) const;
  /// The "--set ..." that gave a key, its table or what is in it; empty: none.
  std::string override_of(const std::string& key) const;
  double checked(std::string_view key, const toml::node& node, Range range, std::string_view unit = "") const;

  std::shared_ptr<Document> document_;
  toml::table* table_;
  std::string prefix_;  // this table's own dotted name with a trailing dot, for messages
};

}  // namespace sandstroke
