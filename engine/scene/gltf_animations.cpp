// Animations: what moves nodes, key by key.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "engine/scene/gltf_internal.h"

namespace ag::gltf {
namespace {

constexpr float kMostValue = 1e12f;
constexpr float kLongest = 1e7f;  // s: floats are still fine to a second

struct Names {
    std::string_view text;
    uint32_t value;
};
constexpr std::array<Names, 3> kPaths = {{{"translation", uint32_t(ChannelPath::kTranslation)},
                                          {"rotation", uint32_t(ChannelPath::kRotation)},
                                          {"scale", uint32_t(ChannelPath::kScale)}}};
constexpr std::array<Names, 3> kInterpolations = {{{"STEP", uint32_t(Interpolation::kStep)},
                                                   {"LINEAR", uint32_t(Interpolation::kLinear)},
                                                   {"CUBICSPLINE", uint32_t(Interpolation::kCubic)}}};

const Names* find(const std::array<Names, 3>& names, const std::string& text) {
    const auto found = std::ranges::find(names, std::string_view(text), &Names::text);
    return found == names.end() ? nullptr : &*found;
}

Fault checkChannel(const tinygltf::Model& model, const tinygltf::Animation& animation,
                   const tinygltf::AnimationChannel& c, const std::string& what) {
    const auto named = [&](int index) { return index >= 0 && size_t(index) < model.accessors.size(); };
    if (c.sampler < 0 || size_t(c.sampler) >= animation.samplers.size())
        return fmt::format("{} names sampler {}, which does not exist", what, c.sampler);
    if (c.target_node != -1 && (c.target_node < 0 || size_t(c.target_node) >= model.nodes.size()))
        return fmt::format("{} names node {}, which does not exist", what, c.target_node);
    const tinygltf::AnimationSampler& s = animation.samplers[size_t(c.sampler)];
    if (!named(s.input) || !named(s.output))
        return fmt::format("{} names accessor {}, which does not exist", what,
                           named(s.input) ? s.output : s.input);
    if (!find(kInterpolations, s.interpolation))
        return fmt::format("{} has the unknown interpolation '{}'", what, s.interpolation);
    if (c.target_path == "weights") return std::nullopt;
    const Names* path = find(kPaths, c.target_path);
    if (!path) return fmt::format("{} moves '{}', which no node has", what, c.target_path);
    const tinygltf::Accessor &times = model.accessors[size_t(s.input)],
                             &values = model.accessors[size_t(s.output)];
    if (times.type != TINYGLTF_TYPE_SCALAR || times.componentType != TINYGLTF_COMPONENT_TYPE_FLOAT ||
        times.count == 0)
        return what + " has times that are not floats";
    const bool turns = path->value == uint32_t(ChannelPath::kRotation);
    if (values.type != (turns ? TINYGLTF_TYPE_VEC4 : TINYGLTF_TYPE_VEC3) ||
        (values.componentType != TINYGLTF_COMPONENT_TYPE_FLOAT && !(turns && values.normalized)))
        return fmt::format("{} has values that are no {}", what, c.target_path);
    const uint64_t perTime = s.interpolation == "CUBICSPLINE" ? 3 : 1;
    if (values.count != times.count * perTime)
        return fmt::format("{} has {} values for {} times", what, values.count, times.count);
    return std::nullopt;
}

Fault readTimes(const tinygltf::Model& model, int accessor, const std::string& what, SceneChannel& out) {
    out.times = readFloats(model, accessor, 1);
    for (size_t i = 0; i < out.times.size(); ++i) {
        if (!(out.times[i] >= 0 && out.times[i] < kLongest))
            return fmt::format("{} has a time that is negative, not finite or later than {:g} s (key {})",
                               what, kLongest, i);
        if (i > 0 && out.times[i] <= out.times[i - 1])
            return fmt::format("{} has times that do not rise (key {})", what, i);
    }
    return std::nullopt;
}

Fault readValues(const tinygltf::Model& model, int accessor, const std::string& what, SceneChannel& out) {
    const bool turns = out.path == ChannelPath::kRotation, cubic = out.interpolation == Interpolation::kCubic;
    const size_t components = turns ? 4 : 3;
    const std::vector<float> values = readFloats(model, accessor, int(components));
    out.values.assign(values.size() / components, glm::vec4(0));
    for (size_t i = 0; i < values.size(); ++i) {
        if (!(std::abs(values[i]) < kMostValue)) return what + " has a value that is not finite";
        out.values[i / components][int(i % components)] = values[i];
    }
    if (!turns) return std::nullopt;
    for (size_t i = cubic ? 1 : 0; i < out.values.size(); i += cubic ? 3 : 1) {
        const float length = glm::length(out.values[i]);
        out.values[i] = length > 1e-6f ? out.values[i] / length : glm::vec4(0, 0, 0, 1);
    }
    return std::nullopt;
}

}  // namespace

Fault checkAnimations(const tinygltf::Model& model, const ImportLimits& limits) {
    uint64_t values = 0;
    for (size_t i = 0; i < model.animations.size(); ++i) {
        const tinygltf::Animation& animation = model.animations[i];
        for (size_t c = 0; c < animation.channels.size(); ++c) {
            const tinygltf::AnimationChannel& channel = animation.channels[c];
            if (Fault f =
                    checkChannel(model, animation, channel, fmt::format("animation {} channel {}", i, c)))
                return f;
            const auto& output = animation.samplers[size_t(channel.sampler)].output;
            values += 4 * model.accessors[size_t(output)].count;  // channels may share them
            if (values > limits.keyValues) return "its animations together have more keys than the limit";
        }
    }
    return std::nullopt;
}

Fault importAnimations(const tinygltf::Model& model, std::span<const int32_t> newIndex, SceneAsset& asset) {
    bool morphs = false;
    for (size_t i = 0; i < model.animations.size(); ++i) {
        const tinygltf::Animation& from = model.animations[i];
        SceneAnimation animation{.name = from.name};
        for (size_t c = 0; c < from.channels.size(); ++c) {
            const tinygltf::AnimationChannel& channel = from.channels[c];
            morphs = morphs || channel.target_path == "weights";
            const Names* path = find(kPaths, channel.target_path);
            const int32_t node = channel.target_node < 0 ? -1 : newIndex[size_t(channel.target_node)];
            if (!path || node < 0) continue;
            const tinygltf::AnimationSampler& s = from.samplers[size_t(channel.sampler)];
            SceneChannel out{.node = uint32_t(node),
                             .path = ChannelPath(path->value),
                             .interpolation = Interpolation(find(kInterpolations, s.interpolation)->value)};
            const std::string what = fmt::format("animation {} channel {}", i, c);
            if (Fault f = readTimes(model, s.input, what, out)) return f;
            if (Fault f = readValues(model, s.output, what, out)) return f;
            animation.duration = std::max(animation.duration, out.times.back());
            animation.channels.push_back(std::move(out));
        }
        asset.animations.push_back(std::move(animation));
    }
    if (morphs) asset.warnings.push_back("its morph targets are not animated");
    return std::nullopt;
}

}  // namespace ag::gltf
