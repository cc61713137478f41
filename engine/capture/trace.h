// The frames for Perfetto (ui.perfetto.dev) and chrome://tracing: trace.json.
#pragma once

#include "engine/capture/capture.h"

namespace ag::capture {

std::string traceJson(const Capture& capture);

}  // namespace ag::capture
