// Plays the level by script and writes the inputs down:
//   author_walkthrough walkthrough|direct_beam|wrong_colour|wall_between FILE.replay [TICKS_PER_FRAME]
//   author_walkthrough from:ROOM FILE.replay: starts there, to try a room alone; what it writes is no
//   recording
#include <cstdlib>
#include <iostream>
#include <string_view>

#include "engine/core/log.h"
#include "game/save_game.h"
#include "tests/play/stage/bot.h"

namespace {

struct Script {
    std::string_view name;
    bool (*play)(ag::game::Bot&);
};
constexpr Script kScripts[] = {{"walkthrough", ag::game::playWalkthrough},
                               {"direct_beam", ag::game::playDirectBeam},
                               {"wrong_colour", ag::game::playWrongColour},
                               {"wall_between", ag::game::playWallBetween}};

int author(const Script& script, const char* path, uint32_t ticksPerFrame, int room = 0) {
    auto device = ag::gpu::Device::create({});
    if (!device) {
        std::cerr << device.error().message << '\n';
        return 2;
    }
    ag::game::Stage stage(**device, ag::game::shippedLevel(), ticksPerFrame);
    ag::game::Bot bot(stage, true);
    if (room > 0) ag::game::startAtRoom(stage.game, room);
    const bool asPlanned = room > 0 ? ag::game::playFrom(bot, room) : script.play(bot);
    const ag::game::Progress& p = stage.game.progress();
    std::cout << bot.inputs().size() << " ticks, " << p.flowersOpen << " of " << p.flowers
              << " flowers open, " << p.roomsSolved << " of " << p.rooms << " rooms solved"
              << (p.won ? ", finished" : "") << '\n';
    if (const ag::Status saved = ag::saveReplay({bot.inputs(), {}}, path); !saved) {
        std::cerr << saved.error().message << '\n';
        return 2;
    }
    return asPlanned ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
    ag::initLogging(false);
    for (const Script& script : kScripts)
        if (argc > 2 && script.name == argv[1])
            return author(script, argv[2], argc > 3 ? uint32_t(std::atoi(argv[3])) : 12);
    if (argc > 2 && std::string_view(argv[1]).starts_with("from:"))
        return author(kScripts[0], argv[2], argc > 3 ? uint32_t(std::atoi(argv[3])) : 12,
                      std::atoi(argv[1] + 5));
    std::cerr << "author_walkthrough walkthrough|direct_beam|wrong_colour|wall_between FILE.replay "
                 "[TICKS_PER_FRAME]\n";
    return 2;
}
