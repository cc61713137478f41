// volk loads Vulkan at run time: the one place its definitions live.
#define VOLK_IMPLEMENTATION
#include <volk.h>
