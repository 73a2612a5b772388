#pragma once

#include <filesystem>

#include "haptics/stroke.h"
#include "haptics/table_settings.h"
#include "rules/force.h"

namespace sandstroke {

/// Writes a recorded stroke (HDF5, group /stroke) by way of PATH.part. Empty optional columns are left out.
/// Error: io.
void write_stroke_file(const std::filesystem::path& path, const Stroke& stroke);

/// Reads a recorded stroke back, to the bit, and checks all of it. Error: io, if the file cannot be opened;
/// input, naming file, dataset, sample and remedy, if its content is not a sound stroke.
Stroke read_stroke_file(const std::filesystem::path& path);

/// True if a stroke is a recorded one (HDF5), by its name or its first bytes. Error: io.
bool is_recorded(const std::filesystem::path& path);

/// True if a stroke is a script (.toml). Error: io.
bool is_script(const std::filesystem::path& path);

/// Reads a stroke of any form: recorded (HDF5), scripted (.toml; `force` tells how deep a scripted force
/// presses), or a table of samples ("-": standard input). For a table it logs what was found, and warnings.
/// Error: io, input.
Stroke load_stroke(const std::filesystem::path& path, const ForceSettings& force,
                   const TableSettings& table = {});

/// The hash of all that a run takes from a stroke.
std::string content_hash(const Stroke& stroke);

/// True if load_stroke() depends on its `force`. Error: io, input.
bool stroke_depends_on_force(const std::filesystem::path& path);

}  // namespace sandstroke
