#include "game/contact_sheet.h"

namespace ag::game {
namespace {

constexpr int kGap = 4;  // pixels between pictures

}  // namespace

ContactSheet ContactSheet::moments(uint32_t count, uint32_t frames) {
    return {count, 0, frames, 4};
}

ContactSheet ContactSheet::film(uint32_t count, uint32_t first) {
    return {count, first, 0, 6};
}

bool ContactSheet::wants(uint32_t frame) const {
    if (frames_ == 0) return frame >= first_ && frame - first_ < count_;
    return uint64_t(frame + 1) * count_ / frames_ > uint64_t(frame) * count_ / frames_;
}

Image ContactSheet::image() const {
    if (images_.empty()) return Image(1, 1);
    const int width = images_[0].width, height = images_[0].height;
    const int rows = (int(images_.size()) + columns_ - 1) / columns_;
    Image sheet(columns_ * (width + kGap) - kGap, rows * (height + kGap) - kGap);
    for (size_t i = 0; i < images_.size(); ++i) {
        const int left = int(i) % columns_ * (width + kGap), top = int(i) / columns_ * (height + kGap);
        for (int y = 0; y < height; ++y)
            for (int x = 0; x < width; ++x)
                sheet.pixels[size_t(top + y) * size_t(sheet.width) + size_t(left + x)] =
                    images_[i].pixels[size_t(y) * size_t(width) + size_t(x)];
    }
    return sheet;
}

}  // namespace ag::game
