#include "formats/fluent_sections.hpp"

#include <algorithm>
#include <charconv>

namespace cli {

void FluentSections::over_blanks() {
    at_ = std::min(text_.find_first_not_of(blanks, at_), text_.size());
}

namespace {

// Returns the place after the bracket that closes the list which begins here, or npos. Brackets in
// quotation marks and characters such as #\( are ignored. In Scheme, a backslash in quotation marks
// takes away the meaning of the next character.
std::size_t closed_list(std::string_view text, std::size_t begin, bool has_escapes) {
    int depth = 0;
    for (std::size_t at = begin; (at = text.find_first_of("()\"", at)) != text.npos; ++at) {
        if (at >= 2 && text[at - 1] == '\\' && text[at - 2] == '#') continue;
        if (text[at] == '"') {
            do {
                at = text.find_first_of(has_escapes ? "\"\\" : "\"", at + 1);
                if (at != text.npos && text[at] == '\\') ++at;
                else break;
            } while (at < text.size());
            if (at >= text.size()) return text.npos;
        } else {
            depth += text[at] == '(' ? 1 : -1;
            if (depth == 0) return at + 1;
        }
    }
    return text.npos;
}

}  // namespace

// Some programs write the paths of Windows without escapes: "C:\" is then a whole text.
std::size_t FluentSections::end_of_list(std::size_t begin) const {
    std::size_t end = closed_list(text_, begin, true);
    if (end == text_.npos) end = closed_list(text_, begin, false);
    if (end == text_.npos)
        file_.fail(begin, "this bracket is not closed before the end of the file");
    return end;
}

// Returns the place after "End of Binary Section NUMBER)". Brackets in binary data are ignored.
std::size_t FluentSections::end_of_binary(std::size_t begin) const {
    const std::size_t mark = text_.find("End of Binary Section", begin);
    const std::size_t end = mark == text_.npos ? mark : text_.find(')', mark);
    if (end == text_.npos)
        file_.fail(begin, "this binary section has no end 'End of Binary Section NUMBER)'");
    return end + 1;
}

// Reads the number of a section. Returns false if the first word is none: the word may also begin
// with a digit.
bool FluentSections::read_number() {
    const char *const from = text_.data() + at_, *const end = text_.data() + text_.size();
    const auto [after, error] = std::from_chars(from, end, section_.number);
    const std::string_view breaks = " \t\v\f\r\n()\"";
    if (error != std::errc() || section_.number < 0 ||
        (after != end && breaks.find(*after) == breaks.npos))
        return false;
    at_ += static_cast<std::size_t>(after - from);
    return true;
}

bool FluentSections::next() {
    for (over_blanks(); at_ < text_.size(); over_blanks()) {
        section_ = {};
        section_.begin = at_;
        if (text_[at_] != '(') {
            file_.fail(at_, "the file needs a section such as (10 ...) here, but " +
                                in_quotes(text_.substr(at_, 16)) + " follows");
        }
        const std::size_t begin = at_++;
        over_blanks();
        if (read_number()) {
            read_section(begin);
            return true;
        }
        at_ = end_of_list(begin);
    }
    return false;
}

// Finds the head and the body of the section that begins here, after its number.
void FluentSections::read_section(std::size_t begin) {
    over_blanks();
    const bool is_binary = section_.number >= first_binary_section;
    const std::size_t end = is_binary ? end_of_binary(begin) : end_of_list(begin);
    section_.head = at_;
    section_.head_end = end - 1;
    if (at_ < text_.size() && text_[at_] == '(') {
        section_.head = at_ + 1;
        at_ = end_of_list(at_);
        section_.head_end = at_ - 1;
        over_blanks();
        if (at_ < text_.size() && text_[at_] == '(') {
            section_.body = at_ + 1;
            section_.body_end =
                is_binary ? std::max(text_.rfind(')', text_.rfind("End of Binary", end)), at_ + 1)
                          : end_of_list(at_) - 1;
        }
    }
    at_ = end;
}

}  // namespace cli
