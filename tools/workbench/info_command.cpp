#include <fmt/format.h>

#include <iostream>
#include <nlohmann/json.hpp>

#include "engine/gpu/device.h"
#include "engine/scene/static_scene.h"
#include "tools/scenegen/scenes.h"
#include "tools/workbench/commands.h"
#include "tools/workbench/scene_options.h"

namespace ag::workbench {
namespace {

std::string groupsOf(const gpu::Lanes& lanes) {
    return fmt::format("{} lanes, {}", lanes.count,
                       lanes.shared      ? "shared memory"
                       : lanes.requested ? "a subgroup of that size asked for"
                                         : "a subgroup");
}

struct InfoOptions {
    std::string scene;
    uint32_t param = 0;
    bool json = false;
    std::vector<std::string> without;
};

constexpr const char* supportName(FeatureSupport support) {
    switch (support) {
        case FeatureSupport::kUsed:
            return "used";
        case FeatureSupport::kApproximated:
            return "approximated";
        case FeatureSupport::kNotSupported:
            return "not supported";
    }
    return "";
}

struct SceneCount {
    const char* name;
    uint64_t count;
};

std::vector<SceneCount> countsOf(const SceneAsset& asset) {
    uint64_t images = 0;
    for (const TextureLayers& layers : asset.geometry.textures)
        images += layers.srgb.size() + layers.linear.size();
    const auto cameras = uint64_t(std::ranges::count_if(asset.nodes, [](auto& n) { return n.camera >= 0; }));
    return {{"triangles", triangleCount(asset)},
            {"vertices", asset.geometry.positions.size()},
            {"nodes", asset.nodes.size()},
            {"materials", asset.geometry.materials.size()},
            {"texture layers", images},
            {"lights", uint64_t(std::ranges::count_if(asset.nodes, [](auto& n) { return n.light >= 0; }))},
            {"cameras", cameras},
            {"animations", asset.animations.size()}};
}

nlohmann::json featureRow(const SceneFeature& f) {
    return {{"feature", f.name}, {"uses", f.uses}, {"support", supportName(f.support)}, {"note", f.note}};
}

nlohmann::json sceneReport(const SceneAsset& asset, const Bounds& bounds) {
    nlohmann::json report = {
        {"scene", asset.name}, {"features", nlohmann::json::array()}, {"warnings", asset.warnings}};
    for (const SceneCount& c : countsOf(asset))
        report[c.name] = c.count;
    if (!bounds.empty())
        report["bounds"] = {{bounds.min.x, bounds.min.y, bounds.min.z},
                            {bounds.max.x, bounds.max.y, bounds.max.z}};
    for (const SceneFeature& f : asset.features)
        report["features"].push_back(featureRow(f));
    return report;
}

void printScene(const SceneAsset& asset, const Bounds& bounds) {
    for (const SceneCount& c : countsOf(asset))
        std::cout << fmt::format("{:<16} {}\n", c.name, c.count);
    if (!bounds.empty())
        std::cout << fmt::format("bounds           ({:g}, {:g}, {:g}) to ({:g}, {:g}, {:g}) m\n",
                                 bounds.min.x, bounds.min.y, bounds.min.z, bounds.max.x, bounds.max.y,
                                 bounds.max.z);
    for (const SceneFeature& f : asset.features)
        std::cout << fmt::format("{:<16} {} ({}){}{}\n", supportName(f.support), f.name, f.uses,
                                 f.note.empty() ? "" : ": ", f.note);
    for (const std::string& warning : asset.warnings)
        std::cout << "warning          " << warning << '\n';
}

int runSceneInfo(const InfoOptions& options) {
    const auto file = withLibraryScene({.scene = options.scene});
    if (!file) return refuse(file.error().message);
    const auto asset = scenegen::resolveScene(file->scene, options.param);
    if (!asset) return refuse(asset.error().message);
    const Bounds bounds = staticScene(*asset, glm::dvec3(0)).bounds;
    if (options.json)
        std::cout << sceneReport(*asset, bounds).dump(2, ' ', false, nlohmann::json::error_handler_t::replace)
                  << '\n';
    else
        printScene(*asset, bounds);
    return 0;
}

int runDeviceInfo(const std::vector<std::string>& without) {
    auto device = gpu::Device::create({.without = without});
    if (!device) return refuse(device.error().message);
    const gpu::DeviceInfo& info = (*device)->info();
    const VkPhysicalDeviceLimits& limits = info.limits;
    std::cout << fmt::format("device             {}\ndriver             {}\nVulkan             {}.{}.{}\n",
                             info.name, info.driver, VK_API_VERSION_MAJOR(info.apiVersion),
                             VK_API_VERSION_MINOR(info.apiVersion), VK_API_VERSION_PATCH(info.apiVersion));
    std::cout << fmt::format("subgroup           {} lanes\ngroups             {}\nkernels            {}\n",
                             info.subgroupSize, groupsOf(info.lanes),
                             info.isCpu ? "lane-parallel loads (CPU device)" : "uniform loads (GPU)");
    std::cout << fmt::format("timestamps         {}\n", info.timestampPeriodNs > 0
                                                            ? fmt::format("{} ns", info.timestampPeriodNs)
                                                            : "none");
    std::cout << fmt::format(
        "storage buffer     {} MiB at most\nimage              {} texels a side, {} layers\n"
        "texel buffers      {}\n",
        limits.maxStorageBufferRange >> 20, limits.maxImageDimension2D, limits.maxImageArrayLayers,
        info.storageTexels ? "too small: storage buffers instead" : "as large as any other");
    VkPhysicalDeviceLimits all = limits;
    for (const gpu::DeviceLimit& limit : gpu::deviceLimits())
        std::cout << fmt::format("limit              {:<36} {:>10} {:>10}\n", limit.name, limit.least,
                                 limit.of(all));
    for (const std::string& name : info.enabled)
        std::cout << "on                 " << name << '\n';
    for (const std::string& name : info.missing)
        std::cout << "off                " << name << '\n';
    return 0;
}

}  // namespace

void addInfoCommand(CLI::App& program, int& exitCode) {
    CLI::App* command = program.add_subcommand(
        "info", "device, driver, features and limits; of a scene: what its file uses, feature by feature");
    const auto options = std::make_shared<InfoOptions>();
    command->add_option("scene", options->scene, "glTF or GLB file, or a built-in name; none: the device");
    command->add_option("--param", options->param, "number of a built-in scene that takes one");
    command->add_flag("--json", options->json, "of a scene: as JSON");
    command
        ->add_option("--without", options->without,
                     "as if the device lacked this feature, or had no more of a limit: LIMIT=N")
        ->allow_extra_args(false);
    command->callback([options, &exitCode] {
        if (options->scene.empty() && options->json)
            exitCode = refuse("--json is of a scene");
        else
            exitCode = options->scene.empty() ? runDeviceInfo(options->without) : runSceneInfo(*options);
    });
}

}  // namespace ag::workbench
