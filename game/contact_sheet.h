// Pictures of a run side by side in one: moments evenly spaced, or frames in a row.
#pragma once

#include <cstdint>
#include <vector>

#include "engine/core/image.h"

namespace ag::game {

class ContactSheet {
  public:
    ContactSheet() = default;  // of nothing
    // So many of a run of `frames`, four a row.
    static ContactSheet moments(uint32_t count, uint32_t frames);
    // So many frames one after the other, from frame `first` on, six a row.
    static ContactSheet film(uint32_t count, uint32_t first);

    bool wants(uint32_t frame) const;  // after this frame
    void add(Image image) { images_.push_back(std::move(image)); }
    Image image() const;
    const std::vector<Image>& pictures() const { return images_; }

  private:
    ContactSheet(uint32_t count, uint32_t first, uint32_t frames, int columns)
        : count_(count), first_(first), frames_(frames), columns_(columns) {}

    uint32_t count_ = 0, first_ = 0;
    uint32_t frames_ = 0;  // of the run that moments are spread over; 0: a film
    int columns_ = 1;
    std::vector<Image> images_;
};

}  // namespace ag::game
