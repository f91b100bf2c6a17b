#include "formats/foam_list.hpp"

#include "basics/numbers.hpp"
#include "formats/bytes.hpp"

#include <algorithm>
#include <cmath>

namespace cli {

namespace {

bool is_blank(char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }
bool is_single(char c) { return c == '(' || c == ')' || c == '{' || c == '}' || c == ';'; }

// Returns the number of bytes that an entry "arch" states after "label=" or "scalar=".
int bytes_of(const std::string& arch, const std::string& kind, int usual) {
    const std::size_t at = arch.find(kind + "=");
    return at == std::string::npos ? usual
                                   : (arch.compare(at + kind.size() + 1, 2, "64") == 0 ? 8 : 4);
}

}  // namespace

bool read_foam_header(const TextFile& file, FoamHeader& header) {
    const std::string_view text = file.text();
    const std::size_t begin = text.find("FoamFile");
    if (begin == std::string::npos || begin > 4096) return false;
    const std::size_t open = text.find('{', begin), close = text.find('}', begin);
    if (open == std::string::npos || close == std::string::npos || close < open) return false;
    header.end = close + 1;
    const std::string_view entries = text.substr(open + 1, close - open - 1);
    const auto value = [&entries](const std::string& key) {
        for (std::size_t at = entries.find(key); at != std::string::npos;
             at = entries.find(key, at + 1)) {
            const bool begins = at == 0 || is_blank(entries[at - 1]) || entries[at - 1] == ';';
            const std::size_t after = at + key.size();
            if (!begins || after >= entries.size() || !is_blank(entries[after])) continue;
            return std::string(trimmed(entries.substr(after, entries.find(';', after) - after)));
        }
        return std::string();
    };
    header.is_binary = value("format") == "binary";
    header.type = value("class");
    const std::size_t arch = entries.find("LSB;");
    const std::string sizes(arch == std::string::npos ? entries : entries.substr(arch));
    header.label_bytes = bytes_of(sizes, "label", 4);
    header.scalar_bytes = bytes_of(sizes, "scalar", 8);
    return true;
}

FoamReader::FoamReader(const TextFile& file) : file_(file) {
    if (!read_foam_header(file, header_))
        file.fail(0, "the file is no file of OpenFOAM, which begins with FoamFile { ... }");
    at_ = header_.end;
}

void FoamReader::skip() {
    const std::string_view text = file_.text();
    for (;;) {
        while (at_ < text.size() && is_blank(text[at_])) ++at_;
        if (text.compare(at_, 2, "//") == 0) {
            at_ = std::min(text.find('\n', at_), text.size());
        } else if (text.compare(at_, 2, "/*") == 0) {
            const std::size_t end = text.find("*/", at_);
            at_ = end == std::string::npos ? text.size() : end + 2;
        } else {
            return;
        }
    }
}

std::string_view FoamReader::word() {
    skip();
    const std::string_view text = file_.text();
    word_ = at_;
    if (at_ < text.size() && is_single(text[at_])) {
        ++at_;
    } else {
        while (at_ < text.size() && !is_blank(text[at_]) && !is_single(text[at_])) ++at_;
    }
    return std::string_view(text).substr(word_, at_ - word_);
}

void FoamReader::expected(std::string_view what) const {
    const std::string_view found = file_.text().substr(word_, at_ - word_);
    fail("the file needs " + std::string(what) + " here, but " +
         (found.empty() ? "the end of the file" : in_quotes(found)) + " follows");
}

std::int64_t FoamReader::count(const char* what) {
    std::int64_t value = 0;
    if (!parse(word(), value) || value < 0 || value > INT32_MAX) expected(what);
    return value;
}

void FoamReader::expect(std::string_view wanted) {
    if (word() != wanted) expected(in_quotes(wanted));
}

bool FoamReader::is_next(std::string_view wanted) {
    const std::size_t here = at_;
    const bool is_found = word() == wanted;
    at_ = here;
    return is_found;
}

const char* FoamReader::binary(std::int64_t n, int bytes, const char* what) {
    expect("(");
    const std::string_view text = file_.text();
    const std::size_t size = static_cast<std::size_t>(n) * static_cast<std::size_t>(bytes),
                      begin = at_;
    const bool is_there =
        begin < text.size() && n <= static_cast<std::int64_t>(text.size() - begin - 1) / bytes;
    if (!is_there || text[begin + size] != ')') {
        file_.fail(begin,
                   "the file needs " + plural(n, what) + " of " + plural(bytes, "byte") +
                       " and a closing bracket here; either the file is cut off, or its header "
                       "states another size of numbers");
    }
    at_ = begin + size + 1;
    return text.data() + begin;
}

std::int64_t FoamReader::label_at(const char* at) const {
    const bool swapped = !little_endian_machine();
    return header_.label_bytes == 8 ? load<std::int64_t>(at, swapped)
                                    : load<std::int32_t>(at, swapped);
}

std::vector<std::int64_t> FoamReader::labels(std::int64_t max_count) {
    const std::int64_t n = count("the number of labels");
    if (n > max_count)
        fail("the list has " + std::to_string(n) + " numbers, but at most " +
             std::to_string(max_count) + " are possible");
    std::vector<std::int64_t> values;
    if (is_next("{")) {
        word();
        values.assign(static_cast<std::size_t>(n), count("a label"));
        expect("}");
        return values;
    }
    if (header_.is_binary) {
        const char* from = n > 0 ? binary(n, header_.label_bytes, "label") : nullptr;
        for (std::int64_t i = 0; i < n; ++i)
            values.push_back(label_at(from + i * header_.label_bytes));
        if (n == 0 && is_next("(")) binary(0, 1, "label");
        return values;
    }
    expect("(");
    for (std::int64_t i = 0; i < n; ++i) values.push_back(count("a label"));
    expect(")");
    return values;
}

void FoamReader::faces(std::vector<std::int64_t>& start, std::vector<std::int64_t>& points,
                       std::vector<std::size_t>& offsets) {
    if (header_.type == "faceCompactList") {
        const auto max_count =
            static_cast<std::int64_t>(std::min<std::size_t>(file_.text().size(), INT32_MAX));
        start = labels(max_count);
        const std::size_t here = word_;
        points = labels(max_count);
        if (start.empty() || start[0] != 0 ||
            start.back() != static_cast<std::int64_t>(points.size()) ||
            !std::is_sorted(start.begin(), start.end())) {
            file_.fail(here,
                       "the list of the first point of each face does not fit the list of points");
        }
        offsets.assign(start.size() - 1, here);
        return;
    }
    if (header_.is_binary)
        fail("a binary file of faces has the class faceCompactList, not " +
             in_quotes(header_.type));
    const std::int64_t n = count("the number of faces");
    start.assign(1, 0);
    expect("(");
    for (std::int64_t i = 0; i < n; ++i) {
        const std::int64_t corners = count("the number of points of a face");
        offsets.push_back(word_);
        expect("(");
        for (std::int64_t k = 0; k < corners; ++k) points.push_back(count("a point of a face"));
        expect(")");
        start.push_back(static_cast<std::int64_t>(points.size()));
    }
    expect(")");
}

void FoamReader::vectors(std::array<std::vector<double>, 3>& x,
                         std::array<std::vector<std::size_t>, 3>& offsets) {
    const std::int64_t n = count("the number of points");
    if (header_.is_binary) {
        const int bytes = header_.scalar_bytes;
        const char* const from = binary(3 * n, bytes, "coordinate");
        const auto begin = static_cast<std::size_t>(from - file_.text().data());
        for (std::int64_t i = 0; i < 3 * n; ++i) {
            const auto d = static_cast<std::size_t>(i % 3);
            const char* const at = from + i * bytes;
            const bool swapped = !little_endian_machine();
            x[d].push_back(bytes == 8 ? load<double>(at, swapped)
                                      : static_cast<double>(load<float>(at, swapped)));
            offsets[d].push_back(begin + static_cast<std::size_t>(i * bytes));
            if (!std::isfinite(x[d].back()))
                file_.fail(offsets[d].back(), "a coordinate is not finite");
        }
        return;
    }
    expect("(");
    for (std::int64_t i = 0; i < n; ++i) {
        expect("(");
        for (std::size_t d = 0; d < 3; ++d) {
            double value = 0;
            if (!parse(word(), value)) expected("a coordinate");
            x[d].push_back(value);
            offsets[d].push_back(word_);
        }
        expect(")");
    }
    expect(")");
}

}  // namespace cli
