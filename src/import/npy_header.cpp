#include "import/npy_header.h"

#include <algorithm>
#include <charconv>
#include <limits>
#include <optional>

#include "core/error.h"

namespace sandstroke {
namespace {

constexpr std::size_t most_header_bytes = 1'000'000;
constexpr std::size_t most_fields = 10'000;        // of an element, counting each number and each group
constexpr std::size_t longest_field_name = 1'000;  // each number of a field has a copy
constexpr int most_npy_depth = 16;

/// A value of Python: a text, a number, a list or tuple; of a dictionary, keys and values in turn.
struct PythonValue {
  enum class Kind { text, number, word, list } kind = Kind::word;
  std::string text;  // also of a word: True
  std::size_t number = 0;
  std::vector<PythonValue> items;
};

/// Reads the literals of which headers consist. None: the text is something else.
class PythonReader {
 public:
  explicit PythonReader(std::string_view text) : rest_(text) {}

  std::optional<PythonValue> value(int depth = 0) {
    skip_blanks();
    if (rest_.empty() || depth > most_npy_depth) return {};
    const char first = rest_.front();
    if (first == '\'' || first == '"') return text();
    if (first == '(') return list(')', depth);
    if (first == '[') return list(']', depth);
    if (first == '{') return list('}', depth);
    return first >= '0' && first <= '9' ? number() : word();
  }

 private:
  void skip_blanks() { rest_.remove_prefix(std::min(rest_.find_first_not_of(" \n\t"), rest_.size())); }
  bool skip(char wanted) {
    skip_blanks();
    if (!rest_.starts_with(wanted)) return false;
    rest_.remove_prefix(1);
    return true;
  }

  std::optional<PythonValue> text() {
    const std::size_t end = rest_.find(rest_.front(), 1);
    if (end == std::string_view::npos) return {};
    PythonValue made{PythonValue::Kind::text, std::string(rest_.substr(1, end - 1)), 0, {}};
    rest_.remove_prefix(end + 1);
    return made;
  }
  std::optional<PythonValue> number() {
    PythonValue made{PythonValue::Kind::number, "", 0, {}};
    const auto [end, failure] = std::from_chars(rest_.data(), rest_.data() + rest_.size(), made.number);
    if (failure != std::errc()) return {};
    rest_.remove_prefix(static_cast<std::size_t>(end - rest_.data()));
    if (rest_.starts_with('L')) rest_.remove_prefix(1);  // as Python 2 wrote it
    return made;
  }
  std::optional<PythonValue> word() {
    const std::size_t end = std::min(rest_.find_first_of(" ,:)]}\n"), rest_.size());
    PythonValue made{PythonValue::Kind::word, std::string(rest_.substr(0, end)), 0, {}};
    rest_.remove_prefix(end);
    return made;
  }
  std::optional<PythonValue> list(char end, int depth) {
    PythonValue made{PythonValue::Kind::list, "", 0, {}};
    rest_.remove_prefix(1);
    while (!skip(end)) {
      std::optional<PythonValue> item = value(depth + 1);
      if (!item) return {};
      made.items.push_back(std::move(*item));
      if (!skip(',') && !skip(':') && !(skip_blanks(), rest_.starts_with(end))) return {};
    }
    return made;
  }

  std::string_view rest_;
};

/// Lays out the fields of an element, one after the other.
class Fields {
 public:
  explicit Fields(NpyHeader& header, const std::string& name) : header_(header), name_(name) {}

  void take(const PythonValue& descr, const std::string& field, std::size_t count, int depth = 0) {
    // Counts fields without bytes, too: a short header can repeat them without end.
    if (count > most_fields || (taken_ += std::max<std::size_t>(count, 1)) > most_fields) refuse();
    if (descr.kind == PythonValue::Kind::text) return take_type(descr.text, field, count);
    if (descr.kind != PythonValue::Kind::list || depth > most_npy_depth) refuse();
    for (std::size_t i = 0; i < count; ++i) {
      const std::string around = count > 1 ? fmt::format("{}.{}", field, i + 1) : field;
      for (const PythonValue& item : descr.items) take_field(item, around, depth);
    }
  }

 private:
  [[noreturn]] void refuse() const {
    throw_input_error("{}: has a damaged header; save the array again: numpy.save", name_);
  }

  /// (name, type), (name, type, shape) or (name, type, number); a name may be (title, name).
  void take_field(const PythonValue& item, const std::string& around, int depth) {
    if (item.items.size() < 2 || item.items.size() > 3) refuse();
    const PythonValue& named = item.items[0];
    const bool titled = named.items.size() == 2;
    const std::string name = titled ? named.items[1].text : named.text;
    if (name.size() > longest_field_name) refuse();
    std::size_t count = 1;
    if (item.items.size() == 3) {
      const PythonValue& shape = item.items[2];
      if (shape.kind == PythonValue::Kind::number) count = shape.number;
      for (const PythonValue& side : shape.items) {
        if (side.number > most_fields || (count *= side.number) > most_fields) refuse();
      }
    }
    take(item.items[1], around.empty() ? name : fmt::format("{}.{}", around, name), count, depth + 1);
  }

