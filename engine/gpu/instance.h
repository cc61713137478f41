// The Vulkan instance that a device of ours comes from, and what the validation layers say.
#pragma once

#include "engine/gpu/functions.h"

#include <vector>

#include "engine/core/result.h"

namespace ag::gpu {

struct Instance {
    VkInstance handle = VK_NULL_HANDLE;
    VkDebugUtilsMessengerEXT messenger = VK_NULL_HANDLE;  // with validation alone
};

// Loads the instance's functions, too. `validate`: core and synchronization validation; messages are counted.
// After an error what was made is in `instance`, for closeInstance().
Status openInstance(Functions& vk, std::vector<const char*> extensions, bool validate, Instance& instance);
void closeInstance(const Functions& vk, const Instance& instance);

// Warnings and errors of all instances ever made in this process, also those while one is destroyed.
int totalValidationMessages();

}  // namespace ag::gpu
