#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/child_process.h"
#include "core/file_lock.h"
#include "core/output_file.h"
#include "picture/image.h"

namespace sandstroke {

/// ffmpeg leaves no sure sign of whose a film is.
inline constexpr OutputKind film_output{"a film"};

/// The endings of films, each with its dot.
std::vector<std::string> film_endings();

/// Error: input, where the name has none of them.
void check_film_name(const std::filesystem::path& path);

/// Writes a film, picture by picture, through the program ffmpeg: they go down to it, none is kept. PATH.part
/// until it is complete; what is not finished leaves nothing.
class FilmWriter {
 public:
  /// Sizes in pixels, rate in pictures a second. Error: input, where the name has no film's ending or a side
  /// is odd; io, where ffmpeg is not there.
  FilmWriter(const std::filesystem::path& path, int width, int height, double rate);

  /// Of the film's size. False where this program is interrupted. Error: io, with what ffmpeg said.
  bool add(const Image& image);
  /// Puts the film in place. False where this program is interrupted before. Error: io, as above.
  bool finish();

 private:
  /// PATH.part: ours alone, gone unless it is kept.
  struct Part {
    std::filesystem::path path;
    FileLock lock;
    bool keep = false;
    ~Part();
  };
  [[noreturn]] void fail(const ChildResult& result) const;

  Part part_;
  FedChild ffmpeg_;  // after the file that it writes: gone before it
};

}  // namespace sandstroke
