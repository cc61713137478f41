// Another picture of the same view beside ours, or how far the two are apart.
#pragma once

#include "engine/renderer/debug_view.h"

namespace ag::viewer {

enum class BesideShown : uint32_t { kPicture, kError };  // as shaders/debug_view/beside.frag has them

struct BesideSettings {
    BesideShown show = BesideShown::kPicture;
    float split = 0.5f;  // of the width: ours to its left
};

struct OtherPicture {
    ImageHandle radiance;
    float unit = 1;  // W/(m² sr) of its numbers
    float mean = 0;  // W/(m² sr); 0: unknown, the error is not shown
};

// Both at our exposure. Ours alone where the sizes differ.
ImageHandle addBeside(GraphScope scope, const render::SceneView& view, const render::RenderFrame& frame,
                      const render::CompositeSettings& composite, const OtherPicture& other,
                      const BesideSettings& settings);

}  // namespace ag::viewer
