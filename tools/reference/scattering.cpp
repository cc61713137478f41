#include "tools/reference/scattering.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "common/brdf.h"
#include "common/sampling.h"

namespace ag::reference {
namespace {

constexpr float kPi = std::numbers::pi_v<float>, kInvPi = std::numbers::inv_pi_v<float>;

glm::vec3 inFrame(glm::vec3 normal, float sine, float cosine, float phi) {
    glm::vec3 t, b;
    io::orthonormalBasis(normal, t, b);
    return t * (sine * std::cos(phi)) + b * (sine * std::sin(phi)) + normal * cosine;
}

bool hasSpecular(const Surface& s, bool glossy) {
    return glossy && (s.specular > 0 || s.metallic > 0);
}

}  // namespace

glm::vec3 brdf(const Surface& s, glm::vec3 toViewer, glm::vec3 toLight, bool glossy) {
    if (!glossy) return s.albedo * kInvPi;
    return io::metallicRoughnessBrdf(s.normal, toViewer, toLight, s.baseColor, s.metallic, s.roughness,
                                     s.specular);
}

float densityOf(const Surface& s, glm::vec3 toViewer, glm::vec3 direction, bool glossy) {
    const float nl = glm::dot(s.normal, direction);
    if (nl <= 0) return 0;
    if (!hasSpecular(s, glossy)) return nl * kInvPi;
    const float alpha = std::max(s.roughness * s.roughness, io::kLeastAlpha);
    const glm::vec3 h = glm::normalize(toViewer + direction);
    const float nh = glm::dot(s.normal, h), vh = std::max(glm::dot(toViewer, h), 1e-6f);
    return 0.5f * nl * kInvPi + 0.5f * io::ggxDistribution(nh, alpha) * nh / (4 * vh);
}

DirectionSample sampleDirection(const Surface& s, glm::vec3 toViewer, bool glossy, float u, float v,
                                float choice) {
    DirectionSample out;
    const float phi = 2 * kPi * v;
    const bool specular = hasSpecular(s, glossy);
    if (!specular || choice < 0.5f) {
        out.direction = inFrame(s.normal, std::sqrt(u), std::sqrt(std::max(1 - u, 0.0f)), phi);
        if (!specular) {
            out.density = std::sqrt(std::max(1 - u, 0.0f)) * kInvPi;
            out.incident = kPi;
            out.reflected = s.albedo;
            return out;
        }
    }
    if (choice >= 0.5f) {
        const float alpha = std::max(s.roughness * s.roughness, io::kLeastAlpha), a2 = alpha * alpha;
        const float cosine = std::sqrt((1 - u) / (1 + (a2 - 1) * u));
        const glm::vec3 h = inFrame(s.normal, std::sqrt(std::max(1 - cosine * cosine, 0.0f)), cosine, phi);
        out.direction = glm::reflect(-toViewer, h);
    }
    const float nl = glm::dot(s.normal, out.direction);
    if (nl <= 0) return {};
    out.density = densityOf(s, toViewer, out.direction, glossy);
    out.incident = nl / out.density;
    out.reflected = brdf(s, toViewer, out.direction, glossy) * out.incident;
    return out;
}

}  // namespace ag::reference
