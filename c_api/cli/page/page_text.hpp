// The pages of the program, as page/embed.sh makes them of the files in page/: what all pages begin
// with, and the text before and after the data of each.
#pragma once

namespace cli {

struct PageText {
    const char *before_data, *after_data;
};

extern const char page_head[];       // page/head.html
extern const PageText explore_page;  // page/explore.html
extern const PageText report_page;   // page/report.html

}  // namespace cli
