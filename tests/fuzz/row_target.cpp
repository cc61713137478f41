// A kept row of the benchmark; what can be read can be written and read again.
#include <nlohmann/json.hpp>

#include "tools/bench/report.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* bytes, size_t size) {
    const nlohmann::json json = nlohmann::json::parse(bytes, bytes + size, nullptr, false);
    if (json.is_discarded()) return 0;
    const auto row = ag::bench::rowFromJson(json);
    if (row && !ag::bench::rowFromJson(ag::bench::rowToJson(*row))) std::abort();
    return 0;
}
