#include "import/mat_level5.h"

#include <algorithm>
#include <optional>

#include "core/error.h"
#include "import/array_budget.h"
#include "import/inflate.h"

namespace sandstroke {
namespace {

constexpr std::size_t header_bytes = 128;
constexpr std::uint32_t matrix_element = 14, compressed_element = 15;           // kinds of elements
constexpr std::uint32_t struct_class = 2, double_class = 6, uint64_class = 15;  // classes of matrices
constexpr std::uint32_t complex_flag = 0x800;

/// How the numbers of an element are stored. None: they are no numbers.
std::optional<StoredType> number_type(std::uint32_t kind, bool big_endian) {
  using Kind = StoredType::Kind;
  switch (kind) {
    case 1:
      return StoredType{Kind::whole, 1, big_endian};
    case 2:
      return StoredType{Kind::natural, 1, big_endian};
    case 3:
      return StoredType{Kind::whole, 2, big_endian};
    case 4:
      return StoredType{Kind::natural, 2, big_endian};
    case 5:
      return StoredType{Kind::whole, 4, big_endian};
    case 6:
      return StoredType{Kind::natural, 4, big_endian};
    case 7:
      return StoredType{Kind::real, 4, big_endian};
    case 9:
      return StoredType{Kind::real, 8, big_endian};
    case 12:
      return StoredType{Kind::whole, 8, big_endian};
    case 13:
      return StoredType{Kind::natural, 8, big_endian};
    default:
      return {};
  }
}

class Level5Reader {
 public:
  Level5Reader(std::string_view bytes, const std::string& file)
      : file_(file),
        big_endian_(bytes[126] == 'M'),
        budget_(file, static_cast<double>(bytes.size())),
        rest_(bytes.substr(header_bytes)) {}

  std::vector<NamedArray> arrays() {
    while (rest_.size() >= 8) {  // some programs leave a few bytes at the end
      const Element element = cut_element(rest_);
      if (element.kind == matrix_element) take_matrix(element.data, "", 0);
      if (element.kind != compressed_element) continue;
      const std::optional<std::string> unpacked =
          inflated(element.data, Wrapping::zlib, budget_.bytes_left());
      if (!unpacked) refuse("has a compressed variable that cannot be unpacked");
      std::string_view inner = *unpacked;
      const Element one = cut_element(inner);
      if (one.kind == matrix_element) take_matrix(one.data, "", 0);
    }
    return std::move(arrays_);
  }

 private:
  struct Element {
    std::uint32_t kind = 0;
    std::string_view data;
  };

  [[noreturn]] void refuse(const std::string& what) const {
    throw_input_error("{}: {}; the file is damaged: save it again", file_, what);
  }

  std::uint32_t number(std::string_view bytes, std::size_t i) const {
    const StoredNumbers numbers{{StoredType::Kind::natural, 4, big_endian_}, bytes, 1, 1, 0, 4};
    return static_cast<std::uint32_t>(numbers.bits(0, i));
  }

  /// Cuts off an element. Short ones have their size and data in the eight bytes of the tag.
  Element cut_element(std::string_view& bytes) const {
    if (bytes.size() < 8) refuse("ends within a variable");
    const std::uint32_t first = number(bytes, 0);
    const bool is_short = first >> 16 != 0;
    const std::size_t size = is_short ? first >> 16 : number(bytes, 1), begin = is_short ? 4 : 8;
    if (size > bytes.size() - begin || (is_short && size > 4)) refuse("ends within a variable");
    const Element element{is_short ? first & 0xFFFF : first, bytes.substr(begin, size)};
    const std::size_t used = begin + size, padded = (used + 7) / 8 * 8;
    bytes.remove_prefix(std::min(element.kind == compressed_element ? used : padded, bytes.size()));
    return element;
  }

  /// A matrix: flags with the class, sizes, name, and what the class has. Fields of structs have no name.
  void take_matrix(std::string_view bytes, const std::string& field_name, int depth) {
    if (bytes.empty()) return;  // a field without a value
    if (++seen_ > most_mat_variables)
      throw_input_error("{}: has more than {} variables; save only the variables of one stroke", file_,
                        most_mat_variables);
    const Element flags = cut_element(bytes);
    if (flags.data.size() < 8) refuse("has a variable without a class");
    const std::uint32_t word = number(flags.data, 0), type = word & 0xFF;
    if (type != struct_class && (type < double_class || type > uint64_class)) return;
    const std::string_view sizes = cut_element(bytes).data;
    const std::string_view own_name = cut_element(bytes).data;
    const std::string name = field_name.empty() ? std::string(own_name) : field_name;
    if (name.empty() || sizes.size() != 8) return;  // the file's own data; or not of two dimensions
    const std::size_t rows = number(sizes, 0), columns = number(sizes, 1);
    if (type == struct_class) {
      if (rows == 1 && columns == 1) take_fields(bytes, name, depth);
    } else if (!(word & complex_flag) && rows * columns > 1) {
      take_numbers(cut_element(bytes), name, rows, columns);
    }
  }

  void take_fields(std::string_view bytes, const std::string& name, int depth) {
    if (depth >= most_mat_depth)
      throw_input_error("{}: structs are nested deeper than {} in {}; save the struct of one stroke", file_,
                        most_mat_depth, name);
    const Element length = cut_element(bytes);
    std::string_view names = cut_element(bytes).data;
    const std::size_t longest = length.data.size() < 4 ? 0 : number(length.data, 0);
    if (longest == 0) return;  // no fields
    for (; names.size() >= longest; names.remove_prefix(longest)) {
      const std::string_view field = names.substr(0, std::min(names.find('\0'), longest));
      const Element value = cut_element(bytes);
      if (value.kind != matrix_element || field.empty())
        refuse(fmt::format("has struct {} with a wrong field", name));
      take_matrix(value.data, fmt::format("{}.{}", name, field), depth + 1);
    }
  }

  void take_numbers(const Element& element, const std::string& name, std::size_t rows, std::size_t columns) {
    const std::optional<StoredType> type = number_type(element.kind, big_endian_);
    if (!type || element.data.size() / type->bytes / rows < columns)
      refuse(fmt::format("variable {} of {} by {} is cut off", name, rows, columns));
    budget_.take(name, static_cast<double>(rows) * static_cast<double>(columns));
    arrays_.push_back(mat_array(name, *type, element.data, rows, columns));
  }

  std::string file_;
  bool big_endian_;
  ArrayBudget budget_;
  std::string_view rest_;
  std::size_t seen_ = 0;
  std::vector<NamedArray> arrays_;
};

}  // namespace

bool is_mat_level5(std::string_view bytes) {
  if (bytes.size() < header_bytes) return false;
  const std::string_view version = bytes.substr(124, 4);
  return version == std::string_view("\0\1IM", 4) || version == std::string_view("\1\0MI", 4);
}

std::vector<NamedArray> mat_level5_arrays(std::string_view bytes, const std::string& file) {
  return Level5Reader(bytes, file).arrays();
}

NamedArray mat_array(const std::string& name, StoredType type, std::string_view bytes, std::size_t rows,
                     std::size_t columns) {
  const std::size_t down = type.bytes, across = type.bytes * rows;
  return named_array(name, columns > rows ? StoredNumbers{type, bytes, columns, rows, across, down}
                                          : StoredNumbers{type, bytes, rows, columns, down, across});
}

}  // namespace sandstroke
