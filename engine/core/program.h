// How every program of ours begins, and how it ends when the world fails it.
#pragma once

#include <functional>
#include <string>

#include "engine/core/function_ref.h"

namespace ag {

// Exit codes: 0 good, 1 a check failed, 2 bad arguments or input, 3 no memory or no device.
constexpr int kExitRefused = 2, kExitOutOfReach = 3;

// Logs to stderr and returns what `body` does. Running out of memory and failures of the device (failure.h),
// on any thread, are one sentence and exit code 3.
int runProgram(FunctionRef<int()> body);

// Whether there is address space left to go on with: libraries that do not check their allocations crash
// without.
bool hasRoom();

// Called once before a program ends by endProgram: the place to save what must not be lost. It must not use
// the device. Empty: nothing is done.
void onProgramEnd(std::function<void()> save);
// Says the sentence, saves, ends at once with exit code 3: destructors might use what failed.
[[noreturn]] void endProgram(const std::string& sentence);

}  // namespace ag
