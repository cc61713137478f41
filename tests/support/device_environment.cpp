#include "tests/support/device_environment.h"

#include <gtest/gtest.h>

#include "engine/core/driver_cache.h"
#include "engine/gpu/instance.h"

namespace ag::test {
namespace {

std::unique_ptr<gpu::Device> gDevice;

class DeviceEnvironment : public testing::Environment {
  public:
    void SetUp() override { separateDriverCaches(); }
    void TearDown() override {
        gDevice.reset();  // objects still alive are reported now
        EXPECT_EQ(gpu::totalValidationMessages(), 0) << "validation messages are printed above";
    }
};

[[maybe_unused]] const auto* const kEnvironment = testing::AddGlobalTestEnvironment(new DeviceEnvironment);

}  // namespace

gpu::Device& device() {
    if (!gDevice) {
        auto made = gpu::Device::create({.validation = true});
        if (!made) {
            std::fprintf(stderr, "%s\n", made.error().message.c_str());
            std::abort();
        }
        gDevice = std::move(*made);
    }
    return *gDevice;
}

}  // namespace ag::test
