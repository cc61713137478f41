#include "engine/physics/physics_world.h"

#include <btBulletDynamicsCommon.h>

#include <algorithm>
#include <vector>

#include "engine/core/check.h"

namespace ag {
namespace {

constexpr short kSolidGroup = 1, kWalkerGroup = 2, kCarriedGroup = 4;
constexpr short kAllGroups = kSolidGroup | kWalkerGroup | kCarriedGroup;

btVector3 toBullet(glm::vec3 v) {
    return {v.x, v.y, v.z};
}
btQuaternion toBullet(glm::quat q) {
    return {q.x, q.y, q.z, q.w};
}
glm::vec3 fromBullet(const btVector3& v) {
    return {v.x(), v.y(), v.z()};
}

// A body with its shape. The box's middle is the body's: `center` leads from the entity's origin to it.
struct Item {
    std::unique_ptr<btTriangleMesh> triangles;
    std::unique_ptr<btCollisionShape> shape;
    std::unique_ptr<btRigidBody> body;
    std::unique_ptr<btHingeConstraint> hinge;
    BodyKind kind = BodyKind::kStatic;
    glm::vec3 center{0};
    float mass = 0;
    short group = kSolidGroup;
};

// Nearest hit of a sweep or ray, by bodies the walker can meet, of surfaces that face it.
struct NearestSweep : btCollisionWorld::ClosestConvexResultCallback {
    using ClosestConvexResultCallback::ClosestConvexResultCallback;
    btVector3 way{0, 0, 0};
    btScalar addSingleResult(btCollisionWorld::LocalConvexResult& hit, bool inWorld) override {
        const btVector3 normal =
            inWorld ? hit.m_hitNormalLocal
                    : hit.m_hitCollisionObject->getWorldTransform().getBasis() * hit.m_hitNormalLocal;
        if (normal.dot(way) >= -1e-5f) return m_closestHitFraction;
        return ClosestConvexResultCallback::addSingleResult(hit, inWorld);
    }
};

// The deepest of a capsule's contacts along each direction, summed.
struct Overlaps : btCollisionWorld::ContactResultCallback {
    const btCollisionObject* capsule = nullptr;
    glm::vec3 out{0};
    btScalar addSingleResult(btManifoldPoint& p, const btCollisionObjectWrapper* a, int, int,
                             const btCollisionObjectWrapper*, int, int) override {
        if (p.getDistance() >= 0) return 0;
        const float sign = a->getCollisionObject() == capsule ? 1.0f : -1.0f;
        const glm::vec3 normal = fromBullet(p.m_normalWorldOnB) * sign;
        const float missing = -p.getDistance() - glm::dot(out, normal);
        if (missing > 0) out += normal * missing;
        return 0;
    }
};

}  // namespace

struct PhysicsWorld::Impl {
    btDefaultCollisionConfiguration configuration;
    btCollisionDispatcher dispatcher{&configuration};
    btDbvtBroadphase broadphase;
    btSequentialImpulseConstraintSolver solver;
    btDiscreteDynamicsWorld world{&dispatcher, &broadphase, &solver, &configuration};
    glm::dvec3 origin{0};
    std::vector<Item> items;
    std::vector<BodyId> unused;
    Capsule sweptSize;
    std::unique_ptr<btCapsuleShape> swept;

