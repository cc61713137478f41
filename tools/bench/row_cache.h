// Rows of a benchmark on disk, so that one that was interrupted goes on where it was. A row is known by all
// that could change it: the program and its shaders, the device, the scene, technique, settings and how it is
// measured.
#pragma once

#include <optional>

#include "tools/bench/report.h"

namespace ag::bench {

class RowCache {
  public:
    // Empty folder: nothing is kept.
    explicit RowCache(std::string folder);

    std::optional<std::vector<Row>> find(uint64_t key) const;
    void keep(uint64_t key, const std::vector<Row>& rows) const;  // a warning where it cannot be written
    // Of this program's file and of every shader it was built with.
    static uint64_t programHash();

  private:
    std::string pathOf(uint64_t key) const;
    std::string folder_;
};

}  // namespace ag::bench
