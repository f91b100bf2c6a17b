#include "basics/marker_names.hpp"

#include "basics/numbers.hpp"

#include <algorithm>
#include <cctype>
#include <numeric>

namespace cli {

namespace {

// Where the sentence says that a number is a marker's: "marker 4", "markers 4 and 5", "partner of
// 4".
class MarkerWords {
public:
    bool names_marker(std::string_view word, bool is_number) {
        const bool expects = after_marker_ || (word_ == "of" && before_ == "partner") ||
                             (word_ == "and" && markers_);
        if (word == "marker" || word == "markers") after_marker_ = true;
        else after_marker_ = false;
        if (word == "markers") markers_ = true;
        else if (!is_number && word != "and") markers_ = false;
        before_ = word_;
        word_ = word;
        return is_number && expects;
    }

private:
    std::string_view word_, before_;
    bool after_marker_ = false, markers_ = false;
};

}  // namespace

void number_by_name(Mesh& mesh) {
    std::vector<std::size_t> order(mesh.markers.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::sort(order.begin(), order.end(),
              [&](std::size_t a, std::size_t b) { return mesh.markers[a] < mesh.markers[b]; });
    std::vector<std::int32_t> number(order.size());
    std::vector<std::string> names;
    for (const std::size_t marker : order) {
        number[marker] = static_cast<std::int32_t>(names.size());
        names.push_back(mesh.markers[marker]);
    }
    for (std::int32_t& marker : mesh.face_markers)
        marker = number[static_cast<std::size_t>(marker)];
    mesh.markers = names;
}

std::string name_markers(const std::string& sentence, const std::vector<std::string>& names) {
    const auto is_part = [](char c) {
        return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '-';
    };
    std::string text;
    MarkerWords words;
    for (std::size_t begin = 0; begin < sentence.size();) {
        std::size_t end = begin;
        while (end < sentence.size() && is_part(sentence[end])) ++end;
        if (end == begin) {
            text += sentence[begin++];
            continue;
        }
        const std::string_view word = std::string_view(sentence).substr(begin, end - begin);
        std::int32_t number = -1;
        const bool is_number = parse(word, number);
        const bool is_marker = words.names_marker(word, is_number);
        const bool exists =
            is_marker && number >= 0 && static_cast<std::size_t>(number) < names.size();
        text += exists ? in_quotes(names[static_cast<std::size_t>(number)]) : std::string(word);
        begin = end;
    }
    return text;
}

std::string listed(const std::vector<std::string>& names) {
    std::string text;
    for (const std::string& name : names) text += (text.empty() ? "" : ", ") + in_quotes(name);
    return text.empty() ? "no markers" : text;
}

}  // namespace cli
