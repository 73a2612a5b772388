#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace sandstroke {

[[noreturn]] void refuse_state(std::string_view name);

/// Numbers, and what lies in memory as a row of them. No structures: these may have gaps.
template <class T>
inline constexpr bool is_plain = std::is_arithmetic_v<T> || std::is_enum_v<T>;
template <class Scalar, int rows, int cols, int options>
inline constexpr bool is_plain<Eigen::Matrix<Scalar, rows, cols, options>> =
    rows != Eigen::Dynamic&& cols != Eigen::Dynamic;
template <class T, std::size_t count>
inline constexpr bool is_plain<std::array<T, count>> = is_plain<T>;

/// Shows the state of an object to be kept, or puts a kept one back. Classes with a state have visit_state(),
/// which calls value() or list() for each field that later ticks depend on, always in the same order. Numbers
/// are kept as they lie in memory.
class StateVisitor {
 public:
  virtual ~StateVisitor() = default;
  /// Whether the fields are put back.
  virtual bool restores() const = 0;

  template <class T>
  void value(std::string_view name, T& field) {
    if constexpr (is_plain<T>)
      memory(name, &field, sizeof(T));
    else
      field.visit_state(*this);
  }
  void value(std::string_view name, std::string& text) {
    std::uint64_t count = text.size();
    value(name, count);
    text.resize(checked(name, count, 1));
    memory(name, text.data(), count);
  }
  template <class T>
  void value(std::string_view name, std::optional<T>& field) {
    bool known = field.has_value();
    value(name, known);
    if (!known) return field.reset();
    if (!field) field.emplace();
    value(name, *field);
  }
  template <class T, class Allocator>
  void list(std::string_view name, std::vector<T, Allocator>& fields) {
    std::uint64_t count = fields.size();
    value(name, count);
    fields.resize(checked(name, count, is_plain<T> ? sizeof(T) : 1));
    if constexpr (is_plain<T>)
      memory(name, fields.data(), count * sizeof(T));
    else
      for (T& field : fields) value(name, field);
  }
  /// A list whose size follows from the scene. Error: input, where a kept one has another size.
  template <class T, class Allocator>
  void row(std::string_view name, std::vector<T, Allocator>& fields) {
    const std::size_t count = fields.size();
    list(name, fields);
    if (fields.size() != count) refuse_state(name);
  }
  /// What follows from the scene and its files. Error: input, where a kept one is another.
  template <class T>
  void same(std::string_view name, const T& field) {
    T kept = field;
    if constexpr (is_plain<T> || std::is_same_v<T, std::string>)
      value(name, kept);
    else
      list(name, kept);
    if (kept != field) refuse_state(name);
  }

 protected:
  virtual void memory(std::string_view name, void* bytes, std::size_t size) = 0;
  /// The count, unless fields of this size cannot be so many.
  virtual std::size_t checked(std::string_view name, std::uint64_t count, std::size_t size) const = 0;
};

/// Keeps a state as bytes.
class StateKeeper : public StateVisitor {
 public:
  bool restores() const override { return false; }
  /// All that was visited, and its hash. Call it once.
  std::string kept() &&;

 private:
  void memory(std::string_view name, void* bytes, std::size_t size) override;
  std::size_t checked(std::string_view, std::uint64_t count, std::size_t) const override { return count; }
  std::string kept_;
};

/// Puts a state back. Error: input, where the state has another field.
class StateRestorer : public StateVisitor {
 public:
  /// kept: of a StateKeeper. name: for messages. Error: input, if it was cut off or changed since.
  explicit StateRestorer(std::string_view kept, std::string_view name = "the state");
  bool restores() const override { return true; }
  /// Error: input, if anything is left.
  void end() const;

 private:
  void memory(std::string_view name, void* bytes, std::size_t size) override;
  std::size_t checked(std::string_view name, std::uint64_t count, std::size_t size) const override;
  std::string_view kept_;  // what is still to be read
};

}  // namespace sandstroke
