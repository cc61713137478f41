// The shipped walkthrough, as it is played.
#include "tests/play/stage/bot.h"

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
    return b.waitForFlower(7);
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

bool playWalkthrough(Bot& b) {
    b.wait(20);
    if (!lightRoom(b) || !b.waitForDoor(0)) return false;
    b.lookAhead();
    b.walk(0, -7.2);
    b.walk(0, -12.2);
    if (!colourRoom(b) || !b.waitForDoor(1)) return false;
    b.lookAhead();
    b.walk(0, -19.2);
    b.walk(0, -24.0);
    if (!shadowRoom(b) || !b.waitForDoor(2)) return false;
    b.lookAhead();
    b.walk(3.4, -28.6);
    b.hold(0);
    b.walk(0, -29.2);
    b.walk(0, -36.2);
    if (!paintRoom(b) || !b.waitForDoor(3)) return false;
    b.lookAhead();
    b.walk(0, -43.2);
    b.walk(0, -46.4);
    b.wait(120);
    return !b.failed();
}

}  // namespace ag::game
