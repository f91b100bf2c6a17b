// The ring in legacy VTK files; binary numbers are big-endian.
#pragma once

#include "ring.hpp"

namespace ring {

inline std::string vtk(bool text, const char* real_type, bool new_cells) {
    Bytes out{true};
    out.text = std::string("# vtk DataFile Version ") + (new_cells ? "5.1" : "3.0") + "\n\n" +
               (text ? "ASCII" : "BINARY") +
               "\nDATASET UNSTRUCTURED_GRID\nFIELD FieldData 1\nTIME 1 1 double\n";
    const auto whole = [&](int value, bool eight) {
        if (text) out.text += std::to_string(value) + " ";
        else if (eight) out.put(std::int64_t{value});
        else out.put(std::int32_t{value});
    };
    const auto real = [&](double value) {
        if (text) out.text += print("%.10g ", value);
        else if (std::string(real_type) == "double") out.put(value);
        else out.put(static_cast<float>(value));
    };
    real(.25);
    out.text += "\nPOINTS 168 " + std::string(real_type) + "\n";
    for (std::size_t p = 0; p < x.size(); ++p) {
        for (const double value : {x[p], y[p], 0.}) real(value);
        if (p % 3 == 2 && text) out.text += "\n";
    }
    const int n = around * outwards,
              lines = new_cells ? 0 : 1;  // a line among the cells is passed over
    if (new_cells) out.text += "\nMETADATA\nINFORMATION 0\n";
    out.text += "\nCELLS " + std::to_string(n + 1) + " " +
                std::to_string((new_cells ? 4 : 5) * n + 3 * lines) + "\n";
    if (new_cells) {
        out.text += "OFFSETS vtktypeint64\n";
        for (int cell = 0; cell <= n; ++cell) whole(4 * cell, true);
        out.text += "\nCONNECTIVITY vtktypeint64\n";
    } else {
        for (const int value : {2, 0, 1}) whole(value, false);
    }
    for (int j = 0; j < outwards; ++j) {
        for (int i = 0; i < around; ++i) {
            if (!new_cells) whole(4, false);
            for (const int p : {point(i, j), point(i + 1, j), point(i + 1, j + 1), point(i, j + 1)})
                whole(p, new_cells);
        }
    }
    out.text += "\nCELL_TYPES " + std::to_string(n + lines) + "\n";
    if (lines == 1) whole(3, false);
    for (int cell = 0; cell < n; ++cell) whole(9, false);
    return out.text + "\nCELL_DATA 1\nanything\n";
}

inline Kinds vtk_kinds() {
    return {
        {"text.vtk", [] { return vtk(true, "float", false); }},
        {"text-5.vtk", [] { return vtk(true, "double", true); }},
        {"binary.vtk", [] { return vtk(false, "double", true); }},
        {"binary-single.vtk", [] { return vtk(false, "float", false); }},
    };
}

}  // namespace ring
