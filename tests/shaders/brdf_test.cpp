// Drawing half vectors by the lobe: what it weighs must come to what the lobe reflects.
#include <gtest/gtest.h>

#include "common/brdf.h"
#include "common/sampling.h"

namespace ag::io {
namespace {

// Of light from everywhere, with Fresnel's term 1, by midpoints over half vectors and by drawing them.
double reflectedByQuadrature(vec3 v, float alpha) {
    constexpr int kSteps = 1500;
    double sum = 0;
    for (int i = 0; i < kSteps; ++i)
        for (int j = 0; j < kSteps; ++j) {
            // Tangents about the lobe's width get as many steps as the long tail.
            const double s = (i + 0.5) / kSteps, tangent = alpha * s / (1 - s),
                         phi = 2 * kPi * (j + 0.5) / kSteps;
            const double c = 1 / std::sqrt(1 + tangent * tangent), sine = tangent * c;
            const vec3 h(float(sine * std::cos(phi)), float(sine * std::sin(phi)), float(c));
            const vec3 l = 2 * dot(v, h) * h - v;
            if (dot(v, h) <= 0 || l.z <= 0) continue;
            const double solidAngle = sine * c * c * alpha / ((1 - s) * (1 - s)) / kSteps * 2 * kPi / kSteps;
            sum += double(ggxDistribution(h.z, alpha) * smithMasking(v.z, alpha) * smithMasking(l.z, alpha) *
                          dot(v, h) / v.z) *
                   solidAngle;
        }
    return sum;
}

double reflectedByDraws(vec3 v, float alpha) {
    constexpr uint kDraws = 1u << 16;
    double sum = 0;
    for (uint i = 0; i < kDraws; ++i) {
        const vec3 h = visibleHalfVector(v, alpha, hammersley(i, kDraws)), l = 2 * dot(v, h) * h - v;
        if (l.z > 0) sum += double(smithMasking(l.z, alpha));
    }
    return sum / kDraws;
}

TEST(Brdf, VisibleHalfVectorsReflectWhatTheLobeDoes) {
    for (const float alpha : {0.02f, 0.3f, 1.0f})
        for (const float cosine : {1.0f, 0.6f, 0.15f}) {
            const vec3 v(std::sqrt(1 - cosine * cosine), 0, cosine);
            EXPECT_NEAR(reflectedByDraws(v, alpha), reflectedByQuadrature(v, alpha), 0.004)
                << alpha << ' ' << cosine;
        }
}

// Of light from everywhere: lobe and base, each by draws of its own.
vec3 reflectedOfEvenLight(vec3 base, float metallic, float roughness) {
    constexpr uint kDraws = 1u << 15;
    const float alpha = std::max(roughness * roughness, kLeastAlpha);
    const vec3 f0 = specularF0(base, metallic, 1), f90(specularF90(metallic, 1));
    vec3 sum(0);
    for (uint i = 0; i < kDraws; ++i) {
        const float c = std::sqrt(radicalInverse3(i)), lower = std::sqrt(hashToUnit(i));
        const vec3 v(std::sqrt(1 - c * c), 0, c);
        const vec2 xi = hammersley(i, kDraws);
        const vec3 h = visibleHalfVector(v, alpha, xi), l = 2 * dot(v, h) * h - v;
        if (l.z > 0) sum += fresnelSchlick(f0, f90, dot(v, h)) * smithMasking(l.z, alpha);
        const float across = std::sqrt(1 - lower * lower), phi = 2 * kPi * xi.y;
        const vec3 under(across * std::cos(phi), across * std::sin(phi), lower);
        const vec3 kept = fresnelSchlick(f0, f90, dot(v, normalize(v + under)));
        sum += (1.0f - kept) * diffuseAlbedo(base, metallic);
    }
    return sum / float(kDraws);
}

TEST(Brdf, WholeReflectanceIsThatOfEvenLight) {
    for (const float roughness : {0.05f, 0.3f, 0.5f, 0.8f, 1.0f})
        for (const float metallic : {0.0f, 0.5f, 1.0f}) {
            const vec3 base(0.8f, 0.5f, 0.1f), truth = reflectedOfEvenLight(base, metallic, roughness),
                                               fit = wholeReflectance(base, metallic, roughness, 1);
            for (int k = 0; k < 3; ++k)
                EXPECT_NEAR(fit[k], truth[k], 0.006) << roughness << ' ' << metallic;
        }
    EXPECT_EQ(wholeReflectance(vec3(0.3f), 0, 1, 0), vec3(0.3f)) << "Lambert";
}

TEST(Brdf, ShareOfDirectionIsTheBrdfOverADiffuseOne) {
    const vec3 n(0, 0, 1), l = normalize(vec3(0.8f, 0, 0.6f));
    for (const float roughness : {0.2f, 0.5f, 1.0f})
        for (const float metallic : {0.0f, 1.0f}) {
            const vec3 base(0.8f, 0.5f, 0.1f), f0 = specularF0(base, metallic, 1);
            const vec3 whole = wholeReflectance(base, metallic, roughness, 1);
            for (const vec3 v : {vec3(-0.8f, 0, 0.6f), vec3(-0.6f, 0.1f, 0.8f), vec3(0.5f, 0.5f, 0.7f)}) {
                const vec3 to = normalize(v);
                const vec3 share =
                    shareOfDirection(vec4(whole, (f0.x + f0.y + f0.z) / 3), roughness, n, to, l);
                const vec3 truth = metallicRoughnessBrdf(n, to, l, base, metallic, roughness, 1);
                for (int k = 0; k < 3; ++k)
                    EXPECT_NEAR(share[k] * whole[k] * kInvPi, truth[k], 0.002f + 0.12f * truth[k])
                        << roughness << ' ' << metallic << ' ' << k;
            }
        }
}

TEST(Brdf, MeanFresnelIsThatOfEvenLight) {
    constexpr uint kDraws = 1u << 14;
    for (const float c : {0.0f, 0.3f, 0.7f, 1.0f}) {
        const vec3 v(std::sqrt(1 - c * c), 0, c);
        float sum = 0;
        for (uint i = 0; i < kDraws; ++i) {
            const vec2 xi = hammersley(i, kDraws);
            const float across = std::sqrt(xi.x), phi = 2 * kPi * xi.y;
            const vec3 l(across * std::cos(phi), across * std::sin(phi), std::sqrt(1 - xi.x));
            sum += fresnelSchlick(vec3(0.04f), vec3(1), dot(v, normalize(v + l))).x;
        }
        EXPECT_NEAR(meanFresnel(vec3(0.04f), vec3(1), c).x, sum / float(kDraws), 0.0005f) << c;
    }
}

struct Bumps {
    std::vector<glm::vec3> normals;
    glm::vec3 mean{0};
};

// Waves whose slopes reach `steepest`, and which lean no way on average.
Bumps waves(float steepest) {
    Bumps b;
    for (int i = 0; i < 64; ++i)
        for (int j = 0; j < 8; ++j) {
            const float phase = float(i) * 2 * kPi / 64, slope = steepest * (float(j) + 0.5f) / 8;
            b.normals.push_back(
                glm::normalize(glm::vec3(slope * std::sin(phase), slope * std::cos(phase), 1)));
            b.mean += b.normals.back() / 512.0f;
        }
    return b;
}

// A bump that turns away from the light takes nothing from those that face it.
TEST(Brdf, BumpsReceiveTheMeanOfTheirCosines) {
    for (const float steepest : {0.2f, 0.6f, 1.0f})
        for (const float cosine : {0.9f, 0.6f, 0.4f, 0.2f}) {
            const Bumps b = waves(steepest);
            const glm::vec3 light(std::sqrt(1 - cosine * cosine), 0, cosine);
            double lit = 0;
            for (const glm::vec3 n : b.normals)
                lit += std::max(double(glm::dot(n, light)), 0.0) / 512;
            EXPECT_NEAR(bumpCosine(b.mean, light, cosine) / lit, 1, 0.07) << steepest << ", " << cosine;
            EXPECT_NEAR(bumpCosine(b.normals[0], b.normals[0], cosine), 1, 1e-6);
            EXPECT_NEAR(bumpCosine(b.normals[0], -b.normals[0], cosine), 0, 1e-6);
        }
}

// Light from everywhere above the surface: quadrature over the hemisphere.
TEST(Brdf, BumpsReceiveTheirShareOfLightFromEverywhere) {
    const Bumps b = waves(0.8f);
    constexpr uint kDirections = 1u << 10;
    double lit = 0;
    for (uint i = 0; i < kDirections; ++i) {
        const vec2 xi = hammersley(i, kDirections);
        const float across = std::sqrt(xi.x * (2 - xi.x)), phi = 2 * kPi * xi.y;
        const glm::vec3 l(across * std::cos(phi), across * std::sin(phi), 1 - xi.x);
        for (const glm::vec3 n : b.normals)
            lit += std::max(double(glm::dot(n, l)), 0.0) * 2 / kDirections / double(b.normals.size());
    }
    EXPECT_NEAR(bumpShareOfHemisphere(b.mean, 1), lit, 0.002);
    EXPECT_EQ(bumpShareOfHemisphere(glm::vec3(0), 1), 1);
}

// A single normal stays one when its strength is scaled, and the mean of several keeps its length.
TEST(Brdf, ScaledBumpsKeepTheirLength) {
    const glm::vec3 n = glm::normalize(glm::vec3(0.6f, -0.3f, 1));
    EXPECT_LT(glm::distance(scaledBumps(n, 0.5f), glm::normalize(glm::vec3(0.3f, -0.15f, 1))), 1e-6f);
    EXPECT_LT(glm::distance(scaledBumps(0.7f * n, 1), 0.7f * n), 1e-6f);
    EXPECT_EQ(scaledBumps(glm::vec3(0), 1), glm::vec3(0, 0, 1));
}

}  // namespace
}  // namespace ag::io
