// One validated device for a whole test program; any validation message fails it.
#pragma once

#include "engine/gpu/device.h"

namespace ag::test {

// The program's device, opened on first use with core and synchronization validation.
gpu::Device& device();

}  // namespace ag::test
