#include "curves/section_checks.hpp"

#include "basics/numbers.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <map>
#include <numeric>

namespace cli {

namespace {

struct SectionRow {
    std::string_view line;  // trimmed, without a comment
    std::size_t offset = 0;
    bool is_comment = false;         // the line has only a comment
    std::vector<std::string> words;  // with decimal points
    std::vector<double> numbers;     // empty if a word is no number
    bool is_blank() const { return line.empty() && !is_comment; }
};

bool has_byte(std::string_view text, char wanted) { return text.find(wanted) != text.npos; }

std::vector<std::string> words_between(std::string_view text, std::string_view separators) {
    std::vector<std::string> words;
    bool quoted = false;
    std::string word;
    const auto finish = [&] {
        if (!word.empty()) words.push_back(word);
        word.clear();
    };
    for (const char c : text) {
        if (c == '"') quoted = !quoted;
        if (c == '"' || (!quoted && separators.find(c) != separators.npos)) finish();
        else word += c;
    }
    finish();
    return words;
}

// "1,25" among several words without points is 1.25; "1.25, 0.5" and "1.25,0.5" are two numbers.
bool has_decimal_commas(std::string_view line, const std::vector<std::string>& between_blanks) {
    if (!has_byte(line, ',')) return false;
    if (has_byte(line, ';')) return true;
    if (has_byte(line, '.') || between_blanks.size() < 2) return false;
    for (const std::string& word : between_blanks) {
        const auto comma = word.find(',');
        if (comma == word.npos) continue;
        const bool inside = comma > 0 && comma + 1 < word.size() &&
                            std::isdigit(static_cast<unsigned char>(word[comma - 1])) &&
                            std::isdigit(static_cast<unsigned char>(word[comma + 1]));
        if (!inside || word.find(',', comma + 1) != word.npos) return false;
    }
    return true;
}

void read_words(SectionRow& row) {
    row.words = words_between(row.line, " \t\v\f");
    if (has_decimal_commas(row.line, row.words)) {
        row.words = words_between(row.line, " \t\v\f;");
        for (std::string& word : row.words) std::replace(word.begin(), word.end(), ',', '.');
    } else {
        row.words = words_between(row.line, " \t\v\f;,");
    }
    for (const std::string& word : row.words) {
        double value = 0;
        std::string_view digits = word;
        if (digits.size() > 1 && digits[0] == '+') digits.remove_prefix(1);
        if (!parse(digits, value)) {
            row.numbers.clear();
            return;
        }
        row.numbers.push_back(value);
    }
}

// At most `most` lines; 0: all.
std::vector<SectionRow> rows_of(const TextFile& file, std::size_t most) {
    const std::string_view text = file.text();
    std::vector<SectionRow> rows;
    std::size_t at = text.substr(0, 3) == "\xEF\xBB\xBF" ? 3 : 0;
    while (at < text.size() && (most == 0 || rows.size() < most)) {
        const std::size_t end = std::min(text.find_first_of("\r\n", at), text.size());
        SectionRow row;
        row.offset = at;
        const std::string_view whole = trimmed(text.substr(at, end - at));
        const std::size_t comment = std::min(whole.find_first_of("#!"), whole.size());
        row.line = trimmed(whole.substr(0, comment));
        row.is_comment = row.line.empty() && comment < whole.size();
        read_words(row);
        rows.push_back(std::move(row));
        const bool two = end + 1 < text.size() && text[end] == '\r' && text[end + 1] == '\n';
        at = end + (two ? 2 : 1);
    }
    return rows;
}

// The number of columns that most lines of numbers have, or 0.
std::size_t columns_of(const std::vector<SectionRow>& rows) {
    std::map<std::size_t, std::size_t> lines;
    for (const SectionRow& row : rows)
        if (row.numbers.size() >= 2) ++lines[row.numbers.size()];
    std::size_t columns = 0;
    for (const auto& [count, found] : lines)
        if (columns == 0 || found > lines[columns]) columns = count;
    return columns;
}

std::string in_lower_case(std::string text) {
    for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    return text;
}

bool is_whole_number(double value) { return std::floor(value) == value; }

// Tells whether a header names a column of the coordinate `axis`, x or y.
bool names_axis(const std::string& heading, char axis) {
    const std::string name = in_lower_case(heading);
    const std::string other = axis == 'x' ? "0" : "1", one(1, axis);
    for (const std::string& known :
         {one, one + "/c", one + "c", one + "_c", one + "[m]", one + "_coord", one + "coord",
          one + "_coordinate", "coordinate" + one, "points:" + other, "points_" + other})
        if (name == known) return true;
    return false;
}

// A damaged line of points, not a note: as many words, of which one at least is a number.
bool is_damaged(const SectionRow& row, std::size_t columns, bool is_last) {
    const auto is_number = [](const std::string& word) {
        double value = 0;
        return parse(word, value);
    };
    if (row.words.size() != columns) return false;
    if (std::none_of(row.words.begin(), row.words.end(), is_number)) return false;
    return !is_last || row.words[0].size() < 3 || is_number(row.words[0]);
}

class SectionTableReader {
public:
    explicit SectionTableReader(const TextFile& file)
        : file_(file), rows_(rows_of(file, 0)), columns_(columns_of(rows_)) {}

