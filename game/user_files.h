// What a player keeps between runs: the save, the keys and a few wishes, in a folder of their own.
#pragma once

#include <string>

#include "engine/app/bindings.h"
#include "engine/core/result.h"
#include "game/quality.h"

namespace ag::game {

struct UserSettings {
    Quality quality = Quality::kAutomatic;
    float sensitivity = 1;   // of the mouse
    float fieldOfView = 65;  // degrees, upright
    float exposure = 1;      // stops
    float volume = 0.7f;     // of the sound, 0: none
    float resolution = 0;    // of the window's sides that is rendered; 0: as the quality says
    float roomsReached = 0;  // how many rooms may be started from the menu
    bool fullscreen = false;
    bool hints = true;
    bool subtitles = false;  // of sounds
    bool invertLook = false;
};

struct UserFiles {
    std::string folder;
    std::string save() const { return folder + "/save.txt"; }
    std::string keys() const { return folder + "/keys.txt"; }
    std::string settings() const { return folder + "/settings.txt"; }
    std::string times() const { return folder + "/times.txt"; }
    std::string captures() const { return folder + "/captures"; }
    std::string photos() const { return folder + "/photos"; }
};

// Makes the folder if it is not there.
Status openFolder(const UserFiles& files);
Result<UserSettings> loadUserSettings(const std::string& path);
Status saveUserSettings(const UserSettings& settings, const std::string& path);

}  // namespace ag::game
