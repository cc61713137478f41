#include "engine/gpu/renderdoc.h"

#include <dlfcn.h>
#include <renderdoc_app.h>

#include <cstdlib>
#include <filesystem>

namespace ag::gpu {
namespace {

constexpr const char* kLibrary = "librenderdoc.so";

RENDERDOC_API_1_6_0* apiOf(void* library) {
    const auto getApi = library ? pRENDERDOC_GetAPI(dlsym(library, "RENDERDOC_GetAPI")) : nullptr;
    void* api = nullptr;
    if (!getApi || getApi(eRENDERDOC_API_Version_1_6_0, &api) != 1) return nullptr;
    return static_cast<RENDERDOC_API_1_6_0*>(api);
}

// The keys, the text over the picture and what happens in a crash stay the program's own.
void stayQuiet(RENDERDOC_API_1_6_0& api) {
    api.SetCaptureKeys(nullptr, 0);
    api.SetFocusToggleKeys(nullptr, 0);
    api.MaskOverlayBits(eRENDERDOC_Overlay_None, eRENDERDOC_Overlay_None);
    api.UnloadCrashHandler();
}

}  // namespace

Result<RenderDoc> RenderDoc::open(bool load) {
    if (load) setenv("ENABLE_VULKAN_RENDERDOC_CAPTURE", "1", 1);  // its layer's own switch
    void* library = dlopen(kLibrary, RTLD_NOW | (load ? 0 : RTLD_NOLOAD));
    if (!library && load) return Error{"RenderDoc is not installed (Debian package librenderdoc)"};
    RenderDoc made;
    if (!library) return made;
    made.api_ = apiOf(library);
    if (!made.api_) return Error{"this RenderDoc is older than the interface 1.6 that is asked for"};
    stayQuiet(*made.api_);
    return made;
}

void RenderDoc::begin() {
    api_->StartFrameCapture(nullptr, nullptr);
}

Status RenderDoc::end(const std::string& path) {
    // It adds to the name what it likes, and tells.
    api_->SetCaptureFilePathTemplate(std::filesystem::path(path).replace_extension().c_str());
    const uint32_t before = api_->GetNumCaptures();
    uint32_t length = 0;
    if (api_->EndFrameCapture(nullptr, nullptr) != 1 || api_->GetNumCaptures() == before ||
        api_->GetCapture(before, nullptr, &length, nullptr) != 1)
        return Error{path + ": RenderDoc captured nothing"};
    std::string written(length, '\0');
    api_->GetCapture(before, written.data(), &length, nullptr);
    written.resize(written.find_last_not_of('\0') + 1);
    std::error_code error;
    std::filesystem::rename(written, path, error);
    if (error) return Error{path + ": " + error.message()};
    return Ok{};
}

}  // namespace ag::gpu
