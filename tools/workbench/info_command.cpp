#include <fmt/format.h>

#include <iostream>

#include "engine/gpu/device.h"
#include "tools/workbench/commands.h"

namespace ag::workbench {
namespace {

std::string groupsOf(const gpu::Lanes& lanes) {
    return fmt::format("{} lanes, {}", lanes.count,
                       lanes.shared      ? "shared memory"
                       : lanes.requested ? "a subgroup of that size asked for"
                                         : "a subgroup");
}

int runInfo(const std::vector<std::string>& without) {
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
    CLI::App* command = program.add_subcommand("info", "device, driver, features and limits");
    const auto without = std::make_shared<std::vector<std::string>>();
    command
        ->add_option("--without", *without,
                     "as if the device lacked this feature, or had no more of a limit: LIMIT=N")
        ->allow_extra_args(false);
    command->callback([without, &exitCode] { exitCode = runInfo(*without); });
}

}  // namespace ag::workbench
