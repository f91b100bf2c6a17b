// The ring as PLOT3D grids of one or two blocks.
#pragma once

#include "ring.hpp"

namespace ring {

struct Plot3d {
    bool has_count, iblank, text;
    int record, real;  // bytes
    bool swapped;
    char across;  // '-': two dimensions; 'j', 'k': the index across, planes y = constant and z =
                  // constant
    int blocks;   // 1 or 2
};

inline std::string plot3d(const Plot3d& as) {
    Bytes out{as.swapped};
    const auto whole = [&](int value) {
        if (as.text) out.text += " " + std::to_string(value);
        else out.put(std::int32_t{value});
    };
    int in_line = 0;
    const auto real = [&](double value) {
        if (as.text) out.text += print(" %.15E", value) + (++in_line % 4 == 0 ? "\n" : "");
        else if (as.real == 8) out.put(value);
        else out.put(static_cast<float>(value));
    };
    const auto record = [&](int bytes, const std::function<void()>& content) {
        const auto length = [&] {
            if (as.record == 4) out.put(std::int32_t{bytes});
            if (as.record == 8) out.put(std::int64_t{bytes});
        };
        length();
        content();
        length();
        if (as.text) out.text += "\n";
    };
    const int ni = around / as.blocks + 1, nj = outwards + 1, dimensions = as.across == '-' ? 2 : 3;
    const int layers = as.across == '-' ? 1 : 2;
    const int middle = as.across == 'j' ? 2 : nj, last = as.across == 'j' ? nj : layers;
    if (as.has_count) record(4, [&] { whole(as.blocks); });
    record(4 * dimensions * as.blocks, [&] {
        for (int block = 0; block < as.blocks; ++block) {
            whole(ni);
            whole(middle);
            if (dimensions == 3) whole(last);
        }
    });
    const int points = ni * nj * layers;
    for (int block = 0; block < as.blocks; ++block) {
        const auto each = [&](const std::function<void(int, int)>& visit) {  // point, layer
            for (int k = 0; k < last; ++k) {
                for (int j = 0; j < middle; ++j) {
                    for (int i = 0; i < ni; ++i) {
                        visit(point(i + block * (ni - 1), as.across == 'j' ? k : j),
                              as.across == 'j' ? j : k);
                    }
                }
            }
        };
        record(points * (dimensions * as.real + (as.iblank ? 4 : 0)), [&] {
            each([&](int p, int) { real(x[std::size_t(p)]); });
            if (as.across == 'j') each([&](int, int layer) { real(-.5 * layer); });
            each([&](int p, int) { real(y[std::size_t(p)]); });
            if (as.across == 'k') each([&](int, int layer) { real(-.5 * layer); });
            if (as.iblank) each([&](int, int) { whole(1); });
        });
    }
    return out.text;
}

inline Kinds plot3d_kinds() {
    return {
        {"text.p3d",
         [] {
             return plot3d({false, false, true, 0, 8, false, '-', 1});
         }},
        {"two-text-iblank.p3d",
         [] {
             return plot3d({true, true, true, 0, 8, false, '-', 2});
         }},
        {"text-k.p3d",
         [] {
             return plot3d({true, false, true, 0, 8, false, 'k', 1});
         }},
        {"stream.p3d",
         [] {
             return plot3d({true, false, false, 0, 8, false, '-', 1});
         }},
        {"stream-single.p3d",
         [] {
             return plot3d({false, true, false, 0, 4, true, 'j', 1});
         }},
        {"two-stream-swapped.p3d",
         [] {
             return plot3d({true, true, false, 0, 8, true, 'k', 2});
         }},
        {"two-fortran.p3d",
         [] {
             return plot3d({true, false, false, 4, 8, false, 'j', 2});
         }},
        {"fortran-swapped.p3d",
         [] {
             return plot3d({false, true, false, 4, 8, true, '-', 1});
         }},
        {"fortran-8.p3d",
         [] {
             return plot3d({true, true, false, 8, 8, false, 'k', 1});
         }},
        {"two-fortran-8-single.p3d",
         [] {
             return plot3d({true, false, false, 8, 4, true, '-', 2});
         }},
    };
}

}  // namespace ring
