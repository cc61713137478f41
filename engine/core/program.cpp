#include "engine/core/program.h"

#include <sys/mman.h>

#include <atomic>
#include <csignal>
#include <cstdlib>
#include <memory>
#include <new>
#include <stdexcept>

#include "engine/core/driver_cache.h"
#include "engine/core/failure.h"
#include "engine/core/log.h"

namespace ag {
namespace {

std::function<void()> gSave;
std::atomic<bool> gEnding{false};
// Given back when memory runs out, so that there is room to say so and to save.
std::unique_ptr<char[]> gReserve;
constexpr size_t kReserveBytes = size_t(4) << 20;

constexpr const char* kOutOfMemory = "out of memory: a smaller scene, size or quality needs less";

void endOnFailure(FailureKind kind, const std::string& sentence) {
    if (kind == FailureKind::kMistake) abortWith(sentence);
    endProgram(sentence);
}

void onOutOfMemory() {
    if (gEnding) std::_Exit(kExitOutOfReach);
    gReserve.reset();
    endProgram(kOutOfMemory);
}

// A library that used what it could not allocate: a crash for want of memory. Any other crash goes on as it
// would.
void onCrash(int signal) {
    if (!hasRoom()) {
        gReserve.reset();
        endProgram(kOutOfMemory);
    }
    ::signal(signal, SIG_DFL);
    ::raise(signal);
}

// On a stack of its own: the crash may be that of a stack.
void catchCrashes() {
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
    static char stack[1 << 16];
    const stack_t own{.ss_sp = stack, .ss_flags = 0, .ss_size = sizeof stack};
    ::sigaltstack(&own, nullptr);
    struct sigaction action {};
    action.sa_handler = onCrash;
    action.sa_flags = SA_ONSTACK | SA_NODEFER;
    for (const int signal : {SIGSEGV, SIGBUS, SIGABRT})
        ::sigaction(signal, &action, nullptr);
#endif
}

}  // namespace

bool hasRoom() {
    constexpr size_t kRoomBytes = size_t(256) << 20;
    void* room = ::mmap(nullptr, kRoomBytes, PROT_NONE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
    if (room == MAP_FAILED) return false;
    ::munmap(room, kRoomBytes);
    return true;
}

void onProgramEnd(std::function<void()> save) {
    gSave = std::move(save);
}

void endProgram(const std::string& sentence) {
    const bool first = !gEnding.exchange(true);
    if (first) {
        spdlog::critical("{}", sentence);
        if (gSave) gSave();
        spdlog::shutdown();
    }
    std::_Exit(kExitOutOfReach);
}

int runProgram(FunctionRef<int()> body) {
    initLogging(false);
    separateDriverCaches();
    gReserve = std::make_unique<char[]>(kReserveBytes);
    std::set_new_handler(onOutOfMemory);
    onFailure(endOnFailure);
    catchCrashes();
    try {
        return body();
    } catch (const std::bad_alloc&) {
        endProgram(kOutOfMemory);
    } catch (const std::length_error&) {  // a container of more than any memory holds
        endProgram(kOutOfMemory);
    }
}

}  // namespace ag
