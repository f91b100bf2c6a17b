// The page of `harmorph explore`, as page/embed.sh makes it of the files in page/: the text before and after its data.
#pragma once

namespace cli {

extern const char* const page_before_data;
extern const char* const page_after_data;

} // namespace cli
