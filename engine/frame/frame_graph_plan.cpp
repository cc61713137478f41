// Planning a frame: content versions forward, needs backward.
#include <algorithm>

#include "engine/frame/frame_graph_impl.h"

namespace ag {
namespace {

uint64_t hashDraw(uint64_t key, const RasterDraw& draw) {
    for (uint32_t i = 0; i < draw.specCount; ++i)
        key = draw.spec[i].hash(key);
    key = combineHash(key, uint64_t(draw.cull) * 2 + draw.mirrored);
    key = hashValue(draw.viewport, key);
    key = hashBytes({draw.push.data(), draw.pushSizeBytes}, key);
    key = combineHash(key, draw.commandCount * 2 + draw.deformed);
    return combineHash(key, draw.commandsVersion ? draw.commandsVersion : draw.commandsOffsetBytes);
}

// The first draw that draws, after the markers of empty patches.
const RasterDraw* firstDraw(std::span<const RasterDraw> draws) {
    const auto found = std::ranges::find(draws, false, &RasterDraw::beginsPatch);
    return found == draws.end() ? nullptr : &*found;
}

uint64_t pipelineNameKey(const Pass& pass) {
    uint64_t key = hashText(pass.shader, hashText(pass.vertexShader));
    for (uint32_t i = 0; i < pass.specCount; ++i)
        key = pass.spec[i].hash(key);
    return key;
}

}  // namespace

gpu::PipelineRequest FrameGraph::Impl::requestFor(const Pass& pass, const RasterDraw* draw) const {
    gpu::PipelineRequest request;
    request.raster = pass.raster;
    request.spec = pass.spec;
    request.specCount = request.neededCount = pass.specCount;
    if (pass.kind == PassKind::kCompute) {
        request.computeShader = pass.shader;
        return request;
    }
    request.vertexShader = pass.vertexShader;
    request.fragmentShader = pass.shader;
    if (!draw) return request;
    request.raster.cull = draw->cull;
    request.raster.mirrored = draw->mirrored;
    for (uint32_t i = 0; i < draw->specCount; ++i) {
        AG_CHECK_LT(request.specCount, gpu::kMaxSpecConstants);
        request.spec[request.specCount++] = draw->spec[i];
    }
    return request;
}

// The pass's pipeline, or for draws in variants that of the first one: all share bindings and layout.
void FrameGraph::Impl::resolvePipelines() {
    for (Pass& pass : passes) {
        pass.pipelineKey = pipelineNameKey(pass);
        const bool drawn = firstDraw(drawsOf(pass)) || pass.callback != ~0u;
        const bool shader = pass.kind == PassKind::kCompute || pass.kind == PassKind::kFullscreen ||
                            (pass.kind == PassKind::kRaster && drawn);
        if (!context || !shader) continue;
        const RasterDraw* draw = pass.kind == PassKind::kRaster ? firstDraw(drawsOf(pass)) : nullptr;
        pass.pipeline = &pipelines->get(requestFor(pass, draw));
        pass.pipelineKey = pass.pipeline->id;
        PassStats& known = stats[pass.stats];
        if (known.checkedPipeline == pass.pipeline->id) continue;
        checkBindings(pass, *pass.pipeline);
        known.checkedPipeline = pass.pipeline->id;
    }
}

// Of all that a pass is but the contents it reads.
uint64_t FrameGraph::Impl::ownKey(const Pass& pass) const {
    uint64_t key = combineHash(stats[pass.stats].nameHash, pass.pipelineKey);
    key = hashBytes({pass.push.data(), pass.pushSizeBytes}, key);
    key = combineHash(combineHash(key, pass.extraKey), pass.fillWord);
    key = hashValue(pass.dispatch, key);
    key = combineHash(combineHash(key, pass.indirectOffset), pass.geometry.version);
    if (pass.dataSize > 0) key = hashBytes({data.data() + pass.dataOffset, pass.dataSize}, key);
    for (const RasterDraw& draw : drawsOf(pass))
        key = hashDraw(key, draw);
    for (const GroupPart& part : partsOf(pass))
        key = combineHash(combineHash(key, part.key), part.firstGroup);
    for (const Use& use : usesOf(pass)) {
        if (writes(use.kind)) key = hashValue(use.clear, combineHash(key, use.mip));
        if (use.sampler != Sampler::kNearestClamp) key = combineHash(key, uint64_t(use.sampler));
    }
    return key;
}

uint64_t FrameGraph::Impl::passKey(const Pass& pass, bool withPrevious) const {
    uint64_t key = ownKey(pass);
    for (const Use& use : usesOf(pass))
        if (readsOld(use.kind) && use.keyed && (withPrevious || !use.previous))
            key = combineHash(key, resources[use.resource].version);
    return key;
}

// Of what a patch will show: all that its draws are made of.
uint64_t FrameGraph::Impl::patchKey(const Pass& pass, size_t first, size_t end) const {
    uint64_t key = combineHash(pass.pipelineKey, pass.geometry.version);
    for (size_t i = first; i < end; ++i)
        key = hashDraw(key, drawsOf(pass)[i]);
    for (const Use& use : usesOf(pass))
        if (readsOld(use.kind) && use.keyed) key = combineHash(key, resources[use.resource].version);
    return key;
}

// As it was at the end of the frame before.
const Memory& FrameGraph::Impl::newest(const Resource& r) const {
    return slots[r.slot].halves[slots[r.slot].current];
}

// A pass can be held that has made all it writes.
void FrameGraph::Impl::decideHeld() {
    for (Pass& pass : passes)
        for (const Use& use : usesOf(pass))
            if (writes(use.kind)) pass.held = pass.held && newest(resources[use.resource]).version != 0;
}

const Use* FrameGraph::Impl::earlierWrite(const Pass& pass, const Use& use) const {
    for (const Use& other : usesOf(pass)) {
        if (&other == &use) return nullptr;
        if (other.resource == use.resource && writes(other.kind)) return &other;
    }
    return nullptr;
}

// Forward over the passes: what each resource will hold after each of them. Without `previous` for the keys
// by which histories decide whether to step, with it for the versions proper.
void FrameGraph::Impl::walkVersions(bool withPrevious) {
    for (Resource& r : resources) {
        r.version = r.importVersion;
        if (r.kind == ResourceKind::kHistoryPrevious && withPrevious)
            r.version = slots[r.slot].halves[r.half].version;
    }
    if (!withPrevious) stepKeys.assign(slots.size(), 0), heldSlots.clear();
    for (Pass& pass : passes) {
        const uint64_t key = passKey(pass, withPrevious);
        uint32_t index = 0;
        for (Use& use : usesOf(pass)) {
            Resource& r = resources[use.resource];
            const bool history = r.slot != ~0u && slots[r.slot].isHistory;
            if (!withPrevious && history && (use.previous || writes(use.kind)))
                stepKeys[r.slot] = combineHash(stepKeys[r.slot], key);
            ++index;
            use.versionBefore = r.version;
            if (!writes(use.kind)) continue;
            const Use* same = earlierWrite(pass, use);  // of two bindings of one resource
            const uint64_t kept = withPrevious ? newest(r).version : newest(r).stepVersion;
            const uint64_t made = pass.held ? kept : combineHash(key, index) | 1;  // never 0
            use.versionAfter = same ? same->versionAfter : made;
            if (!withPrevious) use.stepVersionAfter = use.versionAfter;
            r.version = use.versionAfter;
            if (!withPrevious && history && pass.held) heldSlots.push_back(r.slot);
        }
    }
    if (withPrevious) return;
    for (const uint32_t slot : heldSlots)
        stepKeys[slot] = slots[slot].stepKey;
}

// Adds to the key of each part the versions of what it is made from.
void FrameGraph::Impl::keyParts() {
    auto source = partSources.begin();
    for (const Pass& pass : passes) {
        for (; source != partSources.end() && source->part < pass.firstPart + pass.partCount; ++source) {
            const auto use = std::ranges::find_if(usesOf(pass), [&](const Use& u) {
                return u.resource == source->resource && readsOld(u.kind);
            });
            AG_CHECK(use != usesOf(pass).end());
            parts[source->part].key = combineHash(parts[source->part].key, use->versionBefore);
        }
    }
}

// A history steps when anything it is made from changed: the halves then change places.
void FrameGraph::Impl::chooseHalves() {
    for (Resource& r : resources) {
        if (r.slot == ~0u || !slots[r.slot].isHistory) continue;
        const Slot& slot = slots[r.slot];
        const bool steps = stepKeys[r.slot] != slot.stepKey;
        const uint32_t current = steps ? 1 - slot.current : slot.current;
        r.half = r.kind == ResourceKind::kHistoryPrevious ? 1 - current : current;
    }
}

Memory* FrameGraph::Impl::memoryOf(Resource& r) {
    return r.kind == ResourceKind::kImport ? nullptr : &slots[r.slot].halves[r.half];
}

uint64_t FrameGraph::Impl::heldVersion(Resource& r) {
    const Memory* memory = memoryOf(r);
    return memory ? memory->version : r.importVersion;
}

bool FrameGraph::Impl::available(Resource& r, uint64_t version) {
    if (r.kind != ResourceKind::kOwned) return true;
    if (r.clobbered || heldVersion(r) != version) return false;
    if (!options.alias || slots[r.slot].bucket == ~0u) return true;
    // Scratch: gone as soon as any sharer is written in this frame.
    const AliasBucket& bucket = buckets[slots[r.slot].bucket];
    return std::ranges::none_of(resources,
                                [&](const Resource& other) {
                                    return other.clobbered && other.slot != ~0u &&
                                           slots[other.slot].bucket == slots[r.slot].bucket;
                                }) &&
           (bucket.lastUser == ~0u || bucket.lastUser == r.slot);
}

void FrameGraph::Impl::markWanted() {
    for (Resource& r : resources) {
        r.wanted = r.isOutput;
        r.clobbered = false;
    }
    for (auto pass = passes.rbegin(); pass != passes.rend(); ++pass) {
        pass->wanted = pass->runs = false;
        for (const Use& use : usesOf(*pass))
            pass->wanted |= writes(use.kind) && resources[use.resource].wanted;
        if (!pass->wanted) continue;
        for (const Use& use : usesOf(*pass))
            if (writes(use.kind) && !readsOld(use.kind)) resources[use.resource].wanted = false;
        for (const Use& use : usesOf(*pass))
            if (readsOld(use.kind)) resources[use.resource].wanted = true;
    }
}

// One walk backward; true if it found more to run. Running only ever grows, so repeating it ends: a pass that
// runs overwrites its outputs, which may take away what a later pass counted on.
bool FrameGraph::Impl::markRunning() {
    bool changed = false;
    for (Resource& r : resources)
        r.needed = r.isOutput;
    for (auto pass = passes.rbegin(); pass != passes.rend(); ++pass) {
        bool run = pass->runs || (!options.skip && pass->wanted && !pass->held);
        for (const Use& use : usesOf(*pass)) {
            Resource& r = resources[use.resource];
            if (writes(use.kind) && r.needed) run = run || !available(r, use.versionAfter);
        }
        changed = changed || run != pass->runs;
        pass->runs = run;
        for (const Use& use : usesOf(*pass)) {
            Resource& r = resources[use.resource];
            if (!writes(use.kind)) continue;
            changed = changed || (run && !r.clobbered);
            r.clobbered = r.clobbered || run;
            // What stands before this write is needed only if the write builds on it.
            r.needed = run ? readsOld(use.kind) : false;
        }
        if (!run) continue;
        for (const Use& use : usesOf(*pass))
            if (readsOld(use.kind)) resources[use.resource].needed = true;
    }
    return changed;
}

void FrameGraph::Impl::plan() {
    resolvePipelines();
    decideHeld();
    walkVersions(false);
    chooseHalves();
    walkVersions(true);
    keyParts();
    for (uint32_t p = 0; p < passes.size(); ++p) {
        for (const Use& use : usesOf(passes[p])) {
            Resource& r = resources[use.resource];
            r.firstPass = std::min(r.firstPass, p);
            r.lastPass = p;
        }
    }
    for (Resource& r : resources)
        if (r.isOutput) r.lastPass = uint32_t(passes.size());
    markAsync();
    placeScratch();
    markWanted();
    while (markRunning()) {
    }
}

// Histories whose writers ran have stepped.
void FrameGraph::Impl::commitHistories() {
    for (const Pass& pass : passes) {
        if (!pass.runs) continue;
        for (const Use& use : usesOf(pass)) {
            const Resource& r = resources[use.resource];
            if (!writes(use.kind) || r.slot == ~0u || !slots[r.slot].isHistory) continue;
            slots[r.slot].current = r.half;
            slots[r.slot].stepKey = stepKeys[r.slot];
        }
    }
}

}  // namespace ag
