// A bar chart of the comparison: for each movement the quality at least (full bars) and on average
// (outlines) by each method.
#pragma once

#include <algorithm>
#include <ostream>
#include <string>
#include <vector>

namespace compare {

struct Bars {
    struct Group {
        std::string movement;
        std::vector<double> least, mean;  // by method; 0 where cells are inverted
    };

    std::vector<std::string> methods;
    std::vector<Group> groups;

    void draw(std::ostream& out) const {
        const char* const colours[] = {"#0072b2", "#e69f00", "#009e73", "#cc79a7", "#d55e00"};
        const double bar = 14, gap = 22, height = 220, left = 46, top = 44, entry = 150;
        const double bars = bar * static_cast<double>(methods.size());
        const double n = static_cast<double>(groups.size());
        // The names of the methods need their width, however few movements there are.
        const double inside =
            std::max((bars + gap) * n, entry * static_cast<double>(methods.size()));
        const double width = left + inside + 10;
        out << "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 " << width << ' '
            << top + height + 40
            << "\" font-family=\"Helvetica, Arial, sans-serif\" font-size=\"11\"><rect "
               "width=\"100%\" height=\"100%\" "
               "fill=\"#fff\"/>\n";
        for (int tick = 0; tick <= 5; ++tick) {
            const double y = top + height * (1 - tick / 5.0);
            out << "<path d=\"M" << left << ' ' << y << "H" << width - 10
                << "\" stroke=\"#ddd\"/><text x=\"" << left - 6 << "\" y=\"" << y + 4
                << "\" text-anchor=\"end\">" << tick / 5.0 << "</text>\n";
        }
        for (std::size_t m = 0; m < methods.size(); ++m) {
            const double x = left + entry * static_cast<double>(m);
            out << "<rect x=\"" << x << "\" y=\"12\" width=\"12\" height=\"12\" fill=\""
                << colours[m % 5] << "\"/><text x=\"" << x + 18 << "\" y=\"22\">" << methods[m]
                << "</text>\n";
        }
        for (std::size_t g = 0; g < groups.size(); ++g) {
            const double x = left + inside * (static_cast<double>(g) + 0.5) / n - bars / 2;
            for (std::size_t m = 0; m < methods.size(); ++m) {
                const double at = x + bar * static_cast<double>(m);
                const auto bar_of = [&](double value, const char* style) {
                    out << "<rect x=\"" << at << "\" y=\"" << top + height * (1 - value)
                        << "\" width=\"" << bar - 2 << "\" height=\"" << height * value << "\" "
                        << style << '"' << colours[m % 5] << "\"/>\n";
                };
                bar_of(groups[g].least[m], "fill=");
                bar_of(groups[g].mean[m], "fill=\"none\" stroke=");
            }
            out << "<text x=\"" << x + bars / 2 << "\" y=\"" << top + height + 18
                << "\" text-anchor=\"middle\">" << groups[g].movement << "</text>\n";
        }
        out << "</svg>\n";
    }
};

}  // namespace compare
