// The menu: a list with a selection, moved by arrow keys, mouse or gamepad. It knows no game: what was chosen
// comes back as an event.
#pragma once

#include <string>
#include <vector>

#include "game/user_files.h"

namespace ag::game {

enum class MenuPage : uint32_t { kMain, kSettings, kKeys, kGamepad, kRooms };
enum class MenuEvent : uint32_t {
    kNone,
    kResume,
    kContinue,
    kNewGame,
    kQuit,
    kStartRoom,  // Menu::room
    kPhotoMode,
    kSettingsChanged,
    kKeysChanged
};

struct Menu {
    bool open = true;
    bool started = false;  // a game is under way
    bool hasSave = false;
    MenuPage page = MenuPage::kMain;
    int selected = 0;
    int room = 0;  // that was chosen
    bool waitsForKey =
        false;            // the next key, or button on the gamepad's page, is bound to the selected action
    std::string message;  // what went wrong, in one sentence
    std::vector<std::string> roomNotes;  // beside each room: the best time in it

    bool waitsForPad() const { return waitsForKey && page == MenuPage::kGamepad; }
};

// What can be chosen on a page, top to bottom.
std::vector<std::string> menuLines(const Menu& menu, const UserSettings& settings, const Bindings& keys);

// KeyPress::code, or where the menu waits for the gamepad KeyPress::pad; keys count there, too: escape gives
// up.
MenuEvent pressInMenu(Menu& menu, int code, UserSettings& settings, Bindings& keys);
// Within an ImGui frame, under a header and over a footer; the line that was clicked is chosen.
MenuEvent drawMenu(Menu& menu, UserSettings& settings, Bindings& keys, const std::string& header,
                   const std::string& footer);

}  // namespace ag::game
