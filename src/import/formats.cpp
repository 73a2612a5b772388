#include "import/formats.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <utility>

#include "core/error.h"
#include "core/input_file.h"
#include "core/output_file.h"
#include "import/foreign_text.h"
#include "import/gcode.h"
#include "import/gcode_words.h"
#include "import/hpgl.h"
#include "import/inkml.h"
#include "import/json_rows.h"
#include "import/kinds_not_read.h"
#include "import/mat.h"
#include "import/mcap.h"
#include "import/npy.h"
#include "import/npz.h"
#include "import/ros1_bag.h"
#include "import/ros2_bag.h"
#include "import/svg.h"
#include "import/table_option.h"
#include "import/text_parts.h"
#include "import/thr.h"
#include "import/unipen.h"

namespace sandstroke {
namespace {

namespace fs = std::filesystem;

constexpr const char* as_csv = "save or export it as CSV";
constexpr KindNotRead recordings_not_read[] = {
    {"#ROSBAG V", "", "a ROS 1 bag of another version than 2.0", "convert it: rosbag fix FILE.bag NEW.bag"},
    {"#ROSRECORD V", "", "an old ROS 1 bag", "convert it: rosbag fix FILE.bag NEW.bag"},
    {"\x89MCAP", "", "an MCAP file of another version than 0", "convert it to a .db3: ros2 bag convert"},
    {"PK\x03\x04", ".xlsx", "an Excel file (.xlsx)", as_csv},
    {"PK\x03\x04", ".xlsm", "an Excel file (.xlsm)", as_csv},
    {"PK\x03\x04", ".ods", "a spreadsheet (.ods)", as_csv},
    {"\xD0\xCF\x11\xE0\xA1\xB1\x1A\xE1", "", "an old Excel or Office file", as_csv},
    {"PAR1", "", "a Parquet file",
     "save it as CSV: pandas.read_parquet('FILE').to_csv('samples.csv', index=False)", true},
    {"ARROW1", "", "a Feather file (Arrow)",
     "save it as CSV: pandas.read_feather('FILE').to_csv('samples.csv', index=False)", true},
    {"\x89HDF\r\n\x1A\n", "", "an HDF5 file without a stroke from sandstroke",
     "save its columns as CSV: pandas.DataFrame({'x': x, 'y': y}).to_csv('samples.csv', index=False)"},
    {"%PDF", "", "a PDF", "name the file with the samples themselves"},
    {"\x89PNG", "", "a PNG picture", "name the file with the samples themselves"},
    {"\xFF\xD8\xFF", "", "a JPEG picture", "name the file with the samples themselves"},
    {"", ".pkl", "a Python pickle", "save a table: DataFrame.to_csv('samples.csv', index=False)"},
    {"", ".c3d", "a C3D file (motion capture)", "export its points as CSV"},
    {"HIERARCHY", "", "a BVH file (motion capture)", "export the positions of one joint as CSV"},
    {"AutoCAD Binary DXF", "", "a DXF drawing", "save it as SVG (in Inkscape or LibreCAD)"},
    {"", ".dxf", "a DXF drawing", "save it as SVG (in Inkscape or LibreCAD)"},
    {"", ".dwg", "a DWG drawing", "save it as SVG (in LibreCAD or your CAD program)"},
    {"%!PS", "", "a PostScript drawing", "save it as SVG (in Inkscape)"},
};

bool has_ending(const fs::path& path, std::string_view ending) { return small_ending(path) == ending; }

/// True for binary data, which has several zero bytes in a row. Tables may be in UTF-16, where every other
/// byte is 0.
bool is_binary(std::string_view head) {
  return head.find(std::string_view("\0\0", 2)) != std::string_view::npos;
}

/// True for an element ink, also with a prefix; xmlns:inkscape is none.
bool is_inkml(std::string_view text) {
  if (!text.starts_with('<')) return false;
  for (std::size_t at = text.find("ink"); at != std::string_view::npos; at = text.find("ink", at + 1)) {
    const std::string_view around = text.substr(at - 1, 5);
    const bool begins = around[0] == '<' || around[0] == ':';
    if (begins && around.size() == 5 &&
        std::string_view(" \t\r\n/>").find(around[4]) != std::string_view::npos)
      return true;
  }
  return false;
}

bool is_gcode(const fs::path& path, std::string_view text) {
  for (const char* ending : {".gcode", ".gco", ".nc", ".ngc", ".tap"})
    if (has_ending(path, ending)) return true;
  return looks_like_gcode(text);
}

/// head: the file's beginning; text: the same, if it is text, without blanks around it.
std::optional<SampleTable> read_format(const fs::path& path, const TableSettings& settings,
                                       std::string_view head, std::string_view text) {
  const std::string& part = settings.part;
  refuse_kinds(pointer_kinds, path, head);
  if (head.starts_with(std::string_view("SQLite format 3\0", 16))) return read_ros2_bag(path, part);
  if (head.starts_with(mcap_magic)) return read_mcap(path, part);
  if (head.starts_with(ros1_bag_magic)) return read_ros1_bag(path, part);
  if (head.starts_with("MATLAB 5.0 MAT-file") || head.starts_with("MATLAB 7.3 MAT-file") ||
      has_ending(path, ".mat"))
    return read_mat(path, part);
  if (has_ending(path, ".npz")) return read_npz(path, part);
  if (!part.empty()) throw_input_error("{}: has no parts; leave out --part {}", path.string(), part);
  if (head.starts_with("\x93NUMPY")) return read_npy(path);
  refuse_kinds(recordings_not_read, path, head);
  refuse_kinds(packed_kinds, path, head);
  if (is_binary(head)) {
    throw_input_error(
        "{}: is neither text nor a binary format that sandstroke reads (bags of ROS, MCAP, MATLAB, NumPy); "
        "{}",
        path.string(), as_csv);
  }
  if (is_inkml(text)) return read_inkml(path);
  if (looks_like_svg(text)) return read_svg(path);
  if (looks_like_unipen(text)) return read_unipen(path);
  if (has_ending(path, ".thr")) return read_thr(path);
  if (is_gcode(path, text)) return read_gcode(path, settings.pen_up, settings.pen_down);
  if (looks_like_hpgl(text) || has_ending(path, ".hpgl")) return read_hpgl(path);
  const bool lines_are_chosen =
      settings.skip_lines > 0 || !settings.skip.empty() || !settings.columns.empty();
  if (!JsonRows::begin(text) && !lines_are_chosen) refuse_foreign_text(path, text);
  return {};
}

/// Refuses settings that would have no effect on a file which is no table of text.
void refuse_unused_settings(const fs::path& path, const TableSettings& settings, bool has_pen_words) {
  const bool names_pen = !settings.pen_up.empty() || !settings.pen_down.empty();
  if (names_pen && !has_pen_words)
    throw_input_error("{}: its format tells itself where the pen is up; leave out {}", path.string(),
                      option_and_key(settings.pen_up.empty() ? "pen_down" : "pen_up"));
  if (!settings.columns.empty())
    throw_input_error(
        "{}: its format names the columns itself; leave out {}, and choose columns by their names or numbers "
        "(stroke info shows them)",
        path.string(), option_and_key("columns"));
  for (const auto& [given, key] : std::initializer_list<std::pair<bool, const char*>>{
           {settings.separator != Separator::found, "separator"},
           {settings.decimal != DecimalMark::found, "decimal"},
           {!settings.encoding.empty(), "encoding"},
           {settings.skip_lines > 0, "skip_lines"},
           {!settings.skip.empty(), "skip"}})
    if (given)
      throw_input_error("{}: is no table of text, to which alone {} belongs; leave it out", path.string(),
                        option_and_key(key));
}

}  // namespace

std::optional<SampleTable> read_known_format(const fs::path& path, const TableSettings& settings) {
  if (path == "-" || is_pipe(path)) return {};
  const std::string head = beginning_of(path, 1 << 16);  // long enough to tell its format
  const std::string_view text = without_blanks(without_byte_order_mark(head));
  std::optional<SampleTable> table = read_format(path, settings, head, text);
  if (table) refuse_unused_settings(path, settings, is_gcode(path, text));
  return table;
}

}  // namespace sandstroke
