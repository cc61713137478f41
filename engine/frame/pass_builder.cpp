// What a pass says of itself: uses, state, constants, work.
#include <algorithm>
#include <cstring>

#include "engine/frame/frame_graph_impl.h"

namespace ag {

namespace {

bool isCompute(const Pass& pass) {
    return pass.kind == PassKind::kCompute;
}

}  // namespace

#define AG_PASS (graph_->impl_->declaring(pass_))

PassBuilder& PassBuilder::read(std::string_view name, BufferHandle buffer) {
    const UseKind kind = isCompute(AG_PASS) ? UseKind::kComputeRead : UseKind::kRasterRead;
    graph_->impl_->addUse(pass_, {.resource = buffer.index, .kind = kind, .name = name});
    return *this;
}

PassBuilder& PassBuilder::read(std::string_view name, ImageHandle image) {
    const UseKind kind = isCompute(AG_PASS) ? UseKind::kComputeRead : UseKind::kRasterRead;
    graph_->impl_->addUse(pass_, {.resource = image.index, .kind = kind, .name = name});
    return *this;
}

PassBuilder& PassBuilder::readPart(std::string_view name, BufferHandle buffer, uint64_t version) {
    read(name, buffer);
    graph_->impl_->uses.back().keyed = false;
    return key(version);
}

PassBuilder& PassBuilder::write(std::string_view name, BufferHandle buffer) {
    graph_->impl_->addUse(pass_, {.resource = buffer.index, .kind = UseKind::kComputeWrite, .name = name});
    return *this;
}

PassBuilder& PassBuilder::write(std::string_view name, ImageHandle image, uint32_t mip) {
    // One mip of several: the others keep what they hold, so the image as a whole is read and written.
    const bool whole = graph_->info(image).mips == 1;
    graph_->impl_->addUse(pass_, {.resource = image.index,
                                  .kind = whole ? UseKind::kComputeWrite : UseKind::kComputeReadWrite,
                                  .name = name,
                                  .mip = mip,
                                  .wholeImage = false});
    return *this;
}

PassBuilder& PassBuilder::readWrite(std::string_view name, BufferHandle buffer) {
    graph_->impl_->addUse(pass_,
                          {.resource = buffer.index, .kind = UseKind::kComputeReadWrite, .name = name});
    return *this;
}

PassBuilder& PassBuilder::readWrite(std::string_view name, ImageHandle image) {
    graph_->impl_->addUse(
        pass_,
        {.resource = image.index, .kind = UseKind::kComputeReadWrite, .name = name, .wholeImage = false});
    return *this;
}

PassBuilder& PassBuilder::readPrevious(std::string_view name, const HistoryBuffer& history) {
    const UseKind kind = isCompute(AG_PASS) ? UseKind::kComputeRead : UseKind::kRasterRead;
    graph_->impl_->addUse(pass_,
                          {.resource = history.previous.index, .kind = kind, .name = name, .previous = true});
    return *this;
}

PassBuilder& PassBuilder::samplePrevious(std::string_view name, const HistoryImage& history,
                                         Sampler sampler) {
    const UseKind kind = isCompute(AG_PASS) ? UseKind::kComputeSample : UseKind::kRasterSample;
    graph_->impl_->addUse(pass_, {.resource = history.previous.index,
                                  .kind = kind,
                                  .name = name,
                                  .sampler = sampler,
                                  .previous = true});
    return *this;
}

PassBuilder& PassBuilder::sample(std::string_view name, ImageHandle image, Sampler sampler) {
    const UseKind kind = isCompute(AG_PASS) ? UseKind::kComputeSample : UseKind::kRasterSample;
    graph_->impl_->addUse(pass_, {.resource = image.index, .kind = kind, .name = name, .sampler = sampler});
    return *this;
}

PassBuilder& PassBuilder::color(ImageHandle image) {
    gpu::RasterState& raster = AG_PASS.raster;
    AG_CHECK_LT(raster.colorCount, gpu::kMaxColorTargets);
    raster.colorFormats[raster.colorCount++] = graph_->info(image).format;
    graph_->impl_->addUse(pass_, {.resource = image.index, .kind = UseKind::kColorLoad});
    return *this;
}

PassBuilder& PassBuilder::colorClear(ImageHandle image, glm::vec4 clear) {
    color(image);
    Use& use = graph_->impl_->uses.back();
    use.kind = UseKind::kColorClear;
    use.clear = clear;
    return *this;
}

PassBuilder& PassBuilder::depth(ImageHandle image) {
    gpu::RasterState& raster = AG_PASS.raster;
    raster.depthFormat = graph_->info(image).format;
    raster.depthTest = raster.depthWrite = true;
    graph_->impl_->addUse(pass_, {.resource = image.index, .kind = UseKind::kDepthLoad});
    return *this;
}

PassBuilder& PassBuilder::depthClear(ImageHandle image, float clear) {
    depth(image);
    Use& use = graph_->impl_->uses.back();
    use.kind = UseKind::kDepthClear;
    use.clear.x = clear;
    return *this;
}

PassBuilder& PassBuilder::depthPatches(ImageHandle image, float clear) {
    depth(image);
    Use& use = graph_->impl_->uses.back();
    use.kind = UseKind::kDepthPatch;
    use.clear.x = clear;
    use.keyed = false;  // what it held before is kept or drawn over: no part of what it will hold
    return *this;
}

PassBuilder& PassBuilder::patch(glm::uvec4 rect) {
    graph_->impl_->draws.push_back({.viewport = rect, .beginsPatch = true});
    ++AG_PASS.drawCount;
    return *this;
}

PassBuilder& PassBuilder::depthEqual(ImageHandle image) {
    gpu::RasterState& raster = AG_PASS.raster;
    raster.depthFormat = graph_->info(image).format;
    raster.depthTest = raster.depthEqual = true;
    graph_->impl_->addUse(pass_, {.resource = image.index, .kind = UseKind::kDepthTest});
    return *this;
}

PassBuilder& PassBuilder::blend(gpu::BlendMode mode) {
    AG_PASS.raster.blend = mode;
    return *this;
}

PassBuilder& PassBuilder::depthBiasSlope(float slope) {
    AG_PASS.raster.depthBiasSlope = slope;
    return *this;
}

PassBuilder& PassBuilder::pushBytes(std::span<const std::byte> bytes) {
    AG_CHECK_LE(bytes.size(), AG_PASS.push.size());
    std::memcpy(AG_PASS.push.data(), bytes.data(), bytes.size());
    AG_PASS.pushSizeBytes = uint32_t(bytes.size());
    return *this;
}

PassBuilder& PassBuilder::constant(const gpu::SpecConstant& value) {
    AG_CHECK_LT(AG_PASS.specCount, gpu::kMaxSpecConstants);
    AG_PASS.spec[AG_PASS.specCount++] = value;
    return *this;
}

PassBuilder& PassBuilder::step(uint64_t value) {
    return key(combineHash(1, value));
}

PassBuilder& PassBuilder::key(uint64_t value) {
    AG_PASS.extraKey = combineHash(AG_PASS.extraKey, value);
    return *this;
}

PassBuilder& PassBuilder::dispatchThreads(uint32_t x, uint32_t y, uint32_t z) {
    AG_PASS.dispatch = {x, y, z};
    AG_PASS.threads = true;
    return *this;
}

PassBuilder& PassBuilder::dispatchGroups(uint32_t x, uint32_t y, uint32_t z) {
    AG_PASS.dispatch = {x, y, z};
    return *this;
}

PassBuilder& PassBuilder::dispatchIndirect(BufferHandle arguments, uint64_t offsetBytes) {
    AG_PASS.dispatchIndirect = true;
    AG_PASS.indirectOffset = offsetBytes;
    graph_->impl_->addUse(pass_, {.resource = arguments.index, .kind = UseKind::kIndirect});
    return *this;
}

PassBuilder& PassBuilder::parts(std::string_view name, BufferHandle buffer) {
    readWrite(name, buffer);
    graph_->impl_->uses.back().keyed = false;  // what it held before is kept or written over
    return *this;
}

PassBuilder& PassBuilder::part(uint32_t firstGroup, uint32_t groupCount, uint64_t partKey) {
    if (AG_PASS.partCount++ == 0) AG_PASS.firstPart = uint32_t(graph_->impl_->parts.size());
    graph_->impl_->parts.push_back({firstGroup, groupCount, partKey});
    AG_PASS.dispatch = {std::max(AG_PASS.dispatch.x, firstGroup + groupCount), 1, 1};
    return *this;
}

PassBuilder& PassBuilder::partReads(BufferHandle buffer) {
    graph_->impl_->addPartSource(buffer.index);
    return *this;
}

PassBuilder& PassBuilder::partReads(ImageHandle image) {
    graph_->impl_->addPartSource(image.index);
    return *this;
}

PassBuilder& PassBuilder::geometry(const Geometry& geometry) {
    AG_PASS.geometry = geometry;
    for (const BufferHandle buffer : {geometry.deformedPositions, geometry.deformedAttributes})
        if (buffer)
            graph_->impl_->addUse(pass_,
                                  {.resource = buffer.index, .kind = UseKind::kVertices, .keyed = false});
    return *this;
}

PassBuilder& PassBuilder::draw(const RasterDraw& draw) {
    FrameGraph::Impl& impl = *graph_->impl_;
    impl.draws.push_back(draw);
    ++AG_PASS.drawCount;
    const auto uses = impl.usesOf(AG_PASS);
    const bool known = std::ranges::any_of(uses, [&](const Use& u) {
        return u.resource == draw.commands.index && u.kind == UseKind::kIndirect;
    });
    // A draw with a version of its own range stands for the buffer's contents in the key.
    if (!known)
        impl.addUse(pass_, {.resource = draw.commands.index,
                            .kind = UseKind::kIndirect,
                            .keyed = draw.commandsVersion == 0});
    return *this;
}

PassBuilder& PassBuilder::record(PassCallback callback) {
    AG_PASS.callback = uint32_t(graph_->impl_->callbacks.size());
    graph_->impl_->callbacks.push_back(std::move(callback));
    return *this;
}

#undef AG_PASS

}  // namespace ag
