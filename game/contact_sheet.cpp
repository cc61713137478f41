#include "game/contact_sheet.h"

namespace ag::game {
namespace {

constexpr int kColumns = 4, kGap = 4;  // pixels between pictures

}  // namespace

bool ContactSheet::wants(uint32_t frame) const {
    return moments_ > 0 && uint64_t(frame + 1) * moments_ / frames_ > uint64_t(frame) * moments_ / frames_;
}

Image ContactSheet::image() const {
    if (images_.empty()) return Image(1, 1);
    const int width = images_[0].width, height = images_[0].height;
    const int rows = (int(images_.size()) + kColumns - 1) / kColumns;
    Image sheet(kColumns * (width + kGap) - kGap, rows * (height + kGap) - kGap);
    for (size_t i = 0; i < images_.size(); ++i) {
        const int left = int(i) % kColumns * (width + kGap), top = int(i) / kColumns * (height + kGap);
        for (int y = 0; y < height; ++y)
            for (int x = 0; x < width; ++x)
                sheet.pixels[size_t(top + y) * size_t(sheet.width) + size_t(left + x)] =
                    images_[i].pixels[size_t(y) * size_t(width) + size_t(x)];
    }
    return sheet;
}

}  // namespace ag::game
