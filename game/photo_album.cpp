#include "game/photo_album.h"

#include "game/photo_mode.h"
#include "game/user_files.h"

namespace ag::game {

Result<std::string> savePhoto(render::Renderer& renderer, ImageHandle shown, ImageHandle light,
                              render::Layer layer, const std::string& folder) {
    if (const Status made = openFolder({folder}); !made) return made.error();
    const std::string stem = nextPhoto(folder);
    renderer.waitIdle();
    if (const Status saved = saveImage(render::readImage(renderer, shown), stem + ".png"); !saved)
        return saved.error();
    if (!light) return stem;
    const render::LayerInfo& info = render::layerInfo(layer);
    Image picture = render::readImage(renderer, light);
    picture.attributes = {{"layer", std::string(info.name)},
                          {"unit", std::string(info.unit)},
                          {"meaning", std::string(info.meaning)},
                          {"device", renderer.device().info().name}};
    if (const Status saved = saveImage(picture, stem + ".exr"); !saved) return saved.error();
    return stem;
}

}  // namespace ag::game
