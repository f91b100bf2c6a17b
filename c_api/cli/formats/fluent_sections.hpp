// Finds the sections (NUMBER (HEAD) (BODY)) or (NUMBER HEAD) of a Fluent mesh file, one after
// another. Sections whose first word is no number, such as (cad/adv-options ...), are settings in
// the language Scheme, and are passed over.
#pragma once

#include "files/text_file.hpp"

#include <cstdint>

namespace cli {

// Sections of this number and above have binary bodies: 2010 and 3010 nodes in single and double
// precision, and so on.
constexpr std::int64_t first_binary_section = 2000, first_double_section = 3000;

struct FluentSection {
    std::int64_t number = 0;
    std::size_t begin = 0;  // all members are places in the file; here: the first bracket
    std::size_t head = 0, head_end = 0;  // without the brackets
    std::size_t body = 0, body_end = 0;  // without the brackets; 0: there is none
};

class FluentSections {
public:
    explicit FluentSections(const TextFile& file) : file_(file), text_(file.text()) {}

    bool next();  // goes to the next section with a number; false: the end of the file
    const FluentSection& section() const { return section_; }

private:
    void over_blanks();
    bool read_number();
    void read_section(std::size_t begin);
    std::size_t end_of_list(std::size_t begin) const;
    std::size_t end_of_binary(std::size_t begin) const;

    const TextFile& file_;
    std::string_view text_;
    std::size_t at_ = 0;  // the place after the section
    FluentSection section_;
};

}  // namespace cli
