#include "engine/core/failure.h"

#include <atomic>
#include <cstdio>
#include <cstdlib>

namespace ag {
namespace {

std::atomic<FailureHandler> gHandler{nullptr};

}  // namespace

void onFailure(FailureHandler handler) {
    gHandler = handler;
}

void fail(FailureKind kind, const std::string& sentence) {
    if (const FailureHandler handler = gHandler) handler(kind, sentence);
    if (kind == FailureKind::kMistake) abortWith(sentence);
    throw Failure(kind, sentence);
}

void abortWith(const std::string& sentence) {
    std::fprintf(stderr, "%s\n", sentence.c_str());
    std::abort();
}

}  // namespace ag
