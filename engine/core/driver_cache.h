// Where files lie that only spare time: ours, and those that a graphics driver keeps of compiled shaders.
#pragma once

#include <filesystem>

namespace ag {

// AFTERGLOW_CACHE_DIR, or `afterglow` in the user's folder of caches; empty where there is neither.
std::filesystem::path cacheFolder();

// Gives Mesa's drivers a cache of compiled shaders for each vector width (LP_NATIVE_VECTOR_WIDTH), because
// lavapipe's keys leave the width out: they hold the driver's build, LLVM's and the processor, and code of
// another width corrupts memory. It lies in MESA_SHADER_CACHE_DIR if that is set. To be called before the
// first instance is made and before there are threads; once it is done, calls do nothing.
void separateDriverCaches();

}  // namespace ag