    SectionTable read() {
        find_points();
        choose_columns();
        for (std::size_t k = 0; k < first_; ++k) read_head(rows_[k]);
        for (std::size_t k = first_; k < rows_.size(); ++k) read_row(rows_[k], k > last_);
        describe();
        return std::move(table_);
    }

private:
    void find_points() {
        const auto is_point = [&](const SectionRow& row) { return row.numbers.size() == columns_; };
        std::size_t points = 0;
        for (std::size_t k = 0; columns_ > 0 && k < rows_.size(); ++k) {
            if (!is_point(rows_[k])) continue;
            if (points++ == 0) first_ = k;
            last_ = k;
        }
        if (points > 0) return;
        const SectionRow* wrong = nullptr;
        for (const SectionRow& row : rows_)
            if (!row.line.empty()) wrong = &row;
        file_.fail(wrong ? wrong->offset : 0,
                   "the file needs x and y of a point here, but " +
                       (wrong ? in_quotes(wrong->line) : "the end of the file") + " follows");
    }

    bool is_constant(std::size_t column) const {
        for (std::size_t k = first_; k <= last_; ++k) {
            const SectionRow& row = rows_[k];
            if (row.numbers.size() != columns_) continue;
            if (row.numbers[column] != rows_[first_].numbers[column]) return false;
        }
        return true;
    }

    bool is_numbering() const {
        double expected = rows_[first_].numbers[0];
        if (!is_whole_number(expected)) return false;
        for (std::size_t k = first_; k <= last_; ++k) {
            const SectionRow& row = rows_[k];
            if (row.numbers.size() == columns_ && row.numbers[0] != expected++) return false;
        }
        return true;
    }

    bool take_header() {
        for (std::size_t k = 0; k < first_; ++k) {
            std::string_view line = rows_[k].line;
            const std::size_t equals = line.find('=');
            if (equals != line.npos) line.remove_prefix(equals + 1);
            const std::vector<std::string> names = words_between(line, " \t,;");
            if (names.size() != columns_) continue;
            const auto find = [&](char axis) {
                return static_cast<std::size_t>(
                    std::find_if(names.begin(), names.end(),
                                 [&](const std::string& name) { return names_axis(name, axis); }) -
                    names.begin());
            };
            const std::size_t x = find('x'), y = find('y');
            if (x == names.size() || y == names.size()) continue;
            x_ = x;
            y_ = y;
            return true;
        }
        return false;
    }

    void choose_columns() {
        has_header_ = take_header();
        if (columns_ == 2 || has_header_) return;
        std::vector<std::size_t> kept;
        is_numbered_ = is_numbering();
        for (std::size_t column = is_numbered_ ? 1 : 0; column < columns_; ++column)
            kept.push_back(column);
        for (std::size_t k = kept.size(); k-- > 0 && kept.size() > 2;) {
            if (!is_constant(kept[k])) continue;
            kept.erase(kept.begin() + static_cast<std::ptrdiff_t>(k));
            has_constant_ = true;
        }
        if (kept.size() != 2) {
            file_.fail(rows_[first_].offset,
                       "the points have " + plural(std::int64_t(columns_), "column") +
                           ", and neither a header with x and y nor a constant column says which "
                           "of these are x and y");
        }
        x_ = kept[0];
        y_ = kept[1];
    }

    void read_head(const SectionRow& row) {
        const std::string line = in_lower_case(std::string(row.line));
        for (const char* word : {"title", "variables", "zone"})
            is_tecplot_ = is_tecplot_ || line.substr(0, line.find_first_of(" \t=")) == word;
        table_.is_openfast = table_.is_openfast || line.find("numcoords") != line.npos;
        const bool whole = std::all_of(row.numbers.begin(), row.numbers.end(), is_whole_number);
        if (row.numbers.size() == 1 || (row.numbers.size() == 2 && whole))
            table_.counts = row.numbers;
        is_mses_ = is_mses_ || row.numbers.size() == 4;
    }

