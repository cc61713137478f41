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

// Of waves that lean no way on average, whatever their map is scaled by: the mean of their cosines to a
// light.
TEST(Brdf, BumpsReceiveTheMeanOfTheirCosines) {
    const glm::vec3 light = glm::normalize(glm::vec3(0.3f, 0.1f, 1));
    for (const float scale : {1.0f, 0.5f}) {
        glm::vec3 mapped(0);
        double lit = 0;
        for (int i = 0; i < 256; ++i) {
            const float phase = float(i) * 2 * kPi / 256;
            const glm::vec3 n = glm::normalize(glm::vec3(0.5f * std::sin(phase), 0.5f * std::cos(phase), 1));
            mapped += n / 256.0f;
            lit += double(glm::dot(glm::normalize(glm::vec3(scale * glm::vec2(n), n.z)), light)) / 256;
            EXPECT_NEAR(bumpCosine(n, scale), 1 / glm::length(glm::vec3(scale * glm::vec2(n) / n.z, 1)),
                        1e-5);
        }
        if (scale == 1) {
            EXPECT_NEAR(bumpCosine(mapped, scale) * light.z, lit, 1e-5);
        }
    }
    EXPECT_EQ(bumpCosine(glm::vec3(0), 1), 1);
}

}  // namespace
}  // namespace ag::io
