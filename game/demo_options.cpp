#include "game/demo_options.h"

#include <iostream>

namespace ag::game {

int refuse(const std::string& sentence) {
    std::cerr << "afterglow-demo: " << sentence << '\n';
    return 2;
}

Input nextInput(Demo& demo, uint64_t tick, const Input& given) {
    const Input input = tick < demo.replay.size() ? demo.replay[tick] : demo.replay.empty() ? given : Input{};
    if (!demo.options.record.empty()) demo.recorded.push_back(input);
    return input;
}

Status finishRecording(const Demo& demo) {
    if (demo.options.record.empty()) return Ok{};
    return saveReplay(demo.recorded, demo.options.record);
}

}  // namespace ag::game