  /// A type as NumPy writes it: byte order, kind, bytes, and the unit of a time: "<f8", "|b1", "<M8[ns]".
  void take_type(std::string_view type, const std::string& field, std::size_t count) {
    if (type.size() < 2 || std::string_view("<>|=").find(type[0]) == std::string_view::npos) refuse();
    const char kind = type[1];
    std::size_t size = 0;
    const auto [end, failure] = std::from_chars(type.data() + 2, type.data() + type.size(), size);
    header_.has_objects = header_.has_objects || kind == 'O';
    constexpr std::size_t most = std::size_t{1} << 31;
    if (kind == 'O') size = 8;
    if ((failure != std::errc() && kind != 'O') || size > most) refuse();
    if (kind == 'U') size *= 4;
    NpyField made{field, {StoredType::Kind::real, size, type[0] == '>'}, header_.element_bytes, count, ""};
    header_.element_bytes += size * count;
    if (header_.element_bytes > most) refuse();
    if (is_number(kind, std::string_view(end, type.data() + type.size()), made) && count > 0)
      header_.fields.push_back(std::move(made));
  }

  static bool is_number(char kind, std::string_view unit, NpyField& field) {
    const std::size_t size = field.type.bytes;
    const bool is_whole_size = size == 1 || size == 2 || size == 4 || size == 8;
    if (kind == 'f') return size == 2 || size == 4 || size == 8;
    field.type.kind = kind == 'i' ? StoredType::Kind::whole : StoredType::Kind::natural;
    field.is_truth = kind == 'b';
    if (kind == 'i' || kind == 'u' || (field.is_truth && size == 1)) return is_whole_size;
    if ((kind != 'M' && kind != 'm') || size != 8) return false;
    field.type.kind = StoredType::Kind::whole;
    field.is_date = kind == 'M';
    for (const char* known : {"s", "ms", "us", "ns"})
      if (unit == fmt::format("[{}]", known)) field.unit = known;
    return !field.unit.empty();
  }

  NpyHeader& header_;
  const std::string& name_;
  std::size_t taken_ = 0;  // fields, numbers and groups
};

const PythonValue* entry(const PythonValue& dictionary, std::string_view key) {
  for (std::size_t i = 0; i + 1 < dictionary.items.size(); i += 2)
    if (dictionary.items[i].text == key) return &dictionary.items[i + 1];
  return nullptr;
}

/// The text of the header, and where it ends. Empty: the bytes are cut off or no array.
std::string_view header_text(std::string_view bytes, NpyHeader& header) {
  constexpr std::string_view magic = "\x93NUMPY";
  if (!bytes.starts_with(magic) || bytes.size() < 12) return {};
  const int version = bytes[6];
  if (version < 1 || version > 3) return {};
  const StoredType length_type{StoredType::Kind::natural, version == 1 ? 2u : 4u, false};
  const std::size_t begin = 8 + length_type.bytes;
  const std::size_t length = StoredNumbers{length_type, bytes.substr(8), 1, 1, 0, 0}.bits(0, 0);
  if (length > most_header_bytes || length > bytes.size() - begin) return {};
  header.bytes = begin + length;
  return bytes.substr(begin, length);
}

}  // namespace

NpyHeader npy_header(std::string_view bytes, const std::string& name) {
  NpyHeader header;
  const std::optional<PythonValue> said = PythonReader(header_text(bytes, header)).value();
  const PythonValue* const descr = said ? entry(*said, "descr") : nullptr;
  const PythonValue* const order = said ? entry(*said, "fortran_order") : nullptr;
  const PythonValue* const shape = said ? entry(*said, "shape") : nullptr;
  const auto is_side = [](const PythonValue& side) {
    return side.kind == PythonValue::Kind::number && side.number <= std::numeric_limits<std::uint32_t>::max();
  };
  if (!descr || !order || !shape || (order->text != "True" && order->text != "False") ||
      shape->kind != PythonValue::Kind::list ||
      !std::all_of(shape->items.begin(), shape->items.end(), is_side))
    throw_input_error("{}: has a damaged or unknown header; save the array again: numpy.save", name);
  header.column_major = order->text == "True";
  for (const PythonValue& side : shape->items) header.shape.push_back(side.number);
  Fields(header, name).take(*descr, "", 1);
  return header;
}

}  // namespace sandstroke
