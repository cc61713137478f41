#include "tools/scenegen/builder.h"

#include <array>
#include <cmath>

namespace ag::scenegen {

glm::quat lookRotation(glm::vec3 direction) {
    const glm::vec3 back = -glm::normalize(direction);
    const glm::vec3 up = std::abs(back.y) > 0.999f ? glm::vec3(0, 0, 1) : glm::vec3(0, 1, 0);
    const glm::vec3 right = glm::normalize(glm::cross(up, back));
    return glm::quat_cast(glm::mat3(right, glm::cross(back, right), back));
}

uint32_t SceneBuilder::material(const std::string& name, glm::vec3 albedo) {
    return emissive(name, albedo, {});
}

uint32_t SceneBuilder::emissive(const std::string& name, glm::vec3 albedo, glm::vec3 radiance) {
    Material m;
    m.name = name;
    m.baseColor = glm::vec4(albedo, 1);
    m.emissive = radiance;
    m.metallic = 0;
    m.roughness = 1;
    m.specular = 0;
    asset_.geometry.materials.push_back(m);
    return uint32_t(asset_.geometry.materials.size() - 1);
}

uint32_t SceneBuilder::addNode(SceneNode node) {
    asset_.nodes.push_back(std::move(node));
    return uint32_t(asset_.nodes.size() - 1);
}

uint32_t SceneBuilder::beginMesh(const std::string& name) {
    asset_.meshes.push_back({name, uint32_t(asset_.geometry.primitives.size()), 0});
    return uint32_t(asset_.meshes.size() - 1);
}

// A quad joins the mesh's last primitive when that has its material.
void SceneBuilder::addQuad(glm::vec3 corner, glm::vec3 u, glm::vec3 v, uint32_t material) {
    GeometryArrays& g = asset_.geometry;
    SceneMesh& mesh = asset_.meshes.back();
    if (mesh.primitiveCount == 0 || g.primitives.back().material != material) {
        g.primitives.push_back({.firstIndex = uint32_t(g.indices.size()),
                                .vertexOffset = int32_t(g.positions.size()),
                                .material = material});
        ++mesh.primitiveCount;
    }
    Primitive& primitive = g.primitives.back();
    const uint32_t first = uint32_t(g.positions.size()) - uint32_t(primitive.vertexOffset);
    const glm::vec3 normal = glm::normalize(glm::cross(u, v));
    for (const glm::vec2 at : {glm::vec2(0, 0), glm::vec2(1, 0), glm::vec2(1, 1), glm::vec2(0, 1)}) {
        const glm::vec3 p = corner + u * at.x + v * at.y;
        g.positions.push_back(p);
        g.attributes.push_back({normal, glm::vec4(glm::normalize(u), 1), at});
        primitive.boundsLocal.add(p);
    }
    for (const uint32_t i : {0, 1, 2, 0, 2, 3})
        g.indices.push_back(first + i);
    primitive.indexCount += 6;
}

uint32_t SceneBuilder::quad(const std::string& name, glm::vec3 corner, glm::vec3 u, glm::vec3 v,
                            uint32_t material) {
    const uint32_t mesh = beginMesh(name);
    addQuad(corner, u, v, material);
    return addNode({.name = name, .mesh = int32_t(mesh)});
}

uint32_t SceneBuilder::box(const std::string& name, glm::vec3 center, glm::vec3 size, uint32_t material,
                           float yaw) {
    const uint32_t mesh = beginMesh(name);
    for (int axis = 0; axis < 3; ++axis) {
        for (const float side : {-1.0f, 1.0f}) {
            glm::vec3 u(0), v(0), corner = -0.5f * size;
            u[(axis + 1) % 3] = size[(axis + 1) % 3];
            v[(axis + 2) % 3] = size[(axis + 2) % 3];
            if (side < 0) std::swap(u, v);
            if (side > 0) corner[axis] = 0.5f * size[axis];
            addQuad(corner, u, v, material);
        }
    }
    SceneNode node{.name = name, .mesh = int32_t(mesh)};
    node.local.translation = glm::dvec3(center);
    node.local.rotation = glm::angleAxis(yaw, glm::vec3(0, 1, 0));
    return addNode(std::move(node));
}

uint32_t SceneBuilder::model(const std::string& name, const MeshParts& parts, glm::vec3 center, float yaw) {
    const uint32_t mesh = beginMesh(name);
    GeometryArrays& g = asset_.geometry;
    for (const MeshPart& part : parts) {
        Primitive p{.firstIndex = uint32_t(g.indices.size()),
                    .indexCount = uint32_t(part.indices.size()),
                    .vertexOffset = int32_t(g.positions.size()),
                    .material = part.material};
        for (size_t i = 0; i < part.positions.size(); ++i) {
            g.positions.push_back(part.positions[i]);
            g.attributes.push_back({part.normals[i], glm::vec4(0), {}});
            p.boundsLocal.add(part.positions[i]);
        }
        g.indices.insert(g.indices.end(), part.indices.begin(), part.indices.end());
        g.primitives.push_back(p);
        ++asset_.meshes[mesh].primitiveCount;
    }
    const uint32_t node = place(name, center, yaw);
    asset_.nodes[node].mesh = int32_t(mesh);
    return node;
}

uint32_t SceneBuilder::place(const std::string& name, glm::vec3 center, float yaw) {
    SceneNode node{.name = name};
    node.local.translation = glm::dvec3(center);
    node.local.rotation = glm::angleAxis(yaw, glm::vec3(0, 1, 0));
    return addNode(std::move(node));
}

void SceneBuilder::attach(uint32_t child, uint32_t parent) {
    asset_.nodes[child].parent = int32_t(parent);
    asset_.nodes[child].depth = asset_.nodes[parent].depth + 1;
}

uint32_t SceneBuilder::copy(uint32_t source, const std::string& name, glm::vec3 center, float yaw) {
    SceneNode node{.name = name, .mesh = asset_.nodes[source].mesh};
    node.local.translation = glm::dvec3(center);
    node.local.rotation = glm::angleAxis(yaw, glm::vec3(0, 1, 0));
    return addNode(std::move(node));
}

void SceneBuilder::room(const std::string& name, glm::vec3 min, glm::vec3 max,
                        const std::array<uint32_t, 6>& materials) {
    const uint32_t mesh = beginMesh(name);
    const glm::vec3 size = max - min;
    for (int face = 0; face < 6; ++face) {
        if (materials[size_t(face)] == ~0u) continue;
        const int axis = face / 2;
        glm::vec3 u(0), v(0), corner = min;
        u[(axis + 1) % 3] = size[(axis + 1) % 3];
        v[(axis + 2) % 3] = size[(axis + 2) % 3];
        if (face % 2 == 1) {
            corner[axis] = max[axis];
            std::swap(u, v);  // the inside is the front
        }
        addQuad(corner, u, v, materials[size_t(face)]);
    }
    addNode({.name = name, .mesh = int32_t(mesh)});
}

uint32_t SceneBuilder::addLight(SceneLight light, glm::vec3 position, glm::vec3 direction) {
    SceneNode node{.name = light.name, .light = int32_t(asset_.lights.size())};
    node.local.translation = glm::dvec3(position);
    node.local.rotation = lookRotation(direction);
    asset_.lights.push_back(std::move(light));
    return addNode(std::move(node));
}

uint32_t SceneBuilder::spot(const std::string& name, glm::vec3 position, glm::vec3 direction,
                            glm::vec3 intensity, SpotCone cone, float range) {
    return addLight(
        {name, LightKind::kSpot, intensity, range, glm::radians(cone.inner), glm::radians(cone.outer)},
        position, direction);
}

uint32_t SceneBuilder::point(const std::string& name, glm::vec3 position, glm::vec3 intensity, float range) {
    return addLight({name, LightKind::kPoint, intensity, range}, position, {0, -1, 0});
}

uint32_t SceneBuilder::sun(const std::string& name, glm::vec3 direction, glm::vec3 irradiance) {
    return addLight({name, LightKind::kDirectional, irradiance}, {}, direction);
}

uint32_t SceneBuilder::camera(const std::string& name, glm::vec3 position, glm::vec3 target,
                              float verticalFovDegrees) {
    SceneNode node{.name = name, .camera = int32_t(asset_.cameras.size())};
    node.local.translation = glm::dvec3(position);
    node.local.rotation = lookRotation(target - position);
    asset_.cameras.push_back({name, glm::radians(verticalFovDegrees), 0.05f});
    return addNode(std::move(node));
}

}  // namespace ag::scenegen
