// In sanitizer builds only: the Vulkan driver and the validation layer leak a little, and are unloaded before
// the leak check, which then cannot name them. Loading them once more keeps their names for the suppressions.
#if defined(__SANITIZE_ADDRESS__)
#include <dlfcn.h>

#include <initializer_list>

extern "C" const char* __lsan_default_suppressions();
extern "C" const char* __lsan_default_suppressions() {
    return "leak:libvulkan_lvp.so\nleak:libVkLayer_khronos_validation.so\nleak:libLLVM\n";
}

namespace {

[[maybe_unused]] const bool kKept = [] {
    for (const char* library : {"libvulkan_lvp.so", "libVkLayer_khronos_validation.so"})
        dlopen(library, RTLD_NOW | RTLD_NODELETE);
    return true;
}();

}  // namespace
#endif
