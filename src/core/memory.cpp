#include "core/memory.h"

#include <unistd.h>

namespace sandstroke {

double physical_memory() {
  return static_cast<double>(sysconf(_SC_PHYS_PAGES)) * static_cast<double>(sysconf(_SC_PAGESIZE));
}

}  // namespace sandstroke
