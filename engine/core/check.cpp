#include "engine/core/check.h"

#include "engine/core/failure.h"

namespace ag {

void checkFailed(const char* file, int line, const char* expression, const std::string& detail) {
    std::string sentence = std::string(file) + ":" + std::to_string(line) + ": check failed: " + expression;
    if (!detail.empty()) sentence += ": " + detail;
    fail(FailureKind::kMistake, sentence);
}

}  // namespace ag