    void read_row(const SectionRow& row, bool is_last) {
        if (row.line.empty()) {
            is_open_ = false;
            return;
        }
        if (row.numbers.size() == columns_) return add(row);
        const bool is_separator = row.numbers.size() == 2 && is_999(row.numbers[0], row.numbers[1]);
        if (is_separator) return separate();
        const bool is_count = row.numbers.size() == 1 && is_whole_number(row.numbers[0]);
        if (!is_count && (!row.numbers.empty() || is_damaged(row, columns_, is_last)))
            file_.fail(row.offset, "the file needs " + plural(std::int64_t(columns_), "number") +
                                       " of a point here, but " + in_quotes(row.line) + " follows");
        is_open_ = false;
        const std::string line = in_lower_case(std::string(row.line));
        if (line.substr(0, 4) == "zone") is_tecplot_ = true;
        else if (!is_count) has_notes_ = true;
    }

    static bool is_999(double x, double y) { return x == y && x >= 999 && x < 1000; }

    void separate() {
        ++element_;
        is_open_ = false;
    }

    void add(const SectionRow& row) {
        const double x = row.numbers[x_], y = row.numbers[y_];
        if (is_999(x, y)) return separate();
        if (!is_open_) {
            table_.blocks.emplace_back();
            table_.blocks.back().element = element_;
        }
        is_open_ = true;
        table_.blocks.back().points.push_back({x, y, row.offset});
    }

    void describe() {
        const auto add = [&](bool is, const char* what) {
            if (is) table_.properties.push_back(what);
        };
        const std::string_view line = rows_[first_].line;
        add(is_tecplot_, "Tecplot headers");
        add(table_.is_openfast, "OpenFAST");
        add(is_mses_, "MSES with a line of the domain");
        add(element_ > 0, "elements separated by 999");
        add(has_byte(line, ';'), "semicolons");
        add(has_byte(line, ',') && !has_byte(line, ';') && has_byte(line, '.'), "commas");
        add(has_byte(line, ',') && !has_byte(line, '.'), "decimal commas");
        add(has_header_ && !is_tecplot_, "named columns");
        add(is_numbered_, "numbered points");
        add(has_constant_, "a constant column");
        add(table_.counts.size() == 1, "a line of one number");
        add(has_notes_, "notes among the points");
    }

    const TextFile& file_;
    std::vector<SectionRow> rows_;
    std::size_t columns_, first_ = 0, last_ = 0, x_ = 0, y_ = 1;
    bool has_header_ = false, is_numbered_ = false, has_constant_ = false, is_tecplot_ = false,
         is_mses_ = false, has_notes_ = false, is_open_ = false;
    int element_ = 0;
    SectionTable table_;
};

}  // namespace

SectionTable read_section_table(const TextFile& file) { return SectionTableReader(file).read(); }

bool looks_like_section(const TextFile& file) {
    constexpr std::size_t looked_at = 200;
    std::size_t numbers = 0, others = 0;
    for (const SectionRow& row : rows_of(file, looked_at)) {
        if (has_byte(row.line, '\0')) return false;
        if (row.numbers.size() >= 2 && row.numbers.size() <= 5) ++numbers;
        else if (!row.line.empty()) ++others;
    }
    return numbers >= 3 && numbers > others;
}

namespace {

constexpr double much_longer = 10;          // than the segments beside a jump
constexpr double cosine_of_return = -.866;  // a stray point turns the outline by 150 degrees
constexpr double rounded_crossing = 2e-4;   // [chord] the width of a loop that rounding makes
constexpr double least_area = 1e-6;         // [chord^2]
constexpr double long_way = .25;            // [chord] a way back that counts for the leading edges
constexpr std::size_t least_points = 8;     // with fewer points no point is called stray

struct SectionStep {
    double x, y;
};
SectionStep from_to(const SectionPoint& a, const SectionPoint& b) { return {b.x - a.x, b.y - a.y}; }
double dot_of(SectionStep a, SectionStep b) { return a.x * b.x + a.y * b.y; }
double cross_of(SectionStep a, SectionStep b) { return a.x * b.y - a.y * b.x; }
double length_of_step(SectionStep a) { return std::sqrt(dot_of(a, a)); }
double step_length(const SectionPoint& a, const SectionPoint& b) {
    return length_of_step(from_to(a, b));
}

const SectionPoint& farthest_point(const SectionOutline& outline, const SectionPoint& from) {
    const SectionPoint* found = &outline[0];
    for (const SectionPoint& point : outline)
        if (step_length(point, from) > step_length(*found, from)) found = &point;
    return *found;
}

struct SectionLoop {
    const SectionOutline& points;
    std::size_t n = points.size();
    const SectionPoint& at(std::size_t k) const { return points[k % n]; }
    double step(std::size_t k) const { return step_length(at(k), at(k + 1)); }  // from k to k + 1
};

class SectionChecker {
public:
    SectionChecker(const TextFile& file, const SectionOutline& outline)
        : file_(file), loop_{outline}, extent_(extent_of(outline)) {}

