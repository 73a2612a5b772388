#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "core/output_file.h"
#include "picture/image.h"
#include "sand/height_field.h"

namespace sandstroke {

/// The first bytes of every PNG.
inline constexpr std::string_view png_signature = "\x89PNG\r\n\x1a\n";

/// A picture is known by its Software chunk.
inline constexpr OutputKind picture_output{"a picture", png_signature, {"tEXtSoftware\0sandstroke ", 24}};

/// The same for a height map, which never replaces a picture.
inline constexpr OutputKind height_png_output{
    "a height map", png_signature, {"tEXtSoftware\0height map of sandstroke ", 38}};

/// Largest side of a PNG that is read, in pixels.
inline constexpr int largest_png_side = 16384;

/// An 8-bit RGB PNG as bytes. It names the build that made it, and no date: one build gives equal bytes for
/// equal pictures. Error: io, if libpng refuses.
std::string encode_png(const Image& image);

/// Heights [m] that black and white stand for.
struct GrayRange {
  double black = 0.0, white = 0.0;
};

/// Heights [m] as a 16-bit grayscale PNG, which open_png_map() reads: row 0 is the lowest. Heights beyond
/// the range are cut to it. The file holds the range as the text "Heights". Error: input, if a side is longer
/// than largest_png_side; io, if libpng refuses.
std::string encode_height_png(const HeightGrid& heights, const GrayRange& range);

/// The range in a PNG's text "Heights"; none: it has no such text. Error: as read_png().
std::optional<GrayRange> read_gray_range(const std::filesystem::path& path);

bool has_picture_name(const std::filesystem::path& path);
/// Refuses a picture's name that others would not take for a PNG. Error: input.
void check_picture_name(const std::filesystem::path& path);

/// Writes what encode_png() gives by way of PATH.part. Error: io.
void write_png(const std::filesystem::path& path, const Image& image);

/// Reads any PNG as 8-bit RGB, with alpha if it has any: gray and palette are expanded, 16 bits rounded to 8.
/// Error: io, if it cannot be opened; input, if it is no PNG, damaged or larger than largest_png_side.
Image read_png(const std::filesystem::path& path);

}  // namespace sandstroke
