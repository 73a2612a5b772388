#include "import/array_budget.h"

#include <utility>

#include "core/error.h"
#include "core/input_file.h"
#include "core/machine.h"
#include "hdf5/hdf5_storage.h"

namespace sandstroke {
namespace {

constexpr const char* save_less = "save fewer samples, or only the columns of the stroke";

}  // namespace

std::string whole_file(const std::filesystem::path& path) {
  InputFile file(path);
  const std::uintmax_t size = std::filesystem::file_size(path);
  check_memory(2.0 * static_cast<double>(size), fmt::format("{}: reading it", path.string()), save_less);
  std::string bytes(size, '\0');
  bytes.resize(file.read(bytes.data(), bytes.size()));
  return bytes;
}

ArrayBudget::ArrayBudget(std::string file, double file_bytes)
    : file_(std::move(file)), left_(most_unpacked(file_bytes)) {}

void ArrayBudget::take(const std::string& array, double numbers) {
  const double bytes = numbers * sizeof(double);
  if (!(bytes <= left_))
    throw_input_error("{}: claims {:.0f} numbers in {}, more than it can hold; it is damaged: save it again",
                      file_, numbers, array);
  left_ -= bytes;
  constexpr double much = 1e7;  // less than this is not worth asking the system
  if (bytes > much) check_memory(bytes, fmt::format("{}: reading {}", file_, array), save_less);
}

}  // namespace sandstroke