    SectionFindings run() {
        const std::size_t stray = stray_point(loop_.points);
        if (stray < loop_.n) refuse_stray(stray);
        else check_steps();
        if (found_.refusal.empty()) check_crossings();
        if (found_.refusal.empty()) check_area();
        if (found_.refusal.empty()) count_leading_edges();
        return std::move(found_);
    }

private:
    std::string place(std::size_t k) const {
        const SectionPoint& point = loop_.at(k);
        const std::string line = file_.place(point.offset);
        return "(" + brief(point.x) + ", " + brief(point.y) + ") in line " +
               line.substr(line.rfind(':') + 1);
    }
    std::string segment(std::size_t k) const { return place(k) + " to " + place(k + 1); }

    void refuse(std::size_t at, const std::string& why) {
        found_.refusal = why;
        found_.at = at % loop_.n;
    }

    void refuse_stray(std::size_t k) {
        const bool at_end = k == 0 || k + 1 == loop_.n;
        refuse(k, "the outline jumps: " + place(k) + " is far from its neighbours " +
                      place(k + loop_.n - 1) + " and " + place(k + 1) +
                      (at_end ? "; remove the line if the point is no point of the outline"
                              : "; correct the point"));
    }

    void check_steps() {
        const SectionPoint& end = farthest_point(loop_.points, loop_.at(0));
        const SectionStep chord = from_to(end, farthest_point(loop_.points, end));
        for (std::size_t k = 0; k < loop_.n; ++k) {
            const double step = loop_.step(k);
            if (!(step > .5 * extent_)) continue;
            const bool jumps = step > much_longer * loop_.step(k + loop_.n - 1) &&
                               step > much_longer * loop_.step(k + 1);
            const bool is_base =
                k + 1 == loop_.n &&
                std::fabs(dot_of(from_to(loop_.at(k), loop_.at(0)), chord)) < .5 * step * extent_;
            if (jumps && !is_base) {
                return refuse(k + 1, "the outline jumps from " + segment(k) + ", by " +
                                         brief(step / extent_) +
                                         " chords; a side may be missing, or its points may be "
                                         "in another order");
            }
            found_.warnings.push_back("the outline has a straight segment of " +
                                      brief(step / extent_) + " chords from " + segment(k));
        }
    }

    bool cross_each_other(std::size_t i, std::size_t j) const {
        const SectionPoint &a = loop_.at(i), &b = loop_.at(i + 1), &c = loop_.at(j),
                           &d = loop_.at(j + 1);
        const SectionStep first = from_to(a, b), second = from_to(c, d);
        return cross_of(first, from_to(a, c)) * cross_of(first, from_to(a, d)) < 0 &&
               cross_of(second, from_to(c, a)) * cross_of(second, from_to(c, b)) < 0;
    }

    // The mean width of the narrower of the two loops that the crossing of segments i < j makes.
    double width_of_loop(std::size_t i, std::size_t j) const {
        const auto width = [&](std::size_t from, std::size_t to) {
            SectionOutline part;
            for (std::size_t k = from; k <= to; ++k) part.push_back(loop_.at(k));
            double around = 0;
            const SectionLoop own{part};
            for (std::size_t k = 0; k < own.n; ++k) around += own.step(k);
            return around > 0 ? 2 * std::fabs(area_of(part)) / around : 0;
        };
        return std::min(width(i + 1, j), width(j + 1, i + loop_.n));
    }

