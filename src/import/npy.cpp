#include "import/npy.h"

#include <cstdint>
#include <limits>

#include "core/error.h"
#include "import/npy_header.h"

namespace sandstroke {
namespace {

/// The number of elements. Error: input, unless the bytes behind the header hold exactly so many.
std::size_t element_count(const NpyHeader& header, std::size_t data_bytes, const std::string& label) {
  double bytes = static_cast<double>(header.element_bytes);
  for (const std::size_t side : header.shape) bytes *= static_cast<double>(side);
  const auto there = static_cast<double>(data_bytes);
  if (bytes > there)
    throw_input_error("{}: is cut off: its header says {:.0f} bytes of numbers, but {} follow; save it again",
                      label, bytes, data_bytes);
  if (bytes < there)
    throw_input_error(
        "{}: has {:.0f} bytes more than its header says; save one array per file, or several with "
        "numpy.savez",
        label, there - bytes);
  return header.element_bytes == 0 ? 0 : data_bytes / header.element_bytes;
}

/// Makes times relative to the first date. NaT, which is the least number, becomes NaN.
void take_times(const StoredNumbers& numbers, bool is_date, SampleColumn& column) {
  column.origin.reset();
  for (std::size_t i = 0; i < numbers.samples; ++i) {
    const auto time = static_cast<std::int64_t>(numbers.bits(i, 0));
    const bool known = time != std::numeric_limits<std::int64_t>::min();
    if (known && is_date && !column.origin) column.origin = time;
    std::int64_t since = 0;
    const bool beyond = __builtin_sub_overflow(time, column.origin.value_or(0), &since);
    column.values[i] =
        known && !beyond ? static_cast<double>(since) : std::numeric_limits<double>::quiet_NaN();
  }
}

/// Makes columns of the elements' numbers.
class NpyColumns {
 public:
  NpyColumns(const NpyHeader& header, std::string_view data, const std::string& name, ArrayBudget& budget)
      : header_(header), data_(data), name_(name), budget_(budget) {}

  NamedArray of_fields(std::size_t samples) {
    NamedArray made{name_, samples, 0, {}};
    const std::size_t step = header_.element_bytes;
    for (const NpyField& field : header_.fields) {
      const std::string name = name_.empty() ? field.name : fmt::format("{}.{}", name_, field.name);
      for (std::size_t k = 0; k < field.count; ++k)
        made.columns.push_back(column(field, field.count == 1 ? name : fmt::format("{}.{}", name, k + 1),
                                      samples, field.offset + k * field.type.bytes, step));
    }
    made.width = made.columns.size();
    return made;
  }

  NamedArray of_rows(std::size_t rows, std::size_t columns) {
    NamedArray made{name_, rows, columns, {}};
    const std::size_t size = header_.element_bytes;
    const std::size_t down = header_.column_major ? size : size * columns;
    const std::size_t across = header_.column_major ? size * rows : size;
    const std::string prefix = name_.empty() ? "" : name_ + ".";
    for (std::size_t k = 0; k < columns && columns <= rows; ++k)
      made.columns.push_back(column(
          header_.fields.front(), columns == 1 && !name_.empty() ? name_ : fmt::format("{}{}", prefix, k + 1),
          rows, k * across, down));
    return made;
  }

 private:
  SampleColumn column(const NpyField& field, const std::string& name, std::size_t samples, std::size_t offset,
                      std::size_t step) {
    budget_.take(name, static_cast<double>(samples));
    const StoredNumbers numbers{field.type, data_.substr(offset), samples, 1, step, 0};
    SampleColumn made = std::move(named_array(name, numbers).columns.front());
    made.unit = field.unit;
    if (!field.unit.empty()) take_times(numbers, field.is_date, made);
    return made;
  }

  const NpyHeader& header_;
  std::string_view data_;
  const std::string& name_;
  ArrayBudget& budget_;
};

}  // namespace

NpyArray npy_array(std::string_view bytes, const std::string& name, const std::string& label,
                   ArrayBudget& budget) {
  const NpyHeader header = npy_header(bytes, label);
  if (header.has_objects)
    return {{},
            "holds Python objects, which are not read; save numbers: numpy.save('FILE', a.astype(float), "
            "allow_pickle=False)"};
  const std::string_view data = bytes.substr(header.bytes);
  const std::size_t count = element_count(header, data.size(), label);
  if (header.fields.empty() || count == 0)
    return {{}, "has no real numbers of at most 8 bytes; save some: numpy.save('FILE', a.astype(float))"};
  const bool has_names = !header.fields.front().name.empty();
  std::vector<std::size_t> shape = header.shape;
  if (has_names) std::erase(shape, std::size_t{1});  // samples may lie along any side
  if (shape.size() > (has_names ? 1 : 2))
    return {{},
            fmt::format("has {} dimensions, but each row of a table must be a sample; save it so: "
                        "numpy.save('FILE', a.reshape(len(a), -1))",
                        header.shape.size())};
  NpyColumns columns(header, data, name, budget);
  if (has_names) return {columns.of_fields(count), ""};
  if (count == 1) return {{}, "is a single number; save one row per sample"};
  return {columns.of_rows(shape[0], shape.size() == 2 ? shape[1] : 1), ""};
}

SampleTable read_npy(const std::filesystem::path& path) {
  const std::string bytes = whole_file(path);
  ArrayBudget budget(path.string(), static_cast<double>(bytes.size()));
  NpyArray read = npy_array(bytes, "", path.string(), budget);
  if (!read.why_not.empty()) throw_input_error("{}: {}", path.string(), read.why_not);
  constexpr ArrayWords words = {"NumPy file", "array", "", "numpy.save('FILE', a.T)"};
  return table_of_arrays({std::move(read.array)}, "", path.string(), words);
}

}  // namespace sandstroke
