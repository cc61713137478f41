// A capture's table of passes, and any table of its folder; what can be read can be written and read again.
#include "engine/capture/pass_table.h"
#include "tests/fuzz/as_file.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* bytes, size_t size) {
    const std::string& path = ag::fuzz::asFile(bytes, size, ".csv");
    const auto file = ag::capture::readCsv(path);
    if (file)
        for (const auto& row : file->rows)
            if (row.size() != file->header.size()) std::abort();
    const auto rows = ag::capture::readTable(path);
    if (!rows) return 0;
    const std::string again = ag::capture::tableCsv(*rows);
    const auto read = ag::capture::readTable(
        ag::fuzz::asFile(reinterpret_cast<const uint8_t*>(again.data()), again.size(), ".csv"));
    if (!read || read->size() != rows->size()) std::abort();
    return 0;
}
