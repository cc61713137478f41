#include "engine/frame/frame_description.h"

#include <algorithm>

#include "engine/frame/frame_graph_impl.h"

namespace ag {
namespace {

ResourceRole roleOf(const Resource& r, const std::vector<Slot>& slots) {
    if (r.kind == ResourceKind::kImport) return ResourceRole::kImport;
    if (r.kind == ResourceKind::kHistoryPrevious) return ResourceRole::kPrevious;
    return slots[r.slot].isHistory ? ResourceRole::kHistory : ResourceRole::kOwned;
}

uint64_t sizeOf(const Resource& r) {
    if (!r.isImage) return r.buffer.sizeBytes;
    uint64_t texels = 0;
    for (uint32_t mip = 0; mip < r.image.mips; ++mip)
        texels += uint64_t(std::max(r.image.size.x >> mip, 1u)) * std::max(r.image.size.y >> mip, 1u);
    const uint32_t layers = r.importedImage ? r.importedImage->desc().layers : 1;
    return texels * layers * gpu::texelSizeBytes(r.image.format);
}

uint64_t product(glm::uvec3 v) {
    return uint64_t(v.x) * v.y * v.z;
}

bool isTarget(UseKind kind) {
    return kind == UseKind::kColorClear || kind == UseKind::kColorLoad || kind == UseKind::kDepthClear ||
           kind == UseKind::kDepthLoad;
}

void describeWork(const Pass& pass, std::span<const Use> uses, std::span<const Resource> resources,
                  PassDescription& out) {
    switch (pass.kind) {
        case PassKind::kCompute:
            out.unit = pass.dispatchIndirect ? WorkUnit::kIndirectGroups : WorkUnit::kThreads;
            out.work = pass.dispatchIndirect ? 1 : product(pass.dispatch);
            if (!pass.threads && !pass.dispatchIndirect && pass.pipeline)
                out.work *= product(pass.pipeline->workgroupSize);
            break;
        case PassKind::kFullscreen:
            out.unit = WorkUnit::kPixels;
            for (const Use& use : uses)
                if (isTarget(use.kind)) out.work = product(glm::uvec3(resources[use.resource].image.size, 1));
            break;
        case PassKind::kRaster:
        case PassKind::kCallback:
            out.unit = WorkUnit::kIndirectDraws;
            break;
        default:
            out.unit = WorkUnit::kBytes;
            out.work = sizeOf(resources[uses.back().resource]);
            break;
    }
}

}  // namespace

std::string_view unitName(WorkUnit unit) {
    constexpr std::string_view kNames[] = {"threads", "pixels", "indirect draws", "indirect groups", "bytes"};
    return kNames[size_t(unit)];
}

std::string_view outcomeName(PassOutcome outcome) {
    constexpr std::string_view kNames[] = {"ran", "skipped", "dropped"};
    return kNames[size_t(outcome)];
}

FrameDescription FrameGraph::describe() const {
    const Impl& g = *impl_;
    FrameDescription out{.frame = g.frame};
    for (uint32_t i = 0; i < g.resources.size(); ++i) {
        const Resource& r = g.resources[i];
        out.resources.push_back({.name = impl_->fullName(r.scope, r.name),
                                 .role = roleOf(r, g.slots),
                                 .image = {r.isImage ? i : ~0u},
                                 .buffer = {r.isImage ? ~0u : i},
                                 .sizeBytes = sizeOf(r),
                                 .isOutput = r.isOutput});
    }
    for (size_t p = 0; p < g.report.size(); ++p) {
        const Pass& pass = g.passes[p];
        PassDescription& d = out.passes.emplace_back();
        d.name = std::string(pass.name);
        d.shader = pass.shader;
        d.uploads = pass.kind == PassKind::kUpload;
        d.outcome = g.report[p].outcome;
        d.cause = g.report[p].reason;
        if (!pass.runs) d.reason = reasonText(d.cause);
        d.patches = g.report[p].patches;
        d.patchesDrawn = pass.runs ? g.report[p].patchesDrawn : 0;
        const auto note = [](std::vector<uint32_t>& list, uint32_t resource) {
            if (std::ranges::count(list, resource) == 0) list.push_back(resource);
        };
        std::vector<uint32_t> all;
        for (const Use& use : g.usesOf(pass)) {
            if (readsOld(use.kind)) note(d.reads, use.resource);
            if (d.changed == ~0u && readsOld(use.kind) &&
                g.resources[use.resource].name == g.report[p].changed)
                d.changed = use.resource;
            if (writes(use.kind)) note(d.writes, use.resource);
            note(all, use.resource);
        }
        for (uint32_t resource : all)
            d.resourceBytes += out.resources[resource].sizeBytes;
        describeWork(pass, g.usesOf(pass), g.resources, d);
        for (const RasterDraw& draw : g.drawsOf(pass))
            d.work += draw.commandCount;
    }
    return out;
}

}  // namespace ag
