#include "su2.hpp"

#include "numbers.hpp"

#include <algorithm>
#include <cstring>
#include <ostream>

namespace cli {

namespace {

bool same_bits(double a, double b) { return std::memcmp(&a, &b, sizeof a) == 0; }

// Copies a text from left to right, with some of its words replaced.
class WordReplacer {
public:
    WordReplacer(std::ostream& out, const std::string& text) : out_(out), text_(text) {}

    void replace(std::size_t begin, std::size_t end, const std::string& word) {
        copy_until(begin);
        out_ << word;
        copied_ = end;
    }
    void finish() { copy_until(text_.size()); }

private:
    void copy_until(std::size_t end) {
        out_.write(text_.data() + copied_, static_cast<std::streamsize>(end - copied_));
        copied_ = end;
    }

    std::ostream& out_;
    const std::string& text_;
    std::size_t copied_ = 0;
};

} // namespace

void write_su2(std::ostream& out, const Mesh& mesh, const double* x, const double* y) {
    const std::string& text = mesh.file.text();
    const auto end_of_word = [&text](std::size_t begin) {
        return std::min(text.find_first_of(" \t\v\f\r\n%", begin), text.size());
    };
    WordReplacer replacer(out, text);
    for (std::size_t point = 0; point < mesh.x.size(); ++point) {
        const std::size_t x_begin = mesh.point_offset[point];
        const std::size_t x_end = end_of_word(x_begin);
        const std::size_t y_begin = text.find_first_not_of(" \t\v\f", x_end);
        if (!same_bits(x[point], mesh.x[point])) replacer.replace(x_begin, x_end, exact(x[point]));
        if (!same_bits(y[point], mesh.y[point])) replacer.replace(y_begin, end_of_word(y_begin), exact(y[point]));
    }
    replacer.finish();
}

} // namespace cli
