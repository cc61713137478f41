// An intermediate as something to look at: colours as they are, directions as colours, anything else in false
// colour with its legend.
#pragma once

#include "engine/capture/capture.h"

namespace ag::capture {

enum class Shown { kDisplay, kRadiance, kLight, kReflectance, kDirection, kMotion, kDistance, kScalar };

Shown howShown(const Picture& picture);
// Values in [0, 1] for a PNG. Small pictures are enlarged by a whole factor; false colour gets a strip below
// with the least and the greatest value shown (the 1st and 99th percentile, in m for depths of the camera).
Image displayOf(const Picture& picture, const Look& look);
// No larger than `most` along a side, by leaving pixels out: for the report.
Image shrunk(const Image& image, int most);

struct Statistics {
    double least = 0, mean = 0, greatest = 0;
    uint64_t hash = 0;       // of all bits: equal inputs make equal pictures
    uint64_t notFinite = 0;  // values
};
Statistics statisticsOf(const Image& image);

// pictures.csv: image,pass,format,width,height,least,mean,greatest,not_finite,hash
std::string picturesCsv(const std::vector<Picture>& pictures);

}  // namespace ag::capture
