#include "engine/app/inspector.h"

#include <fmt/format.h>
#include <imgui.h>

#include "engine/ecs/name.h"

namespace ag {
namespace {

void text(std::string_view s) {
    ImGui::TextUnformatted(s.data(), s.data() + s.size());
}

void cell(std::string_view s) {
    ImGui::TableNextColumn();
    text(s);
}

void fieldTable(std::string_view name, const ComponentType& type, std::span<const Field> fields,
                const void* bytes) {
    if (fields.empty()) return text(fmt::format("  {} bytes nobody described", type.sizeBytes));
    const std::string id(name);
    if (!ImGui::BeginTable(id.c_str(), 3, ImGuiTableFlags_RowBg | ImGuiTableFlags_SizingFixedFit)) return;
    for (const Field& f : fields) {
        ImGui::TableNextRow();
        cell(f.name);
        cell(fieldText(f, bytes));
        cell(f.unit);
    }
    ImGui::EndTable();
}

void components(const World& world, Entity entity) {
    const Archetype* archetype = world.archetypeOf(entity);
    if (!archetype) return text("nothing alive is selected");
    text(entityLabel(world, entity));
    for (const ComponentId id : archetype->components) {
        const ComponentType& type = componentType(id);
        const std::string title(shortTypeName(type.name));
        if (type.sizeBytes == 0) {
            text(title + " (tag)");
        } else if (ImGui::CollapsingHeader(title.c_str(), ImGuiTreeNodeFlags_DefaultOpen)) {
            fieldTable(title, type, fieldsOf(id), world.find(entity, id));
        }
    }
}

void archetypes(const World& world) {
    const WorldReport report = reportWorld(world);
    text(fmt::format("{} entities, {} chunks of {:.1f} MiB in slabs of {:.1f} MiB", report.entities,
                     report.chunks, double(report.chunkBytes) / 1048576, double(report.slabBytes) / 1048576));
    if (!ImGui::BeginTable("archetypes", 5, ImGuiTableFlags_RowBg | ImGuiTableFlags_Resizable)) return;
    for (const char* title : {"components", "rows", "chunks", "fill", "KiB"})
        ImGui::TableSetupColumn(title);
    ImGui::TableHeadersRow();
    for (const ArchetypeReport& a : report.archetypes) {
        if (a.rows == 0) continue;
        ImGui::TableNextRow();
        cell(a.components);
        cell(std::to_string(a.rows));
        cell(std::to_string(a.chunks));
        cell(fmt::format("{:.0f} %", 100 * a.fill()));
        cell(fmt::format("{:.0f}", double(a.bytes) / 1024));
    }
    ImGui::EndTable();
}

}  // namespace

std::string entityLabel(const World& world, Entity entity) {
    const Name* name = world.get<Name>(entity);
    return name && name->text[0] ? fmt::format("{} ({}.{})", name->text, entity.index, entity.generation)
                                 : fmt::format("entity {}.{}", entity.index, entity.generation);
}

void Inspector::entityList(const World& world) {
    ImGui::InputText("name has", filter_.data(), filter_.size());
    listEntities(world, filter_.data(), listed_);
    text(fmt::format("{} of {}", listed_.size(), world.entityCount()));
    ImGuiListClipper clipper;  // 100,000 entities cost as much as those in sight
    clipper.Begin(int(listed_.size()));
    while (clipper.Step())
        for (int i = clipper.DisplayStart; i < clipper.DisplayEnd; ++i) {
            const Entity entity = listed_[size_t(i)];
            if (ImGui::Selectable(entityLabel(world, entity).c_str(), entity == selected_))
                selected_ = entity;
        }
}

void Inspector::build(const World& world) {
    ImGui::Begin("World");
    if (ImGui::BeginTabBar("views")) {
        if (ImGui::BeginTabItem("Entities")) {
            ImGui::BeginChild("list", {ImGui::GetContentRegionAvail().x * 0.4f, 0}, true);
            entityList(world);
            ImGui::EndChild();
            ImGui::SameLine();
            ImGui::BeginChild("components", {0, 0}, true);
            components(world, selected_);
            ImGui::EndChild();
            ImGui::EndTabItem();
        }
        if (ImGui::BeginTabItem("Archetypes")) {
            archetypes(world);
            ImGui::EndTabItem();
        }
        ImGui::EndTabBar();
    }
    ImGui::End();
}

}  // namespace ag
