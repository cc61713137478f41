#include "engine/core/process_memory.h"

#include <unistd.h>

#include <cstdint>
#include <fstream>

namespace ag {

double residentMib() {
    std::ifstream statm("/proc/self/statm");
    uint64_t total = 0, resident = 0;
    statm >> total >> resident;
    return double(resident) * double(sysconf(_SC_PAGESIZE)) / 1048576.0;
}

}  // namespace ag
