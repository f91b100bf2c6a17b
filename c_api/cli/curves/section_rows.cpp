#include "curves/section_rows.hpp"

#include "basics/numbers.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <map>

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

}  // namespace cli
