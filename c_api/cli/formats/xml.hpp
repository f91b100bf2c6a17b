// The tags of an XML file, one after another, as far as mesh files need them: no entities, no
// sections CDATA.
#pragma once

#include "basics/text_file.hpp"

#include <string_view>
#include <utility>
#include <vector>

namespace cli {

struct XmlTag {
    std::string_view name;  // of an end tag with the slash before it: /Points
    bool is_empty = false;  // <NAME ... />: has no end tag
    std::size_t begin = 0;  // in the file, of the character <
    std::size_t end = 0;    // behind the character >
    std::vector<std::pair<std::string_view, std::string_view>> attributes;

    std::string_view attribute(std::string_view key) const;  // in capitals or not; empty: not there
};

class XmlReader {
public:
    explicit XmlReader(const TextFile& file) : file_(file) {}

    bool next();  // to the tag after this one, over text, comments and declarations; false: the end
                  // of the file
    const XmlTag& tag() const { return tag_; }
    std::size_t text_end()
        const;  // where the text behind this tag ends: at the next <, or the end of the file

private:
    void read_attributes(std::size_t at);

    const TextFile& file_;
    XmlTag tag_;
};

}  // namespace cli
