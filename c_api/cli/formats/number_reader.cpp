#include "formats/number_reader.hpp"

#include "basics/numbers.hpp"
#include "formats/bytes.hpp"

#include <cmath>

namespace cli {

namespace {

bool separates(char c) { return c == ' ' || (c >= '\t' && c <= '\r') || c == ','; }

}  // namespace

// Commas separate numbers in the output of many Fortran and C programs.
std::string_view NumberReader::word() {
    const std::string_view text = file_.text();
    file_.passed(at_);
    while (at_ < end_ && separates(text[at_])) ++at_;
    number_ = at_;
    while (at_ < end_ && !separates(text[at_])) ++at_;
    word_ = std::string_view(text).substr(number_, at_ - number_);
    return word_;
}

std::string_view NumberReader::next_line() {
    const std::string_view text = file_.text().substr(0, end_);
    while (at_ < text.size()) {
        const std::size_t end = std::min(text.find_first_of("\r\n", at_), text.size());
        const std::string_view line = trimmed(text.substr(at_, end - at_));
        number_ = at_;
        at_ = std::min(end + 1, text.size());
        if (!line.empty()) return word_ = line;
    }
    number_ = at_;
    return word_ = text.substr(text.size());
}

const char* NumberReader::found_end() const {
    return end_ == file_.text().size() ? "the end of the file" : "the end of the numbers";
}

const char* NumberReader::take(std::size_t bytes, const char* what) {
    if (at_ > end_ || bytes > end_ - at_)
        file_.fail(
            end_, std::string("the file needs ") + what + " here, but " + found_end() + " follows");
    file_.passed(at_);
    number_ = at_;
    at_ += bytes;
    return file_.text().data() + number_;
}

void NumberReader::skip_bytes(std::size_t n, const char* what) { take(n, what); }

bool NumberReader::at_end() {
    if (!is_binary) {
        const std::size_t here = at_;
        const bool end = word().empty();
        at_ = here;
        return end;
    }
    return at_ >= end_;
}

std::int64_t NumberReader::whole(const char* what, int bytes) {
    if (is_binary) {
        const char* const from = take(static_cast<std::size_t>(bytes), what);
        if (bytes == 8) return load<std::int64_t>(from, swapped);
        return bytes == 4 ? load<std::int32_t>(from, swapped) : load<std::int8_t>(from, swapped);
    }
    std::int64_t value = 0;
    if (!parse(word(), value)) expected(what);
    return value;
}

std::int64_t NumberReader::count(const char* what, int bytes) {
    const std::int64_t value = whole(what, bytes);
    if (value < 0 || value > INT32_MAX) {
        fail(std::string("the file needs ") + what + " between 0 and 2147483647 here, but " +
             std::to_string(value) + " follows");
    }
    return value;
}

double NumberReader::real(const char* what, int bytes) {
    double value = 0;
    if (is_binary) {
        const char* const from = take(static_cast<std::size_t>(bytes), what);
        value = bytes == 8 ? load<double>(from, swapped)
                           : static_cast<double>(load<float>(from, swapped));
        if (!std::isfinite(value))
            fail(std::string("the file needs ") + what +
                 " here, but a number that is not finite follows");
    } else if (!parse(word(), value)) {
        expected(what);
    }
    return value;
}

void NumberReader::expected(std::string_view what) const {
    file_.fail(number_, "the file needs " + std::string(what) + " here, but " +
                            (word_.empty() ? found_end() : in_quotes(word_)) + " follows");
}

bool PlainRow::real(double& value) {
    const std::size_t n = parse_front({at_, static_cast<std::size_t>(end_ - at_)}, value);
    at_ += n;
    if (n == 0 || !ends_word()) return false;
    over_blanks();
    return true;
}

}  // namespace cli
