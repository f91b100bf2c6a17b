// The ring in SU2 files: plain, with numbers in several formats, with comments and unusual blanks,
// and in zones.
#pragma once

#include "ring.hpp"

namespace ring {

inline std::string su2_cells(const char* blank) {
    std::ostringstream out;
    out << "NELEM= " << around * outwards << "\n";
    for (int j = 0, n = 0; j < outwards; ++j) {
        for (int i = 0; i < around; ++i, ++n) {
            out << 9 << blank << point(i, j) << blank << point(i + 1, j) << blank
                << point(i + 1, j + 1) << blank << point(i, j + 1) << blank << n << "\n";
        }
    }
    return out.str();
}
inline std::string su2_points(const char* format, const char* blank, const char* behind,
                              const char* counts) {
    std::ostringstream out;
    out << "NPOIN= " << counts << "\n";
    for (std::size_t k = 0; k < x.size(); ++k)
        out << print(format, x[k]) << blank << print(format, y[k]) << behind << "\n";
    return out.str();
}
inline std::string su2_marker(const char* tag, int j) {
    std::ostringstream out;
    out << "MARKER_TAG= " << tag << "\nMARKER_ELEMS= " << around << "\n";
    for (int i = 0; i < around; ++i) out << "3 " << point(i, j) << " " << point(i + 1, j) << "\n";
    return out.str();
}
inline std::string su2_zone(const char* format = "%.17g") {
    return "NDIME= 2\n" + su2_cells(" ") + su2_points(format, " ", "", "168") + "NMARK= 2\n" +
           su2_marker("body", 0) + su2_marker("far", outwards);
}
inline std::string su2_odd() {
    std::string text = "% a comment = here\nNDIME=2\n" +
                       su2_points("%.13E", "\t ", " 0 17 % z", "168 150") + "\nNMARK = 4\n" +
                       su2_marker("body", 0) + su2_marker("inside line", 2) +
                       su2_marker("17", outwards) +
                       "MARKER_TAG= SEND_RECEIVE\nMARKER_ELEMS= 2\nSEND_TO= 1\n1 0 0\n1 5 0\n"
                       "MARKER_TAG= SEND_RECEIVE\nMARKER_ELEMS= 1\nRECEIVE_FROM= 1\n1 0 0\n" +
                       su2_cells("\t") + "FFD_NBOX= 1\nFFD_CORNER_POINTS= 2\n0 0\n1 1\n";
    std::string returns;
    for (const char c : text) returns += c == '\n' ? "\r\n" : std::string(1, c);
    return returns;
}
inline std::string su2_zones() {
    const std::string other =
        "NDIME= 2\nNELEM= 1\n5 0 1 2\nNPOIN= 3\n0 0\n1.0 0\n0 1\nNMARK= 1\nMARKER_TAG= "
        "b\nMARKER_ELEMS= 3\n"
        "3 0 1\n3 1 2\n3 2 0\n";
    return "NZONE= 3\nIZONE= 1\n" + other + "IZONE= 2\n" + su2_zone() + "IZONE= 3\n" + other;
}

inline Kinds su2_kinds() {
    return {
        {"plain.su2", [] { return su2_zone(); }},
        {"fixed.su2", [] { return su2_zone("%.8f"); }},
        {"leading-zero.su2", [] { return su2_zone("Fortran"); }},
        {"odd.su2", su2_odd},
        {"zones.su2", su2_zones},
    };
}

}  // namespace ring
