// A few moments of a run, evenly spaced, side by side in one picture.
#pragma once

#include <cstdint>
#include <vector>

#include "engine/core/image.h"

namespace ag::game {

class ContactSheet {
  public:
    ContactSheet() = default;
    ContactSheet(uint32_t moments, uint32_t frames) : moments_(moments), frames_(frames) {}

    bool wants(uint32_t frame) const;  // after this frame
    void add(Image image) { images_.push_back(std::move(image)); }
    Image image() const;
    const std::vector<Image>& pictures() const { return images_; }  // four a row

  private:
    uint32_t moments_ = 0, frames_ = 1;
    std::vector<Image> images_;
};

}  // namespace ag::game
