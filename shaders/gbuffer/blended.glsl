// How a surface blends with what is behind it. After scene/scene.glsl with AG_SCENE_MATERIALS.
const float kLeastCoverage = 1.0 / 512.0;  // less is not seen in 8 bits

struct Blend {
    float coverage;      // glTF's alpha: 1: all light is reflected, absorbed, or transmitted as glass does
    float transmission;  // KHR_materials_transmission, without volume: a thin sheet
};

Blend blendOf(uint material, SurfaceMaterial m) {
    bool coversWholly = fetchTexel(materials, int(material) * 6 + 1).w < 0.0;
    return Blend(coversWholly ? 1.0 : clamp(m.baseColor.a, 0.0, 1.0), fetchTexel(materials, int(material) * 6 + 5).w);
}
