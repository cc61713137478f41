// EXR and PFM images; what can be read must also be written.
#include "engine/core/image.h"
#include "tests/fuzz/as_file.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* bytes, size_t size) {
    const bool pfm = size > 0 && bytes[0] == 'P';
    const auto image = ag::loadImage(ag::fuzz::asFile(bytes, size, pfm ? ".pfm" : ".exr"));
    if (image && int64_t(image->width) * image->height != int64_t(image->pixels.size())) std::abort();
    return 0;
}
