// Names of the fields of a scene's components, for the inspector. Also makes them known to saved worlds.
#pragma once

namespace ag {

void describeSceneComponents();

}  // namespace ag
