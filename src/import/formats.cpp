#include "import/formats.h"

#include <algorithm>
#include <array>

#include "core/error.h"
#include "core/input_file.h"
#include "core/output_file.h"
#include "import/gcode.h"
#include "import/gcode_words.h"
#include "import/inkml.h"
#include "import/kinds_not_read.h"
#include "import/mat.h"
#include "import/ros2_bag.h"
#include "import/text_parts.h"
#include "import/thr.h"
#include "import/unipen.h"

namespace sandstroke {
namespace {

namespace fs = std::filesystem;

constexpr const char* as_csv = "save or export it as CSV";
constexpr KindNotRead recordings_not_read[] = {
    {"#ROSBAG V", "", "a ROS 1 bag",
     "convert it: rosbags-convert --src FILE.bag --dst FOLDER, and name the .db3 file in that folder"},
    {"\x89MCAP0\r\n", "", "an MCAP file (ROS 2)", "convert it to a .db3: ros2 bag convert"},
    {"PK\x03\x04", ".xlsx", "an Excel file (.xlsx)", as_csv},
    {"PK\x03\x04", ".xlsm", "an Excel file (.xlsm)", as_csv},
    {"PK\x03\x04", ".ods", "a spreadsheet (.ods)", as_csv},
    {"PK\x03\x04", ".npz", "a NumPy archive (.npz)",
     "save a table: numpy.savetxt('samples.csv', samples, delimiter=',', header='x,y,z')"},
    {"\xD0\xCF\x11\xE0\xA1\xB1\x1A\xE1", "", "an old Excel or Office file", as_csv},
    {"PAR1", "", "a Parquet file",
     "save it as CSV: pandas.read_parquet('FILE').to_csv('samples.csv', index=False)"},
    {"ARROW1", "", "a Feather file (Arrow)",
     "save it as CSV: pandas.read_feather('FILE').to_csv('samples.csv', index=False)"},
    {"\x93NUMPY", "", "a NumPy file (.npy)",
     "save a table: numpy.savetxt('samples.csv', numpy.load('FILE'), delimiter=',', header='x,y,z')"},
    {"\x89HDF\r\n\x1A\n", "", "an HDF5 file without a stroke from sandstroke",
     "save its columns as CSV: pandas.DataFrame({'x': x, 'y': y}).to_csv('samples.csv', index=False)"},
    {"%PDF", "", "a PDF", "name the file with the samples themselves"},
    {"\x89PNG", "", "a PNG picture", "name the file with the samples themselves"},
    {"\xFF\xD8\xFF", "", "a JPEG picture", "name the file with the samples themselves"},
    {"", ".pkl", "a Python pickle", "save a table: DataFrame.to_csv('samples.csv', index=False)"},
    {"", ".c3d", "a C3D file (motion capture)", "export its points as CSV"},
    {"", ".svg", "an SVG drawing", "convert it to G-code for a plotter"},
    {"", ".plt", "a plot in HPGL", "save it as G-code"},
    {"", ".hpgl", "a plot in HPGL", "save it as G-code"},
};

bool has_ending(const fs::path& path, std::string_view ending) { return small_ending(path) == ending; }

/// The beginning of a file, long enough to tell its format.
std::string head_of(const fs::path& path) {
  std::string head(1 << 16, '\0');
  head.resize(InputFile(path).read(head.data(), head.size()));
  return head;
}

/// Refuses text that begins as XML or JSON, which other programs read. A script begins with [[segment]] or a
/// name.
void refuse_trees_of_text(const fs::path& path, std::string_view text) {
  if (text.starts_with('<'))
    throw_input_error("{}: is XML or HTML, but not InkML; {}", path.string(), as_csv);
  const std::string_view inner = text.starts_with('[') ? without_blanks(text.substr(1)) : "";
  const bool is_list =
      !inner.empty() && std::string_view("{[-0123456789\"").find(inner[0]) != std::string_view::npos;
  if (text.starts_with('{') || (is_list && !text.starts_with("[[")) || has_ending(path, ".json")) {
    throw_input_error(
        "{}: is JSON, which sandstroke cannot read; save it as CSV: "
        "pandas.read_json('FILE').to_csv('samples.csv', index=False)",
        path.string());
  }
}

/// True for binary data, which has several zero bytes in a row. Tables may be in UTF-16, where every other
/// byte is 0.
bool is_binary(std::string_view head) {
  return head.find(std::string_view("\0\0", 2)) != std::string_view::npos;
}

bool is_inkml(std::string_view text) {
  return text.starts_with('<') &&
         (text.find("<ink") != std::string_view::npos || text.find(":ink") != std::string_view::npos);
}

}  // namespace

std::optional<SampleTable> read_known_format(const fs::path& path, const TableSettings& settings) {
  const std::string& part = settings.part;
  const bool pipe =
      path == "-" || (fs::exists(path) && !fs::is_regular_file(path) && !fs::is_directory(path));
  if (pipe) return {};
  const std::string head = head_of(path);
  if (head.starts_with(std::string_view("SQLite format 3\0", 16))) return read_ros2_bag(path, part);
  if (head.starts_with("MATLAB ") || has_ending(path, ".mat")) return read_mat(path, part);
  if (!part.empty()) throw_input_error("{}: has no parts; leave out --part {}", path.string(), part);
  refuse_kinds(recordings_not_read, path, head);
  refuse_kinds(packed_kinds, path, head);
  if (is_binary(head)) {
    throw_input_error("{}: is neither text nor a binary format that sandstroke reads (ROS 2 bag, MATLAB); {}",
                      path.string(), as_csv);
  }
  const std::string_view text = without_blanks(without_byte_order_mark(head));
  if (is_inkml(text)) return read_inkml(path);
  if (looks_like_unipen(text)) return read_unipen(path);
  if (has_ending(path, ".thr")) return read_thr(path);
  for (const char* ending : {".gcode", ".gco", ".nc", ".ngc", ".tap"})
    if (has_ending(path, ending)) return read_gcode(path, settings.pen_up);
  if (looks_like_gcode(text)) return read_gcode(path, settings.pen_up);
  refuse_trees_of_text(path, text);
  return {};
}

}  // namespace sandstroke
