// Scopes: whose names, histories and passes are whose.
#include <algorithm>

#include "engine/frame/frame_graph_impl.h"

namespace ag {

GraphScope FrameGraph::makeScope(std::string_view name) {
    const auto free = std::ranges::find(impl_->scopes, false, &Scope::used);
    const uint32_t id = uint32_t(free - impl_->scopes.begin());
    if (free == impl_->scopes.end()) impl_->scopes.emplace_back();
    impl_->scopes[id] = {.name = name};
    return {*this, id};
}

GraphScope GraphScope::nested(std::string_view name) const {
    std::vector<Scope>& scopes = graph_->impl_->scopes;
    GraphScope scope = *this;
    for (scope.id_ = 1; scope.id_ < scopes.size(); ++scope.id_)
        if (const Scope& s = scopes[scope.id_]; s.used && s.parent == id_ && s.name == name) return scope;
    scope.id_ = graph_->makeScope(name).id_;
    scopes[scope.id_].parent = id_;
    return scope;
}

void FrameGraph::removeScope(const GraphScope& scope) {
    AG_CHECK(scope.id_ != 0);
    for (uint32_t id = 1; id < impl_->scopes.size(); ++id)
        if (impl_->scopes[id].used && impl_->scopes[id].parent == scope.id_) removeScope({*this, id});
    impl_->scopes[scope.id_].used = false;
    for (PassStats& stats : impl_->stats)
        if (stats.scope == scope.id_) stats.fullName.reset();
    for (Slot& slot : impl_->slots) {
        if (slot.scope != scope.id_) continue;
        impl_->bucketsStale = impl_->bucketsStale || slot.bucket != ~0u;
        impl_->retireMemory(slot);
    }
}

std::string FrameGraph::Impl::fullName(uint32_t scope, std::string_view name) const {
    std::string full(name);
    for (; scope != 0 && scope != ~0u; scope = scopes[scope].parent)
        full = std::string(scopes[scope].name) + '/' + full;
    return full;
}

// What a slot holds counts for nothing from now on. Histories begin with zeroes.
void FrameGraph::Impl::forget(Slot& slot) {
    for (Memory& half : slot.halves) {
        half.version = half.stepVersion = 0;
        half.needsZero = slot.isHistory && (half.image || half.buffer);
        half.patches.clear();
        half.parts.clear();
    }
    slot.stepKey = 0;
}

void GraphScope::reset() const {
    FrameGraph::Impl& g = *graph_->impl_;
    for (Slot& slot : g.slots)
        if (slot.scope == id_) g.forget(slot);
    for (uint32_t id = 1; id < g.scopes.size(); ++id)
        if (g.scopes[id].used && g.scopes[id].parent == id_) GraphScope(*graph_, id).reset();
}

void GraphScope::resetHistory(std::string_view name) const {
    FrameGraph::Impl& g = *graph_->impl_;
    const auto found = g.slotOfName.find(hashName(id_, name));
    if (found != g.slotOfName.end()) g.forget(g.slots[found->second]);
}

GraphScope GraphScope::held(bool on) const {
    GraphScope scope = *this;
    scope.held_ = on;
    return scope;
}

GraphScope GraphScope::async() const {
    GraphScope scope = *this;
    scope.async_ = true;
    return scope;
}

}  // namespace ag
