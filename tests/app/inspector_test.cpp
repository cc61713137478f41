// The inspector without a window: ImGui lays out and draws into lists nobody shows.
#include "engine/app/inspector.h"

#include <gtest/gtest.h>
#include <imgui.h>

#include "engine/scene/components.h"
#include "engine/scene/describe_components.h"

namespace ag {
namespace {

class Ui {
  public:
    Ui() {
        ImGui::CreateContext();
        ImGuiIO& io = ImGui::GetIO();
        io.IniFilename = nullptr;
        io.DisplaySize = {1200, 800};
        unsigned char* pixels = nullptr;
        int width = 0, height = 0;
        io.Fonts->GetTexDataAsRGBA32(&pixels, &width, &height);
    }
    ~Ui() { ImGui::DestroyContext(); }
    // Vertices drawn.
    int frame(Inspector& inspector, const World& world) {
        for (int i = 0; i < 3; ++i) {  // windows find their sizes in the first frames
            ImGui::NewFrame();
            ImGui::SetNextWindowPos({0, 0});
            ImGui::SetNextWindowSize({1100, 700});
            inspector.build(world);
            ImGui::Render();
        }
        return ImGui::GetDrawData()->TotalVtxCount;
    }
};

World& lamps(World& world, int count) {
    for (int i = 0; i < count; ++i)
        world.create(makeName(i % 2 ? "lamp " + std::to_string(i) : "Box " + std::to_string(i)),
                     LocalTransform{});
    return world;
}

TEST(Inspector, ListsByNameAndShowsTheFieldsOfOne) {
    describeSceneComponents();
    World world;
    lamps(world, 40);
    const Entity light = world.create(LocalTransform{}, PunctualLight{}, makeName("sun"));
    Ui ui;
    Inspector inspector;
    const int nothingSelected = ui.frame(inspector, world);
    EXPECT_EQ(inspector.listed().size(), 41u);
    inspector.select(light);
    const int selected = ui.frame(inspector, world);
    EXPECT_GT(selected, nothingSelected + 400) << "names, values and units of 11 fields and more";
    std::copy_n("BOX", 4, inspector.filter().begin());
    ui.frame(inspector, world);
    EXPECT_EQ(inspector.listed().size(), 20u);
    world.destroy(light);
    EXPECT_LT(ui.frame(inspector, world), selected) << "what died is not shown";
    EXPECT_EQ(entityLabel(world, light), "entity " + std::to_string(light.index) + ".0");
}

TEST(Inspector, ManyEntitiesDrawAsManyAsFit) {
    World few, many;
    lamps(few, 200);
    lamps(many, 100'000);
    Ui ui;
    Inspector a, b;
    const int small = ui.frame(a, few), large = ui.frame(b, many);
    EXPECT_EQ(b.listed().size(), 100'000u);
    EXPECT_LT(large, small * 2);
}

}  // namespace
}  // namespace ag
