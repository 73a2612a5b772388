// Instead of the readers of src/import (SANDSTROKE_IMPORT=OFF).
#include "import/import_stroke.h"

#include "import/sample_files.h"
#include "left_out/left_out.h"

namespace sandstroke {

ImportedStroke import_stroke(const std::filesystem::path& path, const TableSettings&) {
  throw_left_out(samples_name(path) + ": reading strokes of other programs", "SANDSTROKE_IMPORT");
}

}  // namespace sandstroke
