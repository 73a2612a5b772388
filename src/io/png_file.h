#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "core/output_file.h"
#include "picture/image.h"
#include "sand/height_field.h"

namespace sandstroke {

/// How every PNG begins.
inline constexpr std::string_view png_signature = "\x89PNG\r\n\x1a\n";

/// Known by its Software chunk.
inline constexpr OutputKind picture_output{"a picture", png_signature, {"tEXtSoftware\0sandstroke ", 24}};

/// The same of heights, which take no picture's place.
inline constexpr OutputKind height_png_output{
    "a height map", png_signature, {"tEXtSoftware\0height map of sandstroke ", 38}};

/// Largest side of a PNG that is read, in pixels.
inline constexpr int largest_png_side = 16384;

/// An 8-bit RGB PNG as bytes. It says which build made it, and no date: from one build, equal pictures are
/// equal bytes. Error: io, where libpng refuses.
std::string encode_png(const Image& image);

/// Heights [m] that black and white stand for.
struct GrayRange {
  double black = 0.0, white = 0.0;
};

/// Heights [m] as a 16-bit grayscale PNG, which read_height_png() reads: row 0 is the lowest. What is beyond
/// the range is cut to it. The range is in the file, as the text "Heights". Sides of at most largest_png_side
/// (Error: input). Error: io, where libpng refuses.
std::string encode_height_png(const HeightGrid& heights, const GrayRange& range);

/// The range that a PNG names so; none: it names none. Error: as read_png.
std::optional<GrayRange> read_gray_range(const std::filesystem::path& path);

bool has_picture_name(const std::filesystem::path& path);
/// Refuses a picture to write that others would take for something else than a PNG. Error: input.
void check_picture_name(const std::filesystem::path& path);

/// Writes the same by way of PATH.part. Error: io.
void write_png(const std::filesystem::path& path, const Image& image);

/// Reads any PNG as 8-bit RGB: gray and palette are expanded, 16 bits rounded to 8, transparency is dropped.
/// Error: io where it cannot be opened; input where it is no PNG, damaged or larger than largest_png_side.
Image read_png(const std::filesystem::path& path);

/// Reads a 16-bit grayscale PNG as values from 0 (black) to 1 (white), value / 65535 exactly; the picture's
/// lowest row is row 0 (its upper border is the highest y). Error: as read_png; input for other kinds of PNG.
HeightGrid read_height_png(const std::filesystem::path& path);

}  // namespace sandstroke
