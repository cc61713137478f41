#include "engine/ecs/describe.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>

#include "engine/ecs/name.h"

namespace ag {
namespace {

std::array<std::vector<Field>, kMaxComponents>& descriptions() {
    static std::array<std::vector<Field>, kMaxComponents> all;  // facts about types, like their ids
    return all;
}

template <class T>
T valueAt(const std::byte* at) {
    T value;
    std::memcpy(&value, at, sizeof value);
    return value;
}

std::string numberText(FieldKind kind, const std::byte* at, uint32_t i) {
    switch (kind) {
        case FieldKind::kFloat:
            return fmt::format("{:.5g}", valueAt<float>(at + 4 * i));
        case FieldKind::kDouble:
            return fmt::format("{:.9g}", valueAt<double>(at + 8 * i));
        case FieldKind::kInt:
            return fmt::format("{}", valueAt<int32_t>(at + 4 * i));
        default:
            return fmt::format("{}", valueAt<uint32_t>(at + 4 * i));
    }
}

bool sameLetter(char a, char b) {
    return std::tolower(uint8_t(a)) == std::tolower(uint8_t(b));
}

}  // namespace

void describeComponent(ComponentId id, std::vector<Field> fields) {
    for (const Field& f : fields)
        AG_CHECK_LT(f.offset, componentType(id).sizeBytes);
    descriptions()[id] = std::move(fields);
}

std::span<const Field> fieldsOf(ComponentId id) {
    return descriptions()[id];
}

std::string fieldText(const Field& field, const void* component) {
    const std::byte* at = static_cast<const std::byte*>(component) + field.offset;
    if (field.kind == FieldKind::kText) {
        const std::string_view text(reinterpret_cast<const char*>(at), field.count);
        return std::string(text.substr(0, text.find('\0')));
    }
    if (field.kind == FieldKind::kEntity) {
        const auto entity = valueAt<Entity>(at);
        return entity ? fmt::format("{}.{}", entity.index, entity.generation) : "none";
    }
    std::string text;
    for (uint32_t i = 0; i < field.count; ++i) {
        if (i > 0) text += ' ';
        text += numberText(field.kind, at, i);
    }
    return text;
}

std::string_view shortTypeName(std::string_view name) {
    const size_t at = name.rfind("::");
    return at == std::string_view::npos ? name : name.substr(at + 2);
}

WorldReport reportWorld(const World& world) {
    WorldReport report{.entities = world.entityCount(), .slabBytes = world.chunkMemoryBytes()};
    for (const Archetype& archetype : world.archetypes()) {
        ArchetypeReport& a = report.archetypes.emplace_back();
        for (const ComponentId id : archetype.components) {
            if (!a.components.empty()) a.components += ", ";
            a.components += shortTypeName(componentType(id).name);
        }
        a.rows = archetype.rows();
        a.chunks = uint32_t(archetype.chunks.size());
        for (const auto& chunk : archetype.chunks) {
            a.capacity += chunk->capacity;
            a.bytes += chunk->bytes;
        }
        report.chunks += a.chunks;
        report.chunkBytes += a.bytes;
    }
    return report;
}

void listEntities(const World& world, std::string_view filter, std::vector<Entity>& out) {
    out.clear();
    const auto wanted = [&](const Name* name) {
        if (filter.empty()) return true;
        if (!name) return false;
        const std::string_view text = name->text;
        return std::search(text.begin(), text.end(), filter.begin(), filter.end(), sameLetter) != text.end();
    };
    for (const Archetype& archetype : world.archetypes()) {
        const uint8_t column = archetype.columnOf[componentId<Name>()];
        for (const auto& chunk : archetype.chunks)
            for (uint32_t row = 0; row < chunk->rows; ++row) {
                const Name* name = column == Archetype::kNoColumn
                                       ? nullptr
                                       : reinterpret_cast<const Name*>(chunk->columns[column]) + row;
                if (wanted(name)) out.push_back(chunk->entities[row]);
            }
    }
}

}  // namespace ag
