// The profiler over a running program: the last frames as stacked columns of what each technique cost on the
// device, the budget as a line, and the frames that stood out, kept until they are forgotten.
#pragma once

#include "engine/app/panel_layout.h"
#include "engine/app/pass_history.h"

namespace ag {

// Within an ImGui frame. `budgetMs` can be changed in it.
void drawProfiler(const PanelLayout& layout, PassHistory& history, float& budgetMs);

}  // namespace ag
