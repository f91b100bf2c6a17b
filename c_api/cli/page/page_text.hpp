// The pages of the program, which page/embed.sh makes of the files in page/: the beginning of all
// pages, and the text before and after the data of each page.
#pragma once

namespace cli {

struct PageText {
    const char *before_data, *after_data;
};

extern const char page_head[];       // page/head.html
extern const char page_module[];     // the library for WebAssembly, gzip in base 64; empty: none
extern const char no_page_module[];  // what was missing; empty: nothing
extern const PageText explore_page;  // page/explore.html
extern const PageText report_page;   // page/report.html
extern const PageText sample_page;   // page/sample.html, which begins without page_head

}  // namespace cli
