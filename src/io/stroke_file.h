#pragma once

#include <filesystem>

#include "haptics/force_model.h"
#include "haptics/stroke.h"
#include "haptics/table_settings.h"

namespace sandstroke {

/// Writes a recorded stroke (HDF5, group /stroke) by way of PATH.part. Empty optional columns are left out.
/// Error: io.
void write_stroke_file(const std::filesystem::path& path, const Stroke& stroke);

/// Reads a recorded stroke back, to the bit, and checks all of it. Error: io where the file cannot be opened;
/// input, naming file, dataset, sample and remedy, where its content is not a sound stroke.
Stroke read_stroke_file(const std::filesystem::path& path);

/// Whether a stroke is a recorded one (HDF5), by its name or its first bytes. Error: io.
bool is_recorded(const std::filesystem::path& path);

/// Whether it is a scripted one (.toml). Error: io.
bool is_script(const std::filesystem::path& path);

/// Reads a stroke of any form: recorded (HDF5), scripted (.toml; `force` says how deep a scripted force
/// presses), or a table of samples ("-": standard input), of which is logged what was found, and warnings.
/// Error: io, input.
Stroke load_stroke(const std::filesystem::path& path, const ForceSettings& force,
                   const TableSettings& table = {});

/// Of all that a run takes from a stroke.
std::string content_hash(const Stroke& stroke);

/// Whether load_stroke's `force` makes a difference. Error: io, input.
bool stroke_depends_on_force(const std::filesystem::path& path);

}  // namespace sandstroke
