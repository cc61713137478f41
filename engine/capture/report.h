// report.html: timeline, table, pictures and graphs in one file that any browser opens without a network.
#pragma once

#include "engine/capture/pass_table.h"

namespace ag::capture {

struct ReportPicture {
    std::string name, pass;
    std::string png;  // the file's bytes
};

std::string reportHtml(const Capture& capture, const std::vector<PassRow>& table,
                       const std::vector<ReportPicture>& pictures);

}  // namespace ag::capture
