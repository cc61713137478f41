// What a schedule's systems took, and who of them waits for whom, in a capture's terms.
#pragma once

#include "engine/capture/capture.h"
#include "engine/ecs/schedule.h"

namespace ag::capture {

// Of the schedule's last run.
void noteSystems(const Schedule& schedule, std::vector<Span>& spans);
// Adds the systems and their order to those of the schedules before it.
void describeSchedule(Schedule& schedule, Capture& capture);

}  // namespace ag::capture
