#include "tools/ecs_bench/rows.h"

namespace ag::ecs_bench {

void addCrowdRows(Rows&) {}

}  // namespace ag::ecs_bench
