// What the viewer saves: a scene with its view and lights, a preset and settings, as a JSON file that other
// commands take with --session.
#pragma once

#include <string>
#include <vector>

#include "tools/workbench/scene_options.h"

namespace ag::workbench {

struct Session {
    SceneOptions scene;
    std::string preset = "afterglow";
    std::vector<std::string> assignments;  // group.name=value
};

Status saveSession(const Session& session, const std::string& path);
Result<Session> loadSession(const std::string& path);

// The file's session with what was given beside it on top: scene, view, size, lights and settings. `preset`
// empty: the file's. Without a file, what was given.
Result<Session> withSession(const std::string& path, Session given);

// The same in place, for commands that keep these three among their options.
Status useSession(const std::string& path, SceneOptions& scene, std::string& preset,
                  std::vector<std::string>& assignments);

// The lights in place of the scene's own and of those that options add.
void describeLights(const RenderScene& scene, SceneOptions& options);
std::string describeSky(const Sky& clear);  // as --sky takes it

}  // namespace ag::workbench