    // Segments in the order of their least x are compared with those that begin before their end.
    void check_crossings() {
        const auto low = [&](std::size_t k) { return std::min(loop_.at(k).x, loop_.at(k + 1).x); };
        const auto high = [&](std::size_t k) { return std::max(loop_.at(k).x, loop_.at(k + 1).x); };
        std::vector<std::size_t> order(loop_.n);
        std::iota(order.begin(), order.end(), std::size_t{0});
        std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
            return low(a) != low(b) ? low(a) < low(b) : a < b;
        });
        bool has_warned = false;
        for (std::size_t a = 0; a < loop_.n; ++a) {
            for (std::size_t b = a + 1; b < loop_.n && low(order[b]) <= high(order[a]); ++b) {
                const std::size_t i = std::min(order[a], order[b]),
                                  j = std::max(order[a], order[b]);
                if (!cross_each_other(i, j)) continue;
                const std::string where = segment(i) + ", and " + segment(j);
                if (width_of_loop(i, j) > rounded_crossing * extent_)
                    return refuse(i, "the outline crosses itself: from " + where);
                if (!has_warned)
                    found_.warnings.push_back("the outline crosses itself by rounding: from " +
                                              where);
                has_warned = true;
            }
        }
    }

    void check_area() {
        if (std::fabs(area_of(loop_.points)) > least_area * extent_ * extent_) return;
        refuse(0, "the outline encloses no area; it goes back on the way it came, from " +
                      place(0) + " to " + place(loop_.n / 2));
    }

    // Along the chord, the outline goes once to one end and once back.
    void count_leading_edges() {
        const SectionPoint& end = farthest_point(loop_.points, loop_.at(0));
        const SectionPoint& start = farthest_point(loop_.points, end);
        const SectionStep chord = from_to(end, start);
        const auto begin = static_cast<std::size_t>(&end - loop_.points.data());
        int turns = 0, direction = 1;
        double extreme = 0;
        for (std::size_t k = 0; k <= loop_.n; ++k) {
            const double at =
                dot_of(from_to(end, loop_.at(begin + k)), chord) / (extent_ * extent_);
            const double ahead = direction * (at - extreme);
            if (ahead < -long_way) {
                direction = -direction;
                ++turns;
                extreme = at;
            }
            if (ahead > 0) extreme = at;
        }
        if (turns < 2) return;
        found_.warnings.push_back("along its chord the outline goes " + std::to_string(turns + 1) +
                                  " times from end to end; a section goes to the leading edge and "
                                  "back, with one leading edge");
    }

    const TextFile& file_;
    SectionLoop loop_;
    double extent_;
    SectionFindings found_;
};

}  // namespace

double extent_of(const SectionOutline& outline) {
    const SectionPoint& end = farthest_point(outline, outline[0]);
    return step_length(end, farthest_point(outline, end));
}

double area_of(const SectionOutline& outline) {
    double sum = 0;
    for (std::size_t k = 0; k < outline.size(); ++k) {
        const SectionStep a = from_to(outline[0], outline[k]),
                          b = from_to(outline[0], outline[(k + 1) % outline.size()]);
        sum += cross_of(a, b);
    }
    return sum / 2;
}

std::size_t stray_point(const SectionOutline& outline) {
    const SectionLoop loop{outline};
    if (loop.n < least_points) return loop.n;
    std::vector<double> steps;
    for (std::size_t k = 0; k < loop.n; ++k) steps.push_back(loop.step(k));
    std::nth_element(steps.begin(), steps.begin() + static_cast<std::ptrdiff_t>(loop.n / 2),
                     steps.end());
    const double usual = steps[loop.n / 2];
    for (std::size_t k = 0; k < loop.n; ++k) {
        const double in = loop.step(k + loop.n - 1), out = loop.step(k);
        const double beside_in = loop.step(k + loop.n - 2), beside_out = loop.step(k + 1);
        if (in < much_longer * std::max(beside_in, usual) ||
            out < much_longer * std::max(beside_out, usual))
            continue;
        SectionOutline others = outline;
        others.erase(others.begin() + static_cast<std::ptrdiff_t>(k));
        const double extent = extent_of(others), least = std::min(in, out);
        const bool returns =
            dot_of(from_to(loop.at(k + loop.n - 1), loop.at(k)),
                   from_to(loop.at(k), loop.at(k + 1))) < cosine_of_return * in * out;
        if (least > .5 * extent || (least > .1 * extent && returns)) return k;
    }
    return loop.n;
}

SectionFindings check_section(const TextFile& file, const SectionOutline& outline) {
    return SectionChecker(file, outline).run();
}

}  // namespace cli
