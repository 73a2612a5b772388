#include "io/npy_map.h"

#include <cstring>
#include <string>
#include <vector>

#include "core/error.h"
#include "core/input_file.h"
#include "import/npy_header.h"

namespace sandstroke {
namespace {

class NpyMap : public HeightMap {
 public:
  explicit NpyMap(const std::filesystem::path& path) : name_(path.string()), file_(path) {
    head_.resize(std::size_t{1} << 20);  // longer than any header
    head_.resize(file_.read(head_.data(), head_.size()));
    const NpyHeader header = npy_header(head_, name_);
    head_.erase(0, header.bytes);
    if (header.shape.size() != 2)
      throw_input_error(
          "{}: has {} dimensions, but a map has two, rows along y and columns along x; save it so: "
          "numpy.save('FILE', numpy.squeeze(a))",
          name_, header.shape.size());
    const bool numbers = !header.has_objects && header.fields.size() == 1 &&
                         header.fields.front().name.empty() && header.fields.front().unit.empty() &&
                         !header.fields.front().is_truth;
    if (!numbers)
      throw_input_error(
          "{}: holds something else than heights; save numbers: numpy.save('FILE', a.astype(float))", name_);
    type_ = header.fields.front().type;
    set_size(name_, static_cast<double>(header.shape[0]), static_cast<double>(header.shape[1]));
    layout_.from_top = false;
    layout_.by_columns = header.column_major;
    line_.resize(type_.bytes * static_cast<std::size_t>(line_length()));
  }

  void next_line(double* values) override {
    if (read(line_.data(), line_.size()) != line_.size())
      throw_input_error("{}: is cut off: it ends before its {} x {} heights do; save it again", name_,
                        layout_.cols, layout_.rows);
    const auto count = static_cast<std::size_t>(line_length());
    const StoredNumbers numbers{type_, line_, count, 1, type_.bytes, 0};
    for (std::size_t i = 0; i < count; ++i) values[i] = numbers.real(i, 0);
    char beyond = 0;
    if (++lines_read_ == lines() && read(&beyond, 1) != 0)
      throw_input_error("{}: goes on behind its {} x {} heights; save one array per file", name_,
                        layout_.cols, layout_.rows);
  }

 private:
  std::size_t read(char* bytes, std::size_t count) {
    const std::size_t kept = std::min(count, head_.size() - taken_);
    std::memcpy(bytes, head_.data() + taken_, kept);
    taken_ += kept;
    return kept + (kept < count ? file_.read(bytes + kept, count - kept) : 0);
  }

  std::string name_;
  InputFile file_;
  std::string head_;  // what was read with the header
  std::size_t taken_ = 0;
  StoredType type_;
  std::string line_;
  int lines_read_ = 0;
};

}  // namespace

std::unique_ptr<HeightMap> open_npy_map(const std::filesystem::path& path) {
  return std::make_unique<NpyMap>(path);
}

}  // namespace sandstroke
