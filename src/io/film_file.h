#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/child_process.h"
#include "core/file_lock.h"
#include "core/output_file.h"
#include "picture/image.h"

namespace sandstroke {

/// No film is known as ours, because ffmpeg leaves no sure sign of it.
inline constexpr OutputKind film_output{"a film"};

/// The endings of films, each with its dot.
std::vector<std::string> film_endings();

/// Error: input, if the name has none of these endings.
void check_film_name(const std::filesystem::path& path);
/// Before a run that ends in a film. Error: io, if ffmpeg is missing.
void check_film_program(const std::filesystem::path& path);

/// Writes a film, picture by picture, through the program ffmpeg. It keeps no picture. The film is PATH.part
/// until it is complete. An unfinished film leaves no file.
class FilmWriter {
 public:
  /// Sizes in pixels, rate in pictures per second. Error: input, if the name has no film's ending, or a side
  /// is odd (except for .gif); io, if ffmpeg is missing.
  FilmWriter(const std::filesystem::path& path, int width, int height, double rate);

  /// Adds an image of the film's size. False if this program is interrupted. Error: io, with ffmpeg's
  /// message.
  bool add(const Image& image);
  /// Puts the film in place. False if this program is interrupted before. Error: io, as above.
  bool finish();

 private:
  /// PATH.part, which this process alone writes. It is removed unless it is kept.
  struct Part {
    std::filesystem::path path;
    FileLock lock;
    bool keep = false;
    ~Part();
  };
  [[noreturn]] void fail(const ChildResult& result) const;

  Part part_;
  FedChild ffmpeg_;  // after the file that it writes, so it is destroyed first
};

}  // namespace sandstroke
