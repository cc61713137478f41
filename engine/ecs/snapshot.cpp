#include "engine/ecs/snapshot.h"

#include <fmt/format.h>

#include <bit>

#include "engine/core/hash.h"
#include "engine/core/safe_file.h"

namespace ag {
namespace {

constexpr char kMagic[8] = {'A', 'G', 'W', 'O', 'R', 'L', 'D', '\n'};
constexpr uint32_t kFormat = 1;
constexpr uint64_t kMostWorldBytes = uint64_t(4) << 30;

class Writer {
  public:
    void bytes(const void* from, size_t count) {
        const auto* begin = static_cast<const std::byte*>(from);
        out_.insert(out_.end(), begin, begin + count);
    }
    void number(uint32_t value) { bytes(&value, sizeof value); }
    std::vector<std::byte> finish() {
        const uint64_t hash = hashBytes(out_);
        bytes(&hash, sizeof hash);
        return std::move(out_);
    }

  private:
    std::vector<std::byte> out_;
};

// Reads zeros past the end and remembers it.
class Reader {
  public:
    explicit Reader(std::span<const std::byte> bytes) : left_(bytes) {}
    std::span<const std::byte> bytes(size_t count) {
        if (count > left_.size()) {
            failed_ = true;
            return {};
        }
        const auto taken = left_.first(count);
        left_ = left_.subspan(count);
        return taken;
    }
    uint32_t number() {
        uint32_t value = 0;
        if (const auto from = bytes(sizeof value); !from.empty())
            std::memcpy(&value, from.data(), sizeof value);
        return value;
    }
    size_t left() const { return left_.size(); }
    bool failed() const { return failed_; }

