// A frame's passes and resources as plain data, for tables, pictures and captures: who reads and writes what,
// how much work, and why something was left out. Made on demand; the graph keeps none of it.
#pragma once

#include <string>
#include <vector>

#include "engine/frame/frame_graph.h"

namespace ag {

enum class ResourceRole { kOwned, kHistory, kPrevious, kImport };

struct ResourceDescription {
    std::string name;
    ResourceRole role = ResourceRole::kOwned;
    ImageHandle image;    // one of the two is valid
    BufferHandle buffer;  // of the frame described
    uint64_t sizeBytes = 0;
    bool isOutput = false;
};

enum class WorkUnit { kThreads, kPixels, kIndirectDraws, kIndirectGroups, kBytes };

struct PassDescription {
    std::string name, shader;
    PassOutcome outcome = PassOutcome::kDropped;
    std::string_view reason;              // why it did not run; empty if it did
    PassReason cause = PassReason::kAll;  // why it ran or did not
    uint32_t changed = ~0u;               // kInput, kHistory: the resource that had changed, an index
    std::vector<uint32_t> reads, writes;  // indices into FrameDescription::resources; what a pass writes over
                                          // without looking at it is not read
    bool uploads = false;                 // what the host gave it
    uint64_t resourceBytes = 0;           // of all it reads and writes, each once
    WorkUnit unit = WorkUnit::kThreads;
    uint64_t work = 0;  // invocations; of indirect work the number of commands
    uint32_t patches = 0, patchesDrawn = 0;
};

struct FrameDescription {
    uint64_t frame = 0;
    std::vector<ResourceDescription> resources;
    std::vector<PassDescription> passes;
};

std::string_view unitName(WorkUnit unit);
std::string_view outcomeName(PassOutcome outcome);

}  // namespace ag
