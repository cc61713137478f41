// Memory of this process.
#pragma once

namespace ag {

double residentMib();  // that is in use, MiB; 0 where nothing is known

}  // namespace ag
