#pragma once

#include "core/temporary_folder.h"

namespace sandstroke {

/// An empty folder of its own for a test, gone afterwards.
using TestFolder = TemporaryFolder;

}  // namespace sandstroke
