#include "sand/instruction_set.h"

#include <hwy/highway.h>

namespace sandstroke {

std::string instruction_set() {
  return hwy::TargetName(hwy::SupportedAndGeneratedTargets().front());  // best first
}

}  // namespace sandstroke