    Item& at(BodyId id) {
        AG_CHECK_MSG(id < items.size() && items[id].body, "there is no such body");
        return items[id];
    }
    btVector3 local(glm::dvec3 p) const { return toBullet(glm::vec3(p - origin)); }
    btTransform transformOf(const Item& item, glm::dvec3 position, glm::quat rotation) const {
        return btTransform(toBullet(rotation), local(position) + toBullet(rotation * item.center));
    }
    BodyId insert(Item item) {
        item.body->setUserIndex(-1);
        BodyId id = BodyId(items.size());
        if (unused.empty()) {
            items.emplace_back();
        } else {
            id = unused.back();
            unused.pop_back();
        }
        items[id] = std::move(item);
        items[id].body->setUserIndex(int(id));
        join(items[id]);
        return id;
    }
    void join(Item& item) {
        const short mask = item.group == kWalkerGroup    ? short(kSolidGroup)
                           : item.group == kCarriedGroup ? short(kSolidGroup | kCarriedGroup)
                                                         : kAllGroups;
        world.addRigidBody(item.body.get(), item.group, mask);
    }
    const btCapsuleShape& capsuleShape(Capsule c) {
        if (!swept || sweptSize.radius != c.radius || sweptSize.height != c.height) {
            swept = std::make_unique<btCapsuleShape>(c.radius, c.height - 2 * c.radius);
            sweptSize = c;
        }
        return *swept;
    }
    btTransform capsuleAt(Capsule c, glm::dvec3 feet) const {
        return btTransform(btQuaternion::getIdentity(), local(feet + glm::dvec3(0, double(c.height) / 2, 0)));
    }
};

PhysicsWorld::PhysicsWorld(glm::dvec3 origin) : impl_(std::make_unique<Impl>()) {
    impl_->origin = origin;
    impl_->world.setGravity({0, -kGravity, 0});
}

PhysicsWorld::~PhysicsWorld() {
    for (BodyId id = 0; id < impl_->items.size(); ++id)
        if (impl_->items[id].body) remove(id);
}

BodyId PhysicsWorld::add(const Body& b, glm::dvec3 position, glm::quat rotation) {
    Item item{
        .shape = std::make_unique<btBoxShape>(toBullet(b.halfSize)), .kind = b.kind, .center = b.center};
    item.shape->setMargin(std::min(0.02f, 0.2f * std::min({b.halfSize.x, b.halfSize.y, b.halfSize.z})));
    item.mass = b.kind == BodyKind::kDynamic ? b.mass : 0;
    btVector3 inertia(0, 0, 0);
    if (item.mass > 0) item.shape->calculateLocalInertia(item.mass, inertia);
    btRigidBody::btRigidBodyConstructionInfo info(item.mass, nullptr, item.shape.get(), inertia);
    info.m_startWorldTransform = impl_->transformOf(item, position, rotation);
    info.m_friction = b.friction;
    info.m_restitution = b.restitution;
    info.m_linearDamping = b.linearDamping;
    info.m_angularDamping = b.angularDamping;
    item.body = std::make_unique<btRigidBody>(info);
    if (b.kind == BodyKind::kKinematic) {
        item.body->setCollisionFlags(item.body->getCollisionFlags() | btCollisionObject::CF_KINEMATIC_OBJECT);
        item.body->setActivationState(ISLAND_SLEEPING);
    }
    return impl_->insert(std::move(item));
}

BodyId PhysicsWorld::addMesh(std::span<const glm::dvec3> positions, std::span<const uint32_t> indices) {
    Item item{.triangles = std::make_unique<btTriangleMesh>()};
    for (size_t i = 0; i + 2 < indices.size(); i += 3)
        item.triangles->addTriangle(impl_->local(positions[indices[i]]),
                                    impl_->local(positions[indices[i + 1]]),
                                    impl_->local(positions[indices[i + 2]]));
    item.shape = std::make_unique<btBvhTriangleMeshShape>(item.triangles.get(), true);
    item.body =
        std::make_unique<btRigidBody>(btRigidBody::btRigidBodyConstructionInfo(0, nullptr, item.shape.get()));
    return impl_->insert(std::move(item));
}

void PhysicsWorld::addHinge(BodyId id, const Hinge& hinge) {
    Item& item = impl_->at(id);
    AG_CHECK_MSG(item.kind == BodyKind::kDynamic && !item.hinge, "a hinge holds one dynamic body");
    item.hinge = std::make_unique<btHingeConstraint>(*item.body, toBullet(hinge.pivot - item.center),
                                                     toBullet(hinge.axis));
    item.hinge->setLimit(hinge.least, hinge.most);
    impl_->world.addConstraint(item.hinge.get());
}

void PhysicsWorld::remove(BodyId id) {
    Item& item = impl_->at(id);
    if (item.hinge) impl_->world.removeConstraint(item.hinge.get());
    impl_->world.removeRigidBody(item.body.get());
    item = {};
    impl_->unused.push_back(id);
}

void PhysicsWorld::step(float seconds) {
    impl_->world.stepSimulation(seconds, 0);  // no substeps: exactly one step of this length
}

BodyPose PhysicsWorld::pose(BodyId id) const {
    const Item& item = impl_->at(id);
    const btTransform& t = item.body->getWorldTransform();
    const btQuaternion q = t.getRotation();
    const glm::quat rotation(q.w(), q.x(), q.y(), q.z());
    return {.position = glm::dvec3(fromBullet(t.getOrigin()) - rotation * item.center) + impl_->origin,
            .rotation = rotation,
            .velocity = fromBullet(item.body->getLinearVelocity()),
            .awake = item.kind == BodyKind::kDynamic && item.body->isActive()};
}

BodyKind PhysicsWorld::kind(BodyId id) const {
    return impl_->at(id).kind;
}
float PhysicsWorld::mass(BodyId id) const {
    return impl_->at(id).mass;
}
glm::vec3 PhysicsWorld::spin(BodyId id) const {
    return fromBullet(impl_->at(id).body->getAngularVelocity());
}

uint32_t PhysicsWorld::awakeCount() const {
    return uint32_t(std::ranges::count_if(impl_->items, [](const Item& item) {
        return item.body && item.kind == BodyKind::kDynamic && item.body->isActive();
    }));
}

uint32_t PhysicsWorld::bodyCount() const {
    return uint32_t(impl_->items.size() - impl_->unused.size());
}

void PhysicsWorld::moveTo(BodyId id, glm::dvec3 position, glm::quat rotation) {
    Item& item = impl_->at(id);
    const btTransform to = impl_->transformOf(item, position, rotation);
    if (to == item.body->getWorldTransform()) return;
    btVector3 least, most;
    item.shape->getAabb(to, least, most);
    item.body->setWorldTransform(to);
    item.body->setInterpolationWorldTransform(to);
    impl_->world.updateSingleAabb(item.body.get());
    // What rests on it or in its way would go on sleeping.
    for (Item& other : impl_->items) {
        if (!other.body || other.kind != BodyKind::kDynamic || other.body->isActive()) continue;
        btVector3 a, b;
        other.body->getAabb(a, b);
        if (TestAabbAgainstAabb2(a, b, least - btVector3(0.1f, 0.1f, 0.1f),
                                 most + btVector3(0.1f, 0.1f, 0.1f)))
            other.body->activate(true);
    }
}

void PhysicsWorld::place(BodyId id, glm::dvec3 position, glm::quat rotation) {
    Item& item = impl_->at(id);
    const btTransform to = impl_->transformOf(item, position, rotation);
    item.body->setWorldTransform(to);
    item.body->setInterpolationWorldTransform(to);
    setVelocity(id, {}, {});
    impl_->world.updateSingleAabb(item.body.get());
}

void PhysicsWorld::setVelocity(BodyId id, glm::vec3 linear, glm::vec3 angular) {
    btRigidBody& body = *impl_->at(id).body;
    body.setLinearVelocity(toBullet(linear));
    body.setAngularVelocity(toBullet(angular));
    body.activate(true);
}

void PhysicsWorld::push(BodyId id, glm::vec3 impulse, glm::dvec3 at) {
    btRigidBody& body = *impl_->at(id).body;
    body.activate(true);
    body.applyImpulse(toBullet(impulse), impl_->local(at) - body.getCenterOfMassPosition());
}

void PhysicsWorld::setWeightless(BodyId id, bool weightless) {
    btRigidBody& body = *impl_->at(id).body;
    body.setGravity(weightless ? btVector3(0, 0, 0) : impl_->world.getGravity());
    body.activate(true);
}

BodyId PhysicsWorld::addWalker(Capsule capsule, glm::dvec3 feet) {
    Item item{.shape = std::make_unique<btCapsuleShape>(capsule.radius, capsule.height - 2 * capsule.radius),
              .kind = BodyKind::kKinematic,
              .group = kWalkerGroup};
    btRigidBody::btRigidBodyConstructionInfo info(0, nullptr, item.shape.get());
    info.m_startWorldTransform = impl_->capsuleAt(capsule, feet);
    item.body = std::make_unique<btRigidBody>(info);
    item.body->setCollisionFlags(item.body->getCollisionFlags() | btCollisionObject::CF_KINEMATIC_OBJECT);
    item.body->setActivationState(ISLAND_SLEEPING);
    return impl_->insert(std::move(item));
}

void PhysicsWorld::moveWalker(BodyId walker, Capsule capsule, glm::dvec3 feet) {
    Item& item = impl_->at(walker);
    auto& shape = static_cast<btCapsuleShape&>(*item.shape);
    const float half = capsule.height / 2 - capsule.radius;
    if (shape.getHalfHeight() != half)  // crouching
        shape.setImplicitShapeDimensions({capsule.radius, half, capsule.radius});
    const btTransform to = impl_->capsuleAt(capsule, feet);
    item.body->setWorldTransform(to);
    item.body->setInterpolationWorldTransform(to);
    impl_->world.updateSingleAabb(item.body.get());
}

void PhysicsWorld::setCarried(BodyId id, bool carried) {
    Item& item = impl_->at(id);
    impl_->world.removeRigidBody(item.body.get());
    item.group = carried ? kCarriedGroup : kSolidGroup;
    impl_->join(item);  // which also gives it its weight back
    setWeightless(id, carried);
}

std::optional<BodyHit> PhysicsWorld::sweep(Capsule capsule, glm::dvec3 fromFeet, glm::dvec3 toFeet) const {
    const btTransform from = impl_->capsuleAt(capsule, fromFeet), to = impl_->capsuleAt(capsule, toFeet);
    NearestSweep nearest(from.getOrigin(), to.getOrigin());
    nearest.way = to.getOrigin() - from.getOrigin();
    nearest.m_collisionFilterGroup = kWalkerGroup;
    nearest.m_collisionFilterMask = kSolidGroup;
    impl_->world.convexSweepTest(&impl_->capsuleShape(capsule), from, to, nearest);
    if (!nearest.hasHit()) return std::nullopt;
    return BodyHit{.body = BodyId(nearest.m_hitCollisionObject->getUserIndex()),
                   .share = nearest.m_closestHitFraction,
                   .normal = fromBullet(nearest.m_hitNormalWorld.normalized()),
                   .position = glm::dvec3(fromBullet(nearest.m_hitPointWorld)) + impl_->origin};
}

std::optional<BodyHit> PhysicsWorld::ray(glm::dvec3 from, glm::dvec3 to) const {
    btCollisionWorld::ClosestRayResultCallback nearest(impl_->local(from), impl_->local(to));
    nearest.m_collisionFilterGroup = kWalkerGroup;
    nearest.m_collisionFilterMask = kSolidGroup;
    impl_->world.rayTest(impl_->local(from), impl_->local(to), nearest);
    if (!nearest.hasHit()) return std::nullopt;
    return BodyHit{.body = BodyId(nearest.m_collisionObject->getUserIndex()),
                   .share = nearest.m_closestHitFraction,
                   .normal = fromBullet(nearest.m_hitNormalWorld),
                   .position = glm::dvec3(fromBullet(nearest.m_hitPointWorld)) + impl_->origin};
}

glm::vec3 PhysicsWorld::wayOut(Capsule capsule, glm::dvec3 feet) const {
    btCollisionObject probe;
    probe.setCollisionShape(const_cast<btCapsuleShape*>(&impl_->capsuleShape(capsule)));
    probe.setWorldTransform(impl_->capsuleAt(capsule, feet));
    Overlaps overlaps;
    overlaps.capsule = &probe;
    overlaps.m_collisionFilterGroup = kWalkerGroup;
    overlaps.m_collisionFilterMask = kSolidGroup;
    impl_->world.contactTest(&probe, overlaps);
    return overlaps.out;
}

}  // namespace ag
