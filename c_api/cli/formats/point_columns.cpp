#include "formats/point_columns.hpp"

#include <algorithm>
#include <iterator>
#include <string_view>

namespace cli {

namespace {

constexpr std::string_view number_words[] = {"vtkoriginalpointids",
                                             "originalpointids",
                                             "originalpointid",
                                             "globalpointids",
                                             "globalpointid",
                                             "globalpointindex",
                                             "globalindex",
                                             "vtkpointids",
                                             "pointids",
                                             "pointid",
                                             "pointindex",
                                             "pointnumber",
                                             "point"};

// The words beside x, y and z, as in x_coord and CoordinateX, or before 0, 1 and 2, as in Points_0.
constexpr std::string_view stem_words[] = {
    "",    "coord",    "coords",    "coordinate", "coordinates", "gridcoordinates",
    "pos", "position", "positions", "point",      "points"};

// A name without what does not count: "Points:0" is the word "points" with the component 0, and
// "X [m]" is the word "x".
struct Spelling {
    std::string word;
    int component = -1;  // a digit 0 to 2 that stands apart from the word or behind a stem
};

bool is_letter_or_digit(char c) {
    return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || (c & 0x80) != 0;
}

Spelling spelling_of(const std::string& name) {
    std::string text;
    for (const char c : name) text += c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
    text.erase(text.find_last_not_of(" \t") + 1);
    const char close = text.empty() ? ' ' : text.back();
    const std::size_t open = close == ']'   ? text.rfind('[')
                             : close == ')' ? text.rfind('(')
                                            : text.npos;
    Spelling found;
    if (open != text.npos && open > 0) {
        const bool is_component =
            text.size() == open + 3 && text[open + 1] >= '0' && text[open + 1] <= '2';
        text = text.substr(0, open) + (is_component ? ":" + text.substr(open + 1, 1) : "");
    }
    bool is_apart = false;  // a sign stands before the last character
    for (std::size_t k = 0; k < text.size(); ++k) {
        if (!is_letter_or_digit(text[k])) continue;
        is_apart = k > 0 && !is_letter_or_digit(text[k - 1]);
        found.word += text[k];
    }
    if (found.word.size() > 1 && found.word.back() >= '0' && found.word.back() <= '2') {
        const std::string stem = found.word.substr(0, found.word.size() - 1);
        const bool is_stem =
            std::find(std::begin(stem_words), std::end(stem_words), stem) != std::end(stem_words);
        if (is_apart || is_stem) {
            found.component = found.word.back() - '0';
            found.word = stem;
        }
    }
    return found;
}

// Tells whether the name is that of coordinate d in the spelling of this way: 0: xSTEM; 1: STEMx;
// 2: STEM:0, or X:0 if there is no stem.
bool is_coordinate(const Spelling& name, std::string_view stem, int way, std::size_t d) {
    const char letter = "xyz"[d];
    if (way == 2) {
        return name.component == static_cast<int>(d) &&
               (stem.empty() ? name.word == "x" : name.word == stem);
    }
    if (name.component >= 0 || name.word.size() != stem.size() + 1) return false;
    return way == 0 ? name.word[0] == letter && name.word.compare(1, stem.size(), stem) == 0
                    : name.word.back() == letter && name.word.compare(0, stem.size(), stem) == 0;
}

}  // namespace

PointColumns find_point_columns(const std::vector<std::string>& names) {
    std::vector<Spelling> spellings;
    for (const std::string& name : names) spellings.push_back(spelling_of(name));
    const auto first = [&](const auto& is_wanted) {
        const auto found = std::find_if(spellings.begin(), spellings.end(), is_wanted);
        return found == spellings.end() ? PointColumns::none
                                        : static_cast<std::size_t>(found - spellings.begin());
    };
    PointColumns columns;
    for (const std::string_view number : number_words) {
        if (columns.has_numbers()) break;
        columns.number =
            first([&](const Spelling& one) { return one.component < 0 && one.word == number; });
    }
    for (const std::string_view stem : stem_words) {
        for (const int way : {0, 1, 2}) {
            for (const std::size_t d : {0u, 1u, 2u}) {
                columns.place[d] =
                    first([&](const Spelling& one) { return is_coordinate(one, stem, way, d); });
            }
            if (columns.has_places()) return columns;
        }
    }
    std::fill(std::begin(columns.place), std::end(columns.place), PointColumns::none);
    return columns;
}

bool says_where(const std::vector<std::string>& names, std::size_t column) {
    const PointColumns columns = find_point_columns(names);
    const std::size_t* const places = std::begin(columns.place);
    if (std::find(places, places + 3, column) != places + 3) return true;
    const Spelling spelling = spelling_of(names[column]);
    if (spelling.component >= 0) return false;
    if (std::find(std::begin(number_words), std::end(number_words), spelling.word) !=
        std::end(number_words))
        return true;
    const Spelling x = columns.has_places() ? spelling_of(names[columns.place[0]]) : Spelling();
    return x.component == 0 && spelling.word == x.word + "magnitude";
}

}  // namespace cli
