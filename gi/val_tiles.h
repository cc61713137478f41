// The screen in square tiles, each with the area lights that reach it in two lists, near ones and far ones,
// and what every pass reads that gathers light by them.
#pragma once

#include "gi/ism_atlas.h"
#include "gi/surfaces.h"
#include "shaders/val_shading/val_shading_io.h"

namespace ag::gi {

enum class ValShape : uint32_t {
    kPoint,       // the cluster as a point emitter
    kDisk,        // RSMC eq. 2, ACRSM eq. 3.9: as published, loses energy near the light
    kVectorDisk,  // closed form of the disk's vector irradiance
    kRectangle,   // the rectangle of the cluster's second moments by its edges
    kPolygon,     // the convex polygon of its farthest texels by its edges
};

// What gloss is gathered of, a list at a time.
struct GlossGather {
    std::string_view name;
    uint32_t list;  // kNearList or kFarList
    ValShape shape;
    uint32_t taps;
};

// Passes and resources; literals, because the graph keeps views of them.
struct ValTileNames {
    std::string_view classify, lists, counts;
};

struct ValTiles {
    GraphScope scope;
    const Surfaces& gbuffer;
    const ShadowedVals& lights;
    io::ValShadingPush push{};
    BufferHandle lists;   // uint: a tile's near lights, then its far ones
    BufferHandle counts;  // uvec2 a tile: of near and of far lights
    uint32_t tileCount = 0;
    uint32_t blocks = 0;  // of 2 x 2 pixels
};

// `tileSize`: pixels. Lights nearer than `nearReach` of their half lengths are near.
ValTiles addValTiles(GraphScope scope, const Surfaces& gbuffer, const ShadowedVals& lights, float nearReach,
                     uint32_t tileSize, const ValTileNames& names);

// Lets a pass read the lights and what each of them sees: vals, shapes, isms, kShape, kVisibilityTaps,
// kParaboloid.
void readLights(PassBuilder& pass, const ShadowedVals& lights, ValShape shape, uint32_t taps);

// A pass that reads the tiles and their lights.
PassBuilder gatherPass(const ValTiles& tiles, std::string_view name, std::string_view shader, ValShape shape,
                       uint32_t taps);

}  // namespace ag::gi
