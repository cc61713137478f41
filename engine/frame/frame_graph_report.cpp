// What the graph can say of itself after a frame.
#include <fmt/format.h>

#include <array>

#include "engine/frame/frame_graph_impl.h"

namespace ag {

std::string_view reasonText(PassReason reason) {
    static constexpr std::array<std::string_view, 9> kTexts = {
        "for the first time",     "changed: ",      "its parameters changed",   "goes on from: ",
        "its result was dropped", "all are to run", "nothing it reads changed", "it may be late",
        "nobody reads it"};
    return kTexts[size_t(reason)];
}

// Before the pass is noted as run: compares it with how it ran last.
PassReport FrameGraph::Impl::reportOf(const Pass& pass) const {
    PassReport out{.name = pass.name};
    if (!pass.runs) {
        out.outcome = pass.wanted ? PassOutcome::kSkipped : PassOutcome::kDropped;
        out.reason = !pass.wanted ? PassReason::kUnread
                     : pass.held  ? PassReason::kHeld
                                  : PassReason::kUnchanged;
        return out;
    }
    out.outcome = PassOutcome::kRan;
    const PassStats& known = stats[pass.stats];
    const std::span<const Use> read = usesOf(pass);
    out.reason = options.skip ? PassReason::kLost : PassReason::kAll;
    if (known.runCount == 0) {
        out.reason = PassReason::kFirst;
    } else if (known.inputVersions.size() != read.size() || known.ownKey != ownKey(pass)) {
        out.reason = PassReason::kParameters;
    } else {
        for (size_t i = read.size(); i-- > 0;) {
            const Use& use = read[i];
            const bool changed =
                readsOld(use.kind) && use.keyed && known.inputVersions[i] != use.versionBefore;
            if (!changed || (use.previous && out.reason == PassReason::kInput)) continue;
            out.reason = use.previous ? PassReason::kHistory : PassReason::kInput;
            out.changed = resources[use.resource].name;
        }
    }
    return out;
}

const gpu::Image& FrameGraph::physical(ImageHandle image) const {
    return impl_->imageOf(impl_->resources[image.index]);
}

void FrameGraph::rebind(BufferHandle import, const gpu::Buffer& buffer) {
    Resource& r = impl_->resources[import.index];
    AG_CHECK(r.kind == ResourceKind::kImport && !r.isImage);
    r.importedBuffer = &buffer;
    r.buffer.sizeBytes = buffer.sizeBytes();
}

const gpu::Buffer& FrameGraph::physical(BufferHandle buffer) const {
    return impl_->bufferOf(impl_->resources[buffer.index]);
}

VkImageLayout FrameGraph::layoutAfterFrame(ImageHandle image) const {
    const Resource& r = impl_->resources[image.index];
    return r.kind == ResourceKind::kImport ? r.outputLayout
                                           : impl_->slots[r.slot].halves[r.half].sync[0].layout;
}

std::vector<std::string_view> FrameGraph::resourceNames() const {
    std::vector<std::string_view> names;
    for (const Resource& r : impl_->resources)
        if (r.kind != ResourceKind::kHistoryPrevious) names.push_back(r.name);
    return names;
}

std::span<const PassReport> FrameGraph::report() const {
    return impl_->report;
}
std::span<const PassRecord> FrameGraph::nullRecords() const {
    return impl_->records;
}

std::span<const OwnerChange> FrameGraph::ownerChanges() const {
    return impl_->batches.ownerChanges;
}

uint64_t FrameGraph::frame() const {
    return impl_->frame;
}
std::vector<PassCount> FrameGraph::counts() const {
    return impl_->counter ? impl_->counter->read() : std::vector<PassCount>{};
}
FrameSpans FrameGraph::spans() const {
    return {impl_->spansFrame, impl_->spans, impl_->context ? impl_->context->info().timestampPeriodNs : 1.0};
}

uint64_t FrameGraph::transientBytes() const {
    uint64_t bytes = 0;
    for (const AliasBucket& bucket : impl_->buckets)
        bytes += bucket.range.sizeBytes;
    for (const Slot& slot : impl_->slots) {
        for (const Memory& half : slot.halves) {
            if (half.buffer) bytes += half.buffer->sizeBytes();
            if (!half.image || slot.bucket != ~0u) continue;
            const gpu::ImageDesc& desc = half.image->desc();
            for (uint32_t mip = 0; mip < desc.mips; ++mip)
                bytes += uint64_t(std::max(desc.size.x >> mip, 1u)) * std::max(desc.size.y >> mip, 1u) *
                         gpu::texelSizeBytes(desc.format);
        }
    }
    return bytes;
}

std::string FrameGraph::graphviz() const {
    std::string out = "digraph frame {\n  rankdir=LR;\n  node [shape=box, fontname=sans];\n";
    for (size_t p = 0; p < impl_->passes.size(); ++p) {
        const Pass& pass = impl_->passes[p];
        const char* color = pass.runs ? "palegreen" : pass.wanted ? "lightgrey" : "white";
        out += fmt::format("  p{} [label=\"{}\", style=filled, fillcolor={}];\n", p, pass.name, color);
        for (const Use& use : impl_->usesOf(pass)) {
            if (writes(use.kind)) out += fmt::format("  p{} -> r{};\n", p, use.resource);
            if (readsOld(use.kind)) out += fmt::format("  r{} -> p{};\n", use.resource, p);
        }
    }
    for (size_t r = 0; r < impl_->resources.size(); ++r)
        out += fmt::format("  r{} [label=\"{}\", shape=ellipse];\n", r,
                           impl_->fullName(impl_->resources[r].scope, impl_->resources[r].name));
    return out + "}\n";
}

}  // namespace ag
