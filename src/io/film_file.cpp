#include "io/film_file.h"

#include <iterator>
#include <sstream>

#include "core/error.h"
#include "core/interrupt.h"
#include "core/output_file.h"

namespace sandstroke {
namespace {
namespace fs = std::filesystem;

struct FilmFormat {
  std::string ending;  // with its dot; without it, it is ffmpeg's name of the format
  std::string options;
};

// Colours are in BT.709 and marked so. By default ffmpeg writes BT.601, and players show other colours.
const std::string bt709 =
    " -vf scale=out_color_matrix=bt709:out_range=tv,format=yuv420p -colorspace bt709 -color_range tv"
    " -color_primaries bt709 -color_trc bt709";

// Fine sand shows no blocks. An mp4 plays before it is loaded. Each picture of a gif has its own colours,
// because common ones would only be known at the end.
const std::vector<FilmFormat> film_formats = {
    {".mp4", "-c:v libx264 -crf 18 -movflags +faststart" + bt709},
    {".webm", "-c:v libvpx-vp9 -crf 30 -b:v 0 -row-mt 1" + bt709},
    {".gif", "-vf split[a][b];[a]palettegen=stats_mode=single[p];[b][p]paletteuse=new=1"}};

const FilmFormat& format_of(const fs::path& path) {
  for (const FilmFormat& format : film_formats)
    if (path.extension() == format.ending) return format;
  throw_input_error("{}: is not the name of a film; end it with {}", path.string(),
                    fmt::join(film_endings(), ", "));
}

std::vector<std::string> words_of(const std::string& line) {
  std::istringstream text(line);
  return {std::istream_iterator<std::string>(text), {}};
}

[[noreturn]] void throw_no_ffmpeg(const fs::path& path) {
  throw_io_error(
      "{}: films need the program ffmpeg, which is not installed; install it (Debian: apt-get install "
      "ffmpeg), or leave out --video to get single pictures",
      path.string());
}

FedChild start_ffmpeg(const fs::path& path, int width, int height, double rate) {
  const FilmFormat& format = format_of(path);
  if (format.ending != ".gif" && (width % 2 || height % 2))
    throw_input_error("a film needs an even number of pixels along each side, not {} x {}; add --size {}x{}",
                      width, height, width + width % 2, height + height % 2);
  // -xerror: without it ffmpeg reports no failure on a full disk.
  std::vector<std::string> words =
      words_of(fmt::format("ffmpeg -nostdin -loglevel error -xerror -y -f rawvideo -pixel_format rgb24 "
                           "-video_size {}x{} -framerate {} "
                           "-i pipe:0 {} -f {}",
                           width, height, rate, format.options, format.ending.substr(1)));
  // "file:": otherwise a name with a colon would be a protocol's, and one with a dash an option.
  words.push_back("file:" + part_path(path).string());
  std::optional<FedChild> ffmpeg = FedChild::start(words);
  if (!ffmpeg) throw_no_ffmpeg(path);
  return std::move(*ffmpeg);
}

}  // namespace

std::vector<std::string> film_endings() {
  std::vector<std::string> endings;
  for (const FilmFormat& format : film_formats) endings.push_back(format.ending);
  return endings;
}

void check_film_name(const fs::path& path) { format_of(path); }

void check_film_program(const fs::path& path) {
  if (!is_installed("ffmpeg")) throw_no_ffmpeg(path);
}

FilmWriter::Part::~Part() {
  if (!keep) drop_part(path);
}

FilmWriter::FilmWriter(const fs::path& path, int width, int height, double rate)
    : part_{path, take_part(path, film_output)}, ffmpeg_(start_ffmpeg(path, width, height, rate)) {}

void FilmWriter::fail(const ChildResult& result) const {
  const std::size_t line = result.err.find_last_of('\n');  // no newline: npos + 1 is 0
  throw_io_error("{}: ffmpeg cannot write it: {}", part_.path.string(),
                 result.err.empty() ? fmt::format("it stopped early with exit code {}", result.exit_code)
                                    : result.err.substr(line + 1));
}

bool FilmWriter::add(const Image& image) {
  if (ffmpeg_.feed(image.rgb.data(), image.rgb.size())) return true;
  const std::optional<ChildResult> result = ffmpeg_.wait();
  if (result && !interrupted()) fail(*result);  // Ctrl-C at the terminal ends both
  return false;
}

bool FilmWriter::finish() {
  const std::optional<ChildResult> result = ffmpeg_.wait();
  if (!result || (result->exit_code != 0 && interrupted())) return false;
  if (result->exit_code != 0) fail(*result);
  part_.keep = true;
  finish_part(part_.path, film_output);
  return true;
}

}  // namespace sandstroke
