#include "engine/scene/describe_components.h"

#include "engine/ecs/describe.h"
#include "engine/scene/components.h"
#include "engine/scene/mover.h"

namespace ag {

void describeSceneComponents() {
    describe<Name>({field("text", &Name::text)});
    describe<Parent>({field("entity", &Parent::entity)});
    describe<HierarchyDepth>({field("depth", &HierarchyDepth::depth)});
    describe<LocalTransform>({field("translation", &LocalTransform::translation, "m"),
                              field("rotation", &LocalTransform::rotation, "x y z w"),
                              field("scale", &LocalTransform::scale), field("node", &LocalTransform::node)});
    describe<WorldTransform>({field("translation", &WorldTransform::translation, "m"),
                              field("linear", &WorldTransform::linear, "columns"),
                              field("handedness", &WorldTransform::handedness)});
    describe<MeshInstance>({field("firstPrimitive", &MeshInstance::firstPrimitive),
                            field("primitiveCount", &MeshInstance::primitiveCount),
                            field("movable", &MeshInstance::movable)});
    describe<SkinnedMesh>({field("model", &SkinnedMesh::model)});
    describe<AnimationPlayer>(
        {field("clip", &AnimationPlayer::clip), field("seconds", &AnimationPlayer::seconds, "s"),
         field("speed", &AnimationPlayer::speed), field("loops", &AnimationPlayer::loops)});
    describe<PunctualLight>({field("intensity", &PunctualLight::intensity, "W/sr, W/m²"),
                             field("range", &PunctualLight::range, "m"),
                             field("innerConeAngle", &PunctualLight::innerConeAngle, "rad"),
                             field("outerConeAngle", &PunctualLight::outerConeAngle, "rad"),
                             field("kind", &PunctualLight::kind),
                             field("castsShadow", &PunctualLight::castsShadow)});
    describe<BounceLight>({field("rsmResolution", &BounceLight::rsmResolution, "texels"),
                           field("budgetShare", &BounceLight::budgetShare)});
    describe<Mover>({field("origin", &Mover::origin, "m"), field("extent", &Mover::extent, "m"),
                     field("period", &Mover::period, "s"), field("spinSpeed", &Mover::spinSpeed, "rad/s"),
                     field("startYaw", &Mover::startYaw, "rad")});
}

}  // namespace ag
