// Reads the tags of an XML file one after another. Entities and sections CDATA, which mesh files do
// not have, are not known.
#pragma once

#include "basics/text_file.hpp"

#include <string_view>
#include <utility>
#include <vector>

namespace cli {

struct XmlTag {
    std::string_view name;  // the name of an end tag begins with the slash: /Points
    bool is_empty = false;  // <NAME ... /> has no end tag
    std::size_t begin = 0;  // the place of the character < in the file
    std::size_t end = 0;    // the place behind the character >
    std::vector<std::pair<std::string_view, std::string_view>> attributes;

    std::string_view attribute(
        std::string_view key) const;  // in capitals or not; empty if there is none
};

class XmlReader {
public:
    explicit XmlReader(const TextFile& file) : file_(file) {}

    bool next();  // goes to the next tag, over text, comments and declarations; false: the end of
                  // the file
    const XmlTag& tag() const { return tag_; }
    std::size_t text_end()
        const;  // the end of the text behind this tag: the next <, or the end of the file

private:
    void read_attributes(std::size_t at);

    const TextFile& file_;
    XmlTag tag_;
};

}  // namespace cli
