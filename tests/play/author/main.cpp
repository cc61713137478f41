// Plays the level by script and writes the inputs down: author_walkthrough FILE.replay [TICKS_PER_FRAME].
#include <cstdlib>
#include <iostream>

#include "engine/core/log.h"
#include "tests/play/stage/bot.h"

int main(int argc, char** argv) {
    using namespace ag;
    if (argc < 2) {
        std::cerr << "author_walkthrough FILE.replay [TICKS_PER_FRAME]\n";
        return 2;
    }
    initLogging(false);
    auto device = gpu::Device::create({});
    if (!device) {
        std::cerr << device.error().message << '\n';
        return 2;
    }
    game::Stage stage(**device, game::shippedLevel(), argc > 2 ? uint32_t(std::atoi(argv[2])) : 4);
    game::Bot bot(stage, true);
    const bool finished = game::playWalkthrough(bot);
    const game::Progress& p = stage.game.progress();
    std::cout << bot.inputs().size() << " ticks, " << p.flowersOpen << " of " << p.flowers
              << " flowers open, " << p.roomsSolved << " of " << p.rooms << " rooms solved"
              << (p.won ? ", finished" : "") << '\n';
    if (const Status saved = saveReplay(bot.inputs(), argv[1]); !saved) {
        std::cerr << saved.error().message << '\n';
        return 2;
    }
    return finished && p.won ? 0 : 1;
}
