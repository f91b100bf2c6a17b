#include "formats/fluent_sections.hpp"

#include <algorithm>
#include <charconv>

namespace cli {

void FluentSections::over_blanks() {
    at_ = std::min(text_.find_first_not_of(blanks, at_), text_.size());
}

// Returns the place after the bracket that closes the list which begins here. Brackets in quotation
// marks are ignored.
std::size_t FluentSections::end_of_list(std::size_t begin) const {
    int depth = 0;
    for (std::size_t at = begin; (at = text_.find_first_of("()\"", at)) != text_.npos; ++at) {
        if (text_[at] == '"') {
            at = text_.find('"', at + 1);
            if (at == text_.npos) break;
        } else {
            depth += text_[at] == '(' ? 1 : -1;
            if (depth == 0) return at + 1;
        }
    }
    file_.fail(begin, "this bracket is not closed before the end of the file");
}

// Returns the place after "End of Binary Section NUMBER)". Brackets in binary data are ignored.
std::size_t FluentSections::end_of_binary(std::size_t begin) const {
    const std::size_t mark = text_.find("End of Binary Section", begin);
    const std::size_t end = mark == text_.npos ? mark : text_.find(')', mark);
    if (end == text_.npos)
        file_.fail(begin, "this binary section has no end 'End of Binary Section NUMBER)'");
    return end + 1;
}

bool FluentSections::next() {
    over_blanks();
    if (at_ == text_.size()) return false;
    section_ = {};
    section_.begin = at_;
    if (text_[at_] != '(') {
        file_.fail(at_, "the file needs a section such as (10 ...) here, but " +
                            in_quotes(text_.substr(at_, 16)) + " follows");
    }
    const std::size_t begin = at_++;
    over_blanks();
    const char* const from = text_.data() + at_;
    const auto [after, error] = std::from_chars(from, text_.data() + text_.size(), section_.number);
    if (error != std::errc()) file_.fail(at_, "the file needs the number of a section here");
    at_ += static_cast<std::size_t>(after - from);
    over_blanks();
    const bool is_binary = section_.number >= first_binary_section;
    const std::size_t end = is_binary ? end_of_binary(begin) : end_of_list(begin);
    section_.head = at_;
    section_.head_end = end - 1;
    if (text_[at_] == '(') {
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
    return true;
}

}  // namespace cli
