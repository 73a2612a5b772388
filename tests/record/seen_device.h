#pragma once

#include <memory>

#include "record/fake_device.h"

namespace sandstroke {

/// A fake device as the recorder gets to see it. Tests that use it are built twice: into test_record, where
/// it is the fake itself, and into test_chai3d, where it is the fake as a device of CHAI3D's.
std::shared_ptr<HapticDevice> seen(FakeDevice& device);

/// True if a device that holds no force is sent a zero force all the same.
extern const bool zero_is_sent_twice;

}  // namespace sandstroke
