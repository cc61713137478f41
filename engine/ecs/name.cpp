#include "engine/ecs/name.h"

#include <algorithm>

#include "engine/core/hash.h"
#include "engine/ecs/columns.h"

namespace ag {
namespace {

bool same(const World& world, Entity entity, const Name& name) {
    const Name* known = world.get<Name>(entity);
    return known && std::string_view(known->text) == name.text;
}

}  // namespace

Name makeName(std::string_view text) {
    Name name;
    size_t length = std::min(text.size(), sizeof name.text - 1);
    if (length < text.size())
        while (length > 0 && (uint8_t(text[length]) & 0xc0) == 0x80)
            --length;
    text.copy(name.text, length);
    return name;
}

void NameIndex::refresh(const World& world) {
    const uint32_t version = world.columnVersion(componentId<Name>());
    if (editCount_ == world.editCount() && version_ == version) return;
    editCount_ = world.editCount();
    version_ = version;
    entries_.clear();
    forRowsOf<Name>(world, [&](Entity entity, const Name& name) {
        entries_.push_back({hashText(name.text), entity});
    });
    std::ranges::stable_sort(entries_, {}, &Entry::first);
}

std::span<const NameIndex::Entry> NameIndex::sameHash(const World& world, const Name& name) {
    refresh(world);
    const uint64_t hash = hashText(name.text);  // equal_range's result needs clang 16
    return {std::ranges::lower_bound(entries_, hash, {}, &Entry::first),
            std::ranges::upper_bound(entries_, hash, {}, &Entry::first)};
}

Entity NameIndex::find(const World& world, std::string_view text) {
    const Name name = makeName(text);
    for (const auto& [hash, entity] : sameHash(world, name))
        if (same(world, entity, name)) return entity;
    return {};
}

std::vector<Entity> NameIndex::findAll(const World& world, std::string_view text) {
    const Name name = makeName(text);
    std::vector<Entity> all;
    for (const auto& [hash, entity] : sameHash(world, name))
        if (same(world, entity, name)) all.push_back(entity);
    return all;
}

}  // namespace ag
