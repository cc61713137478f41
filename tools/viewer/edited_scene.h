// A scene that follows what was edited of its asset: things stand where they were moved to, materials look as
// they were made to.
#pragma once

#include <optional>
#include <string>

#include "engine/scene/asset_edits.h"

namespace ag::viewer {

class EditedScene {
  public:
    // `loaded`: what of the asset and the scene is edited already. Both must outlive this.
    EditedScene(SceneAsset& asset, RenderScene& scene, AssetEdits loaded);

    // Whether following it writes to materials, which nobody else may read meanwhile.
    bool changesMaterials(const AssetEdits& wanted) const { return wanted.looks != applied_.looks; }
    // Materials: their geometry's version changed with them. Lights: those of lamps that moved came along.
    struct Changes {
        bool materials = false, lights = false;
    };
    Changes follow(const AssetEdits& wanted);
    // After the frame was rendered: nothing has changed since.
    void rendered();

    // The node that is moved by what an instance belongs to: copies that a file keeps in one node are one
    // thing. None: it cannot be moved.
    std::optional<uint32_t> thingOf(uint32_t instance) const;
    std::string nameOf(uint32_t node) const;
    Bounds boundsOf(uint32_t node) const;  // m, relative to the origin; of all that moves with it
    const SceneAsset& asset() const { return asset_; }

  private:
    bool isBelow(int32_t node, uint32_t ancestor) const;
    bool move(const NodeMove& by);
    bool moveLights(const NodeMove& by);
    void moveRows(const NodeMove& by);
    bool setLooks(const AssetEdits& wanted);

    SceneAsset& asset_;
    RenderScene& scene_;
    AssetEdits applied_;
    std::vector<MaterialLook> start_;  // of all materials
    std::vector<int32_t> nodes_;       // that place the instances
    bool fromFile_ = false;
};

}  // namespace ag::viewer