  private:
    std::span<const std::byte> left_;
    bool failed_ = false;
};

Error damaged() {
    return Error{"the saved world is damaged: its parts do not fit together"};
}

// Type ids here of the saved world's components.
Result<std::vector<ComponentId>> readTypes(Reader& in) {
    const uint32_t count = in.number();
    if (count > kMaxComponents) return damaged();
    std::vector<ComponentId> ids;
    for (uint32_t i = 0; i < count; ++i) {
        const auto text = in.bytes(in.number());
        const uint32_t size = in.number();
        if (in.failed()) return damaged();
        const std::string_view name(reinterpret_cast<const char*>(text.data()), text.size());
        const ComponentId id = componentNamed(name);
        if (id == kMaxComponents)
            return Error{
                fmt::format("the saved world holds component {}, which this program does not know", name)};
        if (componentType(id).sizeBytes != size)
            return Error{fmt::format("component {} has {} bytes in the saved world and {} in this program",
                                     name, size, componentType(id).sizeBytes)};
        ids.push_back(id);
    }
    return ids;
}

Status checkEnvelope(std::span<const std::byte> bytes) {
    constexpr size_t kLeast = sizeof kMagic + sizeof kFormat + sizeof(uint64_t);
    if (bytes.size() < kLeast || std::memcmp(bytes.data(), kMagic, sizeof kMagic) != 0)
        return Error{"the bytes are not a saved world"};
    uint32_t format;
    std::memcpy(&format, bytes.data() + sizeof kMagic, sizeof format);
    if (format != kFormat)
        return Error{fmt::format("the saved world has format {}, this program reads {}", format, kFormat)};
    uint64_t hash;
    std::memcpy(&hash, bytes.data() + bytes.size() - sizeof hash, sizeof hash);
    if (hash != hashBytes(bytes.first(bytes.size() - sizeof hash)))
        return Error{"the saved world is damaged: its checksum differs"};
    return Ok{};
}

}  // namespace

struct WorldSnapshot {
    static void writeRecords(const World& world, Writer& out);
    static ComponentMask typesIn(const World& world);
    static void writeTypes(const ComponentMask& types, Writer& out);
    static void writeArchetype(const Archetype& archetype, const ComponentMask& types, Writer& out);
    static bool readRecords(World& world, Reader& in);
    static bool readArchetype(World& world, Reader& in, std::span<const ComponentId> types);
    static bool readRows(World& world, Archetype& archetype, uint32_t rows, Reader& in);
    static bool readColumns(Archetype& archetype, std::span<const ComponentId> order, Reader& in);
    static bool freeListFits(const World& world);
    static Status restore(World& world, std::span<const std::byte> bytes);
};

void WorldSnapshot::writeRecords(const World& world, Writer& out) {
    out.number(uint32_t(world.records_.size()));
    out.number(world.freeHead_);
    for (const World::Record& record : world.records_) {
        out.number(record.generation);
        out.number(record.chunk ? 0
                                : record.row);  // free ones are chained: the next handles are the same, too
    }
}

ComponentMask WorldSnapshot::typesIn(const World& world) {
    ComponentMask types;
    for (const Archetype& archetype : world.archetypes_)
        for (const ComponentId id : archetype.components)
            types.set(id);
    return types;
}

void WorldSnapshot::writeTypes(const ComponentMask& types, Writer& out) {
    out.number(uint32_t(std::popcount(types.words[0]) + std::popcount(types.words[1])));
    for (ComponentId id = 0; id < kMaxComponents; ++id) {
        if (!types.has(id)) continue;
        const ComponentType& type = componentType(id);
        AG_CHECK_MSG(componentNamed(type.name) == id, "two types of components have one name");
        out.number(uint32_t(type.name.size()));
        out.bytes(type.name.data(), type.name.size());
        out.number(type.sizeBytes);
    }
}

void WorldSnapshot::writeArchetype(const Archetype& archetype, const ComponentMask& types, Writer& out) {
    out.number(uint32_t(archetype.components.size()));
    for (const ComponentId id : archetype.components)
        out.number(types.countBelow(id));
    out.number(archetype.rows());
    for (const auto& chunk : archetype.chunks)
        out.bytes(chunk->entities, chunk->rows * sizeof(Entity));
    for (size_t c = 0; c < archetype.components.size(); ++c)
        for (const auto& chunk : archetype.chunks)
            out.bytes(chunk->columns[c], chunk->rows * size_t(archetype.sizes[c]));
}

std::vector<std::byte> saveWorld(const World& world) {
    Writer out;
    out.bytes(kMagic, sizeof kMagic);
    out.number(kFormat);
    const ComponentMask types = WorldSnapshot::typesIn(world);
    WorldSnapshot::writeTypes(types, out);
    WorldSnapshot::writeRecords(world, out);
    out.number(uint32_t(world.archetypes().size()));
    for (const Archetype& archetype : world.archetypes())
        WorldSnapshot::writeArchetype(archetype, types, out);
    return out.finish();
}

bool WorldSnapshot::readRecords(World& world, Reader& in) {
    const uint32_t count = in.number();
    world.freeHead_ = in.number();
    if (count > in.left() / 8) return false;
    world.records_.resize(count);
    for (World::Record& record : world.records_) {
        record.generation = in.number();
        record.row = in.number();
    }
    return !in.failed();
}

bool WorldSnapshot::readRows(World& world, Archetype& archetype, uint32_t rows, Reader& in) {
    for (uint32_t done = 0; done < rows;) {
        Chunk& chunk = addChunk(archetype, world.memory_);
        chunk.rows = std::min(chunk.capacity, rows - done);
        chunk.structureVersion = world.version();
        markRows(chunk, 0, chunk.rows);
        const auto entities = in.bytes(chunk.rows * sizeof(Entity));
        if (in.failed()) return false;
        std::memcpy(chunk.entities, entities.data(), entities.size());
        for (uint32_t row = 0; row < chunk.rows; ++row) {
            const Entity entity = chunk.entities[row];
            if (entity.index >= world.records_.size()) return false;
            World::Record& record = world.records_[entity.index];
            if (record.chunk || record.generation != entity.generation) return false;
            record.chunk = &chunk;
            record.row = row;
        }
        done += chunk.rows;
    }
    world.alive_ += rows;
    return true;
}

// The saved world's types may have other numbers here: their columns come in the saved order.
bool WorldSnapshot::readColumns(Archetype& archetype, std::span<const ComponentId> order, Reader& in) {
    for (const ComponentId id : order) {
        const uint8_t c = archetype.columnOf[id];
        for (const auto& chunk : archetype.chunks) {
            const auto column = in.bytes(chunk->rows * size_t(archetype.sizes[c]));
            if (!column.empty()) std::memcpy(chunk->columns[c], column.data(), column.size());
        }
    }
    return !in.failed();
}

bool WorldSnapshot::readArchetype(World& world, Reader& in, std::span<const ComponentId> types) {
    const uint32_t count = in.number();
    if (count > types.size()) return false;
    ComponentMask mask;
    std::vector<ComponentId> order;
    for (uint32_t i = 0; i < count; ++i) {
        const uint32_t saved = in.number();
        if (saved >= types.size() || mask.has(types[saved])) return false;
        order.push_back(types[saved]);
        mask.set(types[saved]);
    }
    const size_t before = world.archetypes_.size();
    Archetype& archetype = world.archetypeFor(mask);
    if (world.archetypes_.size() == before) return false;  // it comes twice
    const uint32_t rows = in.number();
    if (rows > in.left() / sizeof(Entity)) return false;
    return readRows(world, archetype, rows, in) && readColumns(archetype, order, in);
}

// Every record is either an entity's or once in the chain.
bool WorldSnapshot::freeListFits(const World& world) {
    size_t left = world.records_.size() - world.alive_;
    uint32_t at = world.freeHead_;
    for (; at != World::kNone && left > 0; --left) {
        if (at >= world.records_.size() || world.records_[at].chunk) return false;
        at = world.records_[at].row;
    }
    return at == World::kNone && left == 0;
}

Status WorldSnapshot::restore(World& world, std::span<const std::byte> bytes) {
    if (const Status envelope = checkEnvelope(bytes); !envelope) return envelope.error();
    Reader in(bytes.first(bytes.size() - sizeof(uint64_t)));
    in.bytes(sizeof kMagic + sizeof kFormat);
    const auto types = readTypes(in);
    if (!types) return types.error();
    World fresh;
    fresh.frame_ = world.frame_;
    fresh.position_ = world.position_;
    if (!readRecords(fresh, in)) return damaged();
    const uint32_t count = in.number();
    for (uint32_t i = 0; i < count; ++i)
        if (in.failed() || !readArchetype(fresh, in, *types)) return damaged();
    if (in.failed() || in.left() > 0 || !freeListFits(fresh)) return damaged();
    world.swapEntities(fresh);
    return Ok{};
}

Status restoreWorld(World& world, std::span<const std::byte> bytes) {
    return WorldSnapshot::restore(world, bytes);
}

Status saveWorldFile(const World& world, const std::filesystem::path& path) {
    const std::vector<std::byte> bytes = saveWorld(world);
    return writeFileSafely(path.string(), {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
}

Status loadWorldFile(World& world, const std::filesystem::path& path) {
    const auto bytes = readFile(path.string(), kMostWorldBytes);
    if (!bytes) return bytes.error();
    const Status restored = restoreWorld(world, std::as_bytes(std::span(*bytes)));
    if (!restored) return Error{path.string() + ": " + restored.error().message};
    return Ok{};
}

}  // namespace ag
