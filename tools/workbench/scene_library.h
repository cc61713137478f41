// Real scenes beside the repository, by short names: a folder with a scenes.json that lists files, views and
// suns. It is not part of the repository, because not all of it is free to copy.
#pragma once

#include <optional>
#include <string>

#include "engine/core/result.h"

namespace ag::workbench {

struct LibraryScene {
    std::string file;
    std::string view;  // as --view takes it; empty: the list has none
    std::string sun;   // as --sun takes it; empty: the scene has lights of its own
};

// "sponza" or "sponza:1" for its second view. Nothing if there is no library or it has no such scene; an
// error if it has no such view.
Result<std::optional<LibraryScene>> findInLibrary(const std::string& name);

}  // namespace ag::workbench
