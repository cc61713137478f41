// A capture as the files of its folder.
#pragma once

#include "engine/capture/folder.h"
#include "engine/capture/pass_table.h"

namespace ag::capture {

// Everything but what the folder's open place holds already; `exr`: the values of every picture, too. All or
// nothing.
Status saveCapture(Folder& folder, const Capture& capture, const std::vector<PassRow>& table, bool exr);

}  // namespace ag::capture
