// A camera of one's own in a world that stands still, at another time of day if one likes. Nothing of it
// reaches the game: no tick runs meanwhile, and eyes and sky are as they were when it ends.
#pragma once

#include <string>
#include <vector>

#include "engine/app/free_camera.h"
#include "game/dress_level.h"
#include "game/game.h"

namespace ag::game {

class PhotoMode {
  public:
    bool on() const { return on_; }
    void enter(Game& game);  // at the player's eyes
    void leave(Game& game);
    void forget() { on_ = false; }                   // of a game that is gone
    bool changedSky() const { return changedSky_; }  // since it was entered, or what is seen of it

    // Flies, and turns the view.
    void move(Game& game, const Input& input, float seconds);
    // Up and down: the angle of view; left and right: the time of day, where the level has a sky; H: shows or
    // hides the lines. Codes are GLFW's.
    void press(Game& game, int code);

    bool showsLines() const { return showsLines_; }
    // What is seen and how, then the light that flowers within `kNear` m sense here and now, then the keys.
    std::vector<std::string> lines(Game& game, const gi::ProbeReadings& readings,
                                   const std::string& layer) const;

    float hour() const { return hour_; }  // of the day, by the sun's height; 0: without a sky
    // s since the camera last moved: the picture may be made better as long as it stands.
    float rested() const { return rested_; }

    static constexpr double kNear = 9;  // m

  private:
    void lookAt(Game& game);
    void setHour(Game& game, float hour);

    bool on_ = false, showsLines_ = true;
    FreeCamera camera_;
    LevelDaylight daylight_;
    std::shared_ptr<const Sky> skyBefore_, seenBefore_;
    bool changedSky_ = false;
    float hour_ = 0, rested_ = 0;
};

// The first of photo-001, photo-002 ... in `folder` of which there is neither PNG nor EXR, with the folder.
std::string nextPhoto(const std::string& folder);

}  // namespace ag::game
