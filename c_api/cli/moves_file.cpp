#include "moves_file.hpp"

#include "numbers.hpp"
#include "text_file.hpp"

#include <ostream>

namespace cli {

std::vector<double> read_moves(const std::string& path, std::int32_t n_control) {
    const TextFile file(path);
    LineReader lines(file, '#');
    std::vector<double> moves(2 * static_cast<std::size_t>(n_control));
    std::vector<bool> moved(static_cast<std::size_t>(n_control));
    while (lines.next()) {
        const auto& words = lines.words();
        std::int32_t index = 0;
        if (words.size() != 3) lines.expected("index dx dy");
        if (!parse(words[0], index) || index < 1 || index > n_control) {
            lines.expected("a control point between 1 and " + std::to_string(n_control), words[0]);
        }
        const auto point = static_cast<std::size_t>(index - 1);
        if (moved[point]) lines.fail("control point " + std::to_string(index) + " is moved a second time");
        moved[point] = true;
        for (std::size_t i = 0; i < 2; ++i) {
            if (!parse(words[i + 1], moves[2 * point + i])) lines.expected("a finite number", words[i + 1]);
        }
    }
    return moves;
}

void write_moves(std::ostream& out, const std::vector<double>& moves) {
    out << "# control point, dx, dy\n";
    for (std::size_t point = 0; 2 * point < moves.size(); ++point) {
        out << point + 1 << ' ' << exact(moves[2 * point]) << ' ' << exact(moves[2 * point + 1]) << '\n';
    }
}

} // namespace cli
