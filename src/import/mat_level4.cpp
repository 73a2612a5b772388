#include "import/mat_level4.h"

#include <array>
#include <optional>

#include "core/error.h"
#include "import/array_budget.h"
#include "import/mat_level5.h"

namespace sandstroke {
namespace {

/// The beginning of a variable.
struct Head {
  static constexpr std::size_t bytes = 20;
  bool big_endian = false, is_text = false, is_sparse = false, is_complex = false;
  StoredType type;
  std::uint64_t rows = 0, columns = 0, name_bytes = 0;
};

/// None: these are not the first bytes of a variable.
std::optional<Head> head_of_variable(std::string_view bytes) {
  using Kind = StoredType::Kind;
  constexpr std::array types = {StoredType{Kind::real, 8},    StoredType{Kind::real, 4},
                                StoredType{Kind::whole, 4},   StoredType{Kind::whole, 2},
                                StoredType{Kind::natural, 2}, StoredType{Kind::natural, 1}};
  if (bytes.size() < Head::bytes) return {};
  for (const bool big_endian : {false, true}) {
    const StoredNumbers words{{Kind::natural, 4, big_endian}, bytes, 1, 5, 0, 4};
    // The digits of the first number: byte order, 0, kind of numbers, kind of matrix.
    const std::uint64_t kind = words.bits(0, 0);
    const std::uint64_t order = kind / 1000, zero = kind / 100 % 10, number = kind / 10 % 10, of = kind % 10;
    if (order != (big_endian ? 1u : 0u) || zero != 0 || number >= types.size() || of > 2) continue;
    Head head{big_endian,    of == 1,          of == 2,          words.bits(0, 3) != 0,
              types[number], words.bits(0, 1), words.bits(0, 2), words.bits(0, 4)};
    head.type.big_endian = big_endian;
    constexpr std::uint64_t longest_name = 4096, most_rows = std::uint64_t{1} << 31;
    if (words.bits(0, 3) > 1 || head.name_bytes < 2 || head.name_bytes > longest_name ||
        head.rows >= most_rows || head.columns >= most_rows)
      continue;
    return head;
  }
  return {};
}

}  // namespace

bool is_mat_level4(std::string_view bytes) { return head_of_variable(bytes).has_value(); }

std::vector<NamedArray> mat_level4_arrays(std::string_view bytes, const std::string& file) {
  ArrayBudget budget(file, static_cast<double>(bytes.size()));
  std::vector<NamedArray> arrays;
  std::size_t seen = 0;
  while (!bytes.empty()) {
    const std::optional<Head> head = head_of_variable(bytes);
    ++seen;
    if (!head || seen > most_mat_variables)
      throw_input_error("{}: variable {} cannot be read; the file is damaged: save it again", file, seen);
    bytes.remove_prefix(Head::bytes);
    const std::string name(bytes.substr(0, bytes.substr(0, head->name_bytes).find('\0')));
    const std::uint64_t count = head->rows * head->columns;  // each below 2^31
    const std::uint64_t number_bytes = head->type.bytes * (head->is_complex ? 2 : 1);
    if (head->name_bytes > bytes.size() || count > (bytes.size() - head->name_bytes) / number_bytes)
      throw_input_error("{}: variable {} of {} by {} is cut off; the file is damaged: save it again", file,
                        name, head->rows, head->columns);
    bytes.remove_prefix(head->name_bytes);
    const bool is_read = !head->is_text && !head->is_sparse && !head->is_complex && count > 1;
    if (is_read) {
      budget.take(name, static_cast<double>(count));
      arrays.push_back(mat_array(name, head->type, bytes, head->rows, head->columns));
    }
    bytes.remove_prefix(count * number_bytes);
  }
  return arrays;
}

}  // namespace sandstroke
