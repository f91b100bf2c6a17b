// The pages of the program, which embed.sh makes of the files in page/: the beginning of all
// pages, and the text before and after the data of each page.
#pragma once

namespace cli {

struct PageText {
    const char *before_data, *after_data;
};

extern const char page_head[];       // page/head.html
extern const PageText explore_page;  // page/explore.html
extern const PageText report_page;   // page/report.html

}  // namespace cli
