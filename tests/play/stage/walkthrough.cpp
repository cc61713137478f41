// The shipped walkthrough, as it is played.
#include "tests/play/stage/bot.h"

#include <iterator>

namespace ag::game {
namespace {

bool lightRoom(Bot& b) {
    b.walk(-1.0, -4.7);
    b.look(-4.0, 1.5, -5.0);
    if (!b.waitForFlower(0)) return false;
    b.lookAhead();
    b.walk(1.2, -4.6);
    b.walk(2.9, -5.0);
    b.look(4.0, 1.3, -6.0);
    return b.waitForFlower(1);
}

bool colourRoom(Bot& b) {
    b.walk(-2.6, -14.2);
    b.look(-5.0, 1.5, -14.4);
    if (!b.waitForFlower(2)) return false;
    b.lookAhead();
    b.walk(0, -14.2);
    b.walk(2.6, -14.2);
    b.look(5.0, 1.5, -14.4);
    if (!b.waitForFlower(3)) return false;
    b.lookAhead();
    b.walk(1.0, -17.6);
    b.look(1.7, 1.5, -20.0);
    return b.waitForFlower(4);
}

bool shadowRoom(Bot& b) {
    // The crate into the beam
    b.walk(0.4, -24.0);
    b.walk(0.4, -25.5, 160);
    b.walk(-1.2, -25.2);
    b.look(-5.0, 1.2, -25.8);
    if (!b.waitForFlower(6)) return false;
    // The panel; past the open flower with the lamp turned away
    b.look(4.5, 1.5, -24.5);
    b.walk(-1.2, -28.8);
    b.lookAhead();
    b.walk(-3.6, -29.6);
    b.walk(-5.6, -29.75, 120, 0.3);
    b.walk(-6.2, -30.1, 120, 0.25);
    b.walk(-5.2, -29.9);
    b.look(-7.2, 1.6, -30.5);
    if (!b.waitForFlower(5)) return false;
    // Under the curtain
    b.lookAhead();
    b.walk(-2, -28.6);
    b.walk(1.2, -27.6);
    b.walk(3.6, -28.6);
    b.hold(kButtonCrouch);
    b.walk(3.4, -30.4);
    b.look(3.0, 1.3, -32.0);
    if (!b.waitForFlower(7)) return false;
    b.lookAhead();
    b.walk(3.4, -28.6);
    b.hold(0);
    b.walk(0, -29.2);
    return true;
}

bool paintRoom(Bot& b) {
    // The yellow crate to its flower, lit from the flower's side
    b.walk(1.9, -37.6);
    b.walk(1.8, -38.4);
    b.walk(-1.0, -38.4, 240);
    b.walk(-1.4, -39.8);
    b.walk(-3.4, -40.0);
    b.look(-2.2, 0.4, -38.4);
    if (!b.waitForFlower(8)) return false;
    // The swinging board, from beside its flower
    b.lookAhead();
    b.walk(-1.0, -41.0);
    b.walk(-0.8, -43.1);
    b.look(-2.7, 1.2, -41.6);
    if (!b.waitForFlower(10)) return false;
    // The panel, turned round its post
    b.lookAhead();
    b.walk(0.6, -41.6);
    b.walk(1.2, -39.6);
    b.walk(3.0, -39.6);
    b.walk(3.0, -41.2, 120, 0.3);
    b.walk(3.4, -40.6);
    b.look(2.0, 1.0, -41.4);
    return b.waitForFlower(9);
}

bool mixingRoom(Bot& b) {
    b.walk(-1.2, -51.0);
    b.look(-4.5, 2.1, -51.0);
    if (!b.waitForFlower(11)) return false;
    b.lookAhead();
    b.walk(1.2, -51.0);
    b.look(4.5, 2.1, -51.0);
    if (!b.waitForFlower(12)) return false;
    b.lookAhead();
    b.walk(1.4, -53.6);
    return true;
}

bool signRoom(Bot& b) {
    b.walk(0, -62.0);
    b.look(0, 0.65, -63.2);
    b.press(kButtonUse);
    b.lookAhead();
    b.walk(-1.3, -62.4);
    b.walk(-2.2, -64.2);
    b.look(-2.2, 0.6, -61.5);
    if (!b.waitForFlower(13)) return false;
    b.look(2.2, 0.8, -64.6);
    b.walk(2.2, -64.2);
    b.look(2.2, 0.6, -61.5);
    if (!b.waitForFlower(14)) return false;
    b.press(kButtonUse);
    return true;
}

bool nightRoom(Bot& b) {
    b.walk(-2.7, -71.8);
    b.look(-2.7, 0.3, -73.5);
    b.press(kButtonUse);
    b.look(0, 1.2, -69.0);
    b.walk(0.4, -70.8);
    b.press(kButtonUse);
    b.walk(1.2, -72.4);
    b.look(4.5, 2.0, -72.0);
    return b.waitForFlower(16) && b.waitForFlower(15);
}

// In by the shutter and out again.
void openShutter(Bot& b, double z) {
    b.lookAhead();
    b.walk(3.6, z + 0.2);
    b.walk(5.1, z + 0.25, 120, 0.3);
    b.walk(5.7, z - 0.1, 120, 0.25);
    b.walk(4.7, z + 0.1);
    b.walk(2.6, z);
}

bool greenhouseRoom(Bot& b) {
    b.walk(2.4, -81.0);
    openShutter(b, -82);
    b.look(2.4, 0, -84.0);
    if (!b.waitForFlower(17)) return false;
    b.walk(1.6, -84.0);
    openShutter(b, -86);
    b.look(2.4, 0, -84.0);
    return b.waitForFlower(18);
}

}  // namespace

bool playDirectBeam(Bot& b) {
    b.wait(12);
    b.walk(-1.0, -3.9);
    b.look(-2.9, 1.4, -3.9);
    b.wait(300);
    return !b.failed();
}

bool playWallBetween(Bot& b) {
    b.wait(12);
    b.walk(0.4, -5.6);
    b.walk(0.4, -7.1);
    b.look(2.3, 1.2, -7.1);
    b.wait(300);
    return !b.failed();
}

bool playWrongColour(Bot& b) {
    b.wait(12);
    if (!lightRoom(b) || !b.waitForDoor(0)) return false;
    b.lookAhead();
    b.walk(0, -7.2);
    b.walk(0, -13.8);
    b.walk(1.2, -16.2);
    b.look(5.0, 1.5, -16.8);
    b.wait(300);
    return !b.failed();
}

namespace {

// The rooms in order: how each is played, and where one enters it.
struct Played {
    bool (*play)(Bot&);
    double entrance;  // m, z
};
constexpr Played kRooms[] = {{lightRoom, -1.2},  {colourRoom, -12.2},    {shadowRoom, -24.0},
                             {paintRoom, -36.2}, {mixingRoom, -48.2},    {signRoom, -59.2},
                             {nightRoom, -69.7}, {greenhouseRoom, -80.2}};
constexpr double kGarden = -90.5;

}  // namespace

bool playFrom(Bot& b, int room) {
    b.wait(20);
    for (; room < int(std::size(kRooms)); ++room) {
        if (!kRooms[room].play(b) || !b.waitForDoor(room)) return false;
        const double next = room + 1 < int(std::size(kRooms)) ? kRooms[room + 1].entrance : kGarden;
        b.lookAhead();
        b.walk(0, next + 4.8);  // before the door
        b.walk(0, next);
    }
    b.wait(120);
    return !b.failed();
}

bool playWalkthrough(Bot& b) {
    return playFrom(b, 0);
}

}  // namespace ag::game
