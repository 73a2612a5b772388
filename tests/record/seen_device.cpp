#include "record/seen_device.h"

namespace sandstroke {

std::shared_ptr<HapticDevice> seen(FakeDevice& device) {
  return {&device, [](HapticDevice*) {}};
}

const bool zero_is_sent_twice = true;

}  // namespace sandstroke
