// Reads the tags of an XML file one after another. Values of attributes are the text of the file:
// names in them are read by xml_decoded(). Sections CDATA are not supported; mesh files do not have
// them.
#pragma once

#include "files/text_file.hpp"

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace cli {

struct XmlTag {
    std::string_view name;  // the name of an end tag begins with the slash: /Points
    bool is_empty = false;  // <NAME ... /> has no end tag
    std::size_t begin = 0;  // the place of the character < in the file
    std::size_t end = 0;    // the place after the character >
    std::vector<std::pair<std::string_view, std::string_view>> attributes;

    // Ignores the case of the key. Returns an empty text if there is no such attribute.
    std::string_view attribute(std::string_view key) const;
};

class XmlReader {
public:
    explicit XmlReader(const TextFile& file) : file_(file) {}

    // Goes to the next tag; skips text, comments and declarations. Returns false at the end of the
    // file.
    bool next();
    const XmlTag& tag() const { return tag_; }
    // Returns the end of the text after this tag: the next <, or the end of the file.
    std::size_t text_end() const;

private:
    void read_attributes(std::size_t at);

    const TextFile& file_;
    XmlTag tag_;
};

// Replaces the entities &lt; &gt; &amp; &quot; &apos; &#N; and &#xN; by their characters, in UTF-8.
// Other text, such as an & alone, stays.
std::string xml_decoded(std::string_view value);
// Returns the text as the value of an attribute in quotation marks, which xml_decoded() turns back.
// XML cannot have control characters but tab and line ends; each of them becomes _.
std::string xml_encoded(std::string_view text);

}  // namespace cli
