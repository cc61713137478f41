#include "game/menu.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <span>

namespace ag::game {
namespace {

enum class MainLine { kResume, kPhoto, kContinue, kNew, kRooms, kSettings, kKeys, kGamepad, kQuit };
enum SettingLine {
    kQuality,
    kSensitivity,
    kFieldOfView,
    kExposure,
    kVolume,
    kResolution,
    kFullscreen,
    kHints,
    kSubtitles,
    kInvert,
    kSettingsBack
};

void openPage(Menu& menu, MenuPage page) {
    menu.page = page;
    menu.selected = 0;
}

// Only what can be done.
std::vector<MainLine> mainLines(const Menu& menu, const UserSettings& settings) {
    std::vector<MainLine> lines;
    const auto add = [&](bool possible, MainLine line) {
        if (possible) lines.push_back(line);
    };
    add(menu.started, MainLine::kResume);
    add(menu.started, MainLine::kPhoto);
    add(menu.hasSave, MainLine::kContinue);
    add(true, MainLine::kNew);
    add(settings.roomsReached > 1, MainLine::kRooms);
    for (const MainLine line : {MainLine::kSettings, MainLine::kKeys, MainLine::kGamepad, MainLine::kQuit})
        add(true, line);
    return lines;
}

std::string textOf(MainLine line, const Menu& menu) {
    switch (line) {
        case MainLine::kResume:
            return "Resume";
        case MainLine::kPhoto:
            return "Photo mode";
        case MainLine::kContinue:
            return menu.started ? "Back to the saved game" : "Continue";
        case MainLine::kNew:
            return "New game";
        case MainLine::kRooms:
            return "Rooms";
        case MainLine::kSettings:
            return "Settings";
        case MainLine::kKeys:
            return "Keys";
        case MainLine::kGamepad:
            return "Gamepad";
        default:
            return "Quit";
    }
}

MenuEvent chooseMain(Menu& menu, const UserSettings& settings) {
    switch (mainLines(menu, settings)[size_t(menu.selected)]) {
        case MainLine::kResume:
            return MenuEvent::kResume;
        case MainLine::kPhoto:
            return MenuEvent::kPhotoMode;
        case MainLine::kContinue:
            return MenuEvent::kContinue;
        case MainLine::kNew:
            return MenuEvent::kNewGame;
        case MainLine::kRooms:
            openPage(menu, MenuPage::kRooms);
            return MenuEvent::kNone;
        case MainLine::kSettings:
            openPage(menu, MenuPage::kSettings);
            return MenuEvent::kNone;
        case MainLine::kKeys:
            openPage(menu, MenuPage::kKeys);
            return MenuEvent::kNone;
        case MainLine::kGamepad:
            openPage(menu, MenuPage::kGamepad);
            return MenuEvent::kNone;
        default:
            return MenuEvent::kQuit;
    }
}

// A step to the right or, with -1, to the left.
MenuEvent changeSetting(Menu& menu, UserSettings& s, int step) {
    const auto move = [&](float& value, float by, float least, float most) {
        value = std::clamp(value + by * float(step), least, most);
    };
    switch (menu.selected) {
        case kQuality:
            s.quality = Quality((uint32_t(s.quality) + uint32_t(5 + step)) % 5);
            break;
        case kSensitivity:
            move(s.sensitivity, 0.1f, 0.1f, 5);
            break;
        case kFieldOfView:
            move(s.fieldOfView, 5, 40, 100);
            break;
        case kExposure:
            move(s.exposure, 0.5f, -4, 6);
            break;
        case kVolume:
            move(s.volume, 0.1f, 0, 1);
            s.volume = std::round(s.volume * 10) / 10;  // ends at nothing, not nearly
            break;
        case kResolution: {
            // 0 stands below a half, which is the least.
            const int tenths = s.resolution > 0 ? int(std::lround(s.resolution * 10)) - 4 : 0;
            const int next = (tenths + step + 7) % 7;
            s.resolution = next > 0 ? float(next + 4) / 10 : 0;
            break;
        }
        case kFullscreen:
            s.fullscreen = !s.fullscreen;
            break;
        case kHints:
            s.hints = !s.hints;
            break;
        case kSubtitles:
            s.subtitles = !s.subtitles;
            break;
        case kInvert:
            s.invertLook = !s.invertLook;
            break;
        default:
            openPage(menu, MenuPage::kMain);
            return MenuEvent::kNone;
    }
    return MenuEvent::kSettingsChanged;
}

MenuEvent choose(Menu& menu, UserSettings& settings) {
    menu.message.clear();
    if (menu.page == MenuPage::kMain) return chooseMain(menu, settings);
    if (menu.page == MenuPage::kSettings) return changeSetting(menu, settings, 1);
    if (menu.page == MenuPage::kRooms) {
        menu.room = menu.selected;
        const bool back = menu.selected >= int(settings.roomsReached);
        openPage(menu, MenuPage::kMain);
        return back ? MenuEvent::kNone : MenuEvent::kStartRoom;
    }
    const size_t actions = menu.page == MenuPage::kGamepad ? kPadActionCount : kActionCount;
    if (menu.selected >= int(actions))
        openPage(menu, MenuPage::kMain);
    else
        menu.waitsForKey = true;
    return MenuEvent::kNone;
}

// Two actions never share a key: the other one takes the key this one had.
void bind(std::span<int> codes, size_t action, int code) {
    for (int& other : codes)
        if (other == code) other = codes[action];
    codes[action] = code;
}

MenuEvent bindKey(Menu& menu, int code, Bindings& keys) {
    const bool pad = menu.waitsForPad();
    // A key is none of the gamepad's buttons: it goes on waiting for one.
    if (pad && code < kPadCode && code != GLFW_KEY_ESCAPE) return MenuEvent::kNone;
    menu.waitsForKey = false;
    if (code == GLFW_KEY_ESCAPE) return MenuEvent::kNone;
    if (codeName(code).empty() || (code >= kPadCode) != pad) {
        menu.message = pad ? "That button cannot be used." : "That key cannot be used.";
        return MenuEvent::kNone;
    }
    bind(pad ? std::span<int>(keys.pad) : std::span<int>(keys.codes), size_t(menu.selected), code);
    return MenuEvent::kKeysChanged;
}

std::vector<std::string> bindingLines(const Menu& menu, std::span<const int> codes, Action first) {
    std::vector<std::string> lines;
    for (size_t i = 0; i < codes.size(); ++i)
        lines.push_back(fmt::format("{}: {}", actionName(Action(size_t(first) + i)),
                                    !menu.waitsForKey || int(i) != menu.selected ? spokenName(codes[i])
                                    : menu.page == MenuPage::kGamepad            ? "press a button"
                                                                                 : "press a key"));
    lines.push_back("Back");
    return lines;
}

}  // namespace

std::vector<std::string> menuLines(const Menu& menu, const UserSettings& s, const Bindings& keys) {
    std::vector<std::string> lines;
    if (menu.page == MenuPage::kMain) {
        for (const MainLine line : mainLines(menu, s))
            lines.push_back(textOf(line, menu));
        return lines;
    }
    if (menu.page == MenuPage::kRooms) {
        for (int i = 0; i < int(s.roomsReached); ++i)
            lines.push_back(size_t(i) < menu.roomNotes.size() && !menu.roomNotes[size_t(i)].empty()
                                ? fmt::format("Room {}: {}", i + 1, menu.roomNotes[size_t(i)])
                                : fmt::format("Room {}", i + 1));
        lines.push_back("Back");
        return lines;
    }
    if (menu.page == MenuPage::kSettings)
        return {fmt::format("Quality: {}", qualityName(s.quality)),
                fmt::format("Mouse: {:.1f}", s.sensitivity),
                fmt::format("Field of view: {:.0f} degrees", s.fieldOfView),
                fmt::format("Brightness: {:+.1f} stops", s.exposure),
                s.volume > 0 ? fmt::format("Sound: {:.0f} %", s.volume * 100) : "Sound: off",
                s.resolution > 0 ? fmt::format("Resolution: {:.0f} %", s.resolution * 100)
                                 : "Resolution: by quality",
                fmt::format("Fullscreen: {}", s.fullscreen ? "on" : "off"),
                fmt::format("Hints: {}", s.hints ? "on" : "off"),
                fmt::format("Subtitles of sounds: {}", s.subtitles ? "on" : "off"),
                fmt::format("Mouse up looks {}", s.invertLook ? "down" : "up"),
                "Back"};
    return menu.page == MenuPage::kGamepad ? bindingLines(menu, keys.pad, kFirstPadAction)
                                           : bindingLines(menu, keys.codes, Action(0));
}

MenuEvent pressInMenu(Menu& menu, int code, UserSettings& settings, Bindings& keys) {
    if (menu.waitsForKey) return bindKey(menu, code, keys);
    const int count = int(menuLines(menu, settings, keys).size());
    if (code == GLFW_KEY_UP) menu.selected = (menu.selected + count - 1) % count;
    if (code == GLFW_KEY_DOWN) menu.selected = (menu.selected + 1) % count;
    if (menu.page == MenuPage::kSettings && menu.selected != kSettingsBack) {
        if (code == GLFW_KEY_LEFT) return changeSetting(menu, settings, -1);
        if (code == GLFW_KEY_RIGHT) return changeSetting(menu, settings, 1);
    }
    if (code == GLFW_KEY_ENTER || code == GLFW_KEY_KP_ENTER) return choose(menu, settings);
    if (code == GLFW_KEY_ESCAPE) {
        if (menu.page != MenuPage::kMain)
            openPage(menu, MenuPage::kMain);
        else if (menu.started)
            return MenuEvent::kResume;
    }
    return MenuEvent::kNone;
}

MenuEvent drawMenu(Menu& menu, UserSettings& settings, Bindings& keys, const std::string& header,
                   const std::string& footer) {
    const ImVec2 size = ImGui::GetIO().DisplaySize;
    ImGui::GetBackgroundDrawList()->AddRectFilled({0, 0}, size, IM_COL32(0, 0, 0, 120));
    ImGui::SetNextWindowPos({size.x / 2, size.y / 2}, ImGuiCond_Always, {0.5f, 0.5f});
    ImGui::Begin("Afterglow", nullptr,
                 ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoCollapse |
                     ImGuiWindowFlags_NoNav);
    MenuEvent event = MenuEvent::kNone;
    ImGui::TextColored({1, 0.85f, 0.55f, 1}, "%s", header.c_str());
    ImGui::Separator();
    const std::vector<std::string> lines = menuLines(menu, settings, keys);
    for (int i = 0; i < int(lines.size()); ++i) {
        ImGui::PushID(i);
        // One highlight for mouse and keys: what is pointed at is selected as soon as the mouse moves.
        const ImVec4 highlight = ImGui::GetStyleColorVec4(ImGuiCol_Header);
        ImGui::PushStyleColor(ImGuiCol_HeaderHovered, i == menu.selected ? highlight : ImVec4(0, 0, 0, 0));
        const bool clicked = ImGui::Selectable(lines[size_t(i)].c_str(), i == menu.selected);
        ImGui::PopStyleColor();
        const ImVec2 moved = ImGui::GetIO().MouseDelta;
        const bool pointedAt = ImGui::IsItemHovered() && (moved.x != 0 || moved.y != 0);
        if ((clicked || pointedAt) && !menu.waitsForKey) menu.selected = i;
        if (clicked && !menu.waitsForKey) event = choose(menu, settings);
        ImGui::PopID();
    }
    ImGui::Separator();
    if (!menu.message.empty()) ImGui::TextWrapped("%s", menu.message.c_str());
    ImGui::TextUnformatted(footer.c_str());
    ImGui::End();
    return event;
}

}  // namespace ag::game
