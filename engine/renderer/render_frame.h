// What the renderer makes of a scene each frame: the camera's surfaces, direct and indirect light, the
// picture.
#pragma once

#include "engine/renderer/blended_layers.h"
#include "engine/renderer/composite.h"
#include "engine/renderer/direct_lighting.h"
#include "engine/renderer/exposure.h"
#include "engine/renderer/gbuffer.h"
#include "engine/renderer/picture_version.h"
#include "engine/renderer/punctual_lighting.h"
#include "engine/renderer/render_settings.h"
#include "gi/bounce_light.h"

namespace ag::render {

// What gi::World is lists of: scratch, so that a steady frame allocates nothing.
struct WorldLists {
    std::vector<gi::RsmLight> lights, otherLights;
    std::vector<gi::MovedThing> moved;
};

// State that outlives a frame; one per view of the scene.
struct RenderHistory {
    Technique technique = Technique::kNone;
    gi::BounceLightHistory bounce;
    gi::SkyHistory sky;
    gi::Settling exposure;
    PictureVersion picture;
    Standstill standstill;
    AntialiasingHistory antialiasing;
    SunShadowHistory sunShadows;
    LightClusterHistory lightClusters;
    PunctualShadowHistory punctualShadows;
    PunctualListsHistory punctualLists;
    PunctualRelevance punctualRelevance;
    BlendedHistory blended;
    WorldLists world;
};

// Everything the frame made: for composition, debug views, tests and captures.
struct RenderFrame {
    GBuffer gbuffer;
    gi::BounceLight bounce;
    ShadowMaps shadows;
    PunctualLights punctual;
    DirectLight direct;  // of suns and lamps
    gi::SkyLight sky;    // straight from it
    RenderOutputs outputs;
};

// Declares the passes of one frame, in order. Nothing runs until the graph is executed, and then only what
// the graph's outputs need.
RenderFrame addFrame(GraphScope scope, const SceneView& scene, const RenderSettings& settings,
                     RenderHistory& history);

}  // namespace ag::render
