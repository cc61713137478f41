// RenderDoc from inside the program: frames as .rdc files for its own tools. Its library is either in this
// process already (started by renderdoccmd or its window), or is asked for before the device is made.
#pragma once

#include <string>

#include "engine/core/result.h"

struct RENDERDOC_API_1_6_0;

namespace ag::gpu {

class RenderDoc {
  public:
    // What is in this process already; `load`: else loads it and switches its layer on for Vulkan instances
    // made from now on, or fails with a sentence where it is not installed.
    static Result<RenderDoc> open(bool load);

    explicit operator bool() const { return api_ != nullptr; }  // false: not there, and not asked for
    // What is submitted in between is captured into `path`, which ends in ".rdc". Its work must have finished
    // when end() is called.
    void begin();
    Status end(const std::string& path);

  private:
    RENDERDOC_API_1_6_0* api_ = nullptr;
};

}  // namespace ag::gpu
