// The ring in UGRID files, between the planes y = 0 and y = 1. Point p of the ring is 2 p + 2 in
// the first plane and 2 p + 1 in the second.
#pragma once

#include "ring.hpp"

namespace ring {

inline std::string ugrid(bool text, bool swapped, int real_bytes, bool split) {
    Bytes out{swapped};
    const auto whole = [&](int value) {
        text ? void(out.text += std::to_string(value) + " ") : out.put(std::int32_t{value});
    };
    const auto real = [&](double value) {
        if (text) out.text += print("%.16e ", value);
        else if (real_bytes == 8) out.put(value);
        else out.put(static_cast<float>(value));
    };
    const auto line = [&] {
        if (text) out.text.back() = '\n';
    };
    const auto item = [&](const std::vector<int>& points) {
        for (const int value : points) whole(value);
        line();
    };
    const auto low = [](int i, int j) { return 2 * point(i, j) + 2; };
    const auto high = [](int i, int j) { return 2 * point(i, j) + 1; };
    const int n = around * outwards;
    item({2 * int(x.size()), split ? 4 * n : 0, 2 * around + (split ? 0 : 2 * n), 0, 0,
          split ? 2 * n : 0, split ? 0 : n});
    for (std::size_t p = 0; p < x.size(); ++p) {
        for (const double layer : {1., 0.}) {
            real(x[p]);
            real(layer);
            real(y[p]);
            line();
        }
    }
    const auto each_cell = [&](const std::function<void(int, int)>& visit) {
        for (int j = 0; j < outwards; ++j) {
            for (int i = 0; i < around; ++i) visit(i, j);
        }
    };
    using Place = std::function<int(int, int)>;
    if (split) {
        for (const Place& at : {Place(low), Place(high)}) {
            each_cell([&](int i, int j) {
                item({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
                item({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
            });
        }
    }
    for (const int j : {0, outwards}) {
        for (int i = 0; i < around; ++i)
            item({low(i, j), high(i, j), high(i + 1, j), low(i + 1, j)});
    }
    if (!split) {
        for (const Place& at : {Place(low), Place(high)}) {
            each_cell([&](int i, int j) {
                item({at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)});
            });
        }
    }
    const auto tags = [&](int count, int tag) {
        for (int k = 0; k < count; ++k) {
            whole(tag);
            line();
        }
    };
    if (split) tags(2 * n, 3);
    if (split) tags(2 * n, 4);
    tags(around, 1);
    tags(around, 2);
    if (!split) tags(n, 3);
    if (!split) tags(n, 4);
    each_cell([&](int i, int j) {
        if (split) {
            item({low(i, j), low(i + 1, j), low(i + 1, j + 1), high(i, j), high(i + 1, j),
                  high(i + 1, j + 1)});
            item({high(i, j), high(i + 1, j + 1), high(i, j + 1), low(i, j), low(i + 1, j + 1),
                  low(i, j + 1)});
        } else if (i % 3 == 0) {  // a side of the plane at the bottom, in front, at the left
            item({low(i, j), low(i + 1, j), low(i + 1, j + 1), low(i, j + 1), high(i, j),
                  high(i + 1, j), high(i + 1, j + 1), high(i, j + 1)});
        } else if (i % 3 == 1) {
            item({high(i, j), high(i + 1, j), low(i + 1, j), low(i, j), high(i, j + 1),
                  high(i + 1, j + 1), low(i + 1, j + 1), low(i, j + 1)});
        } else {
            item({low(i, j), high(i, j), high(i + 1, j), low(i + 1, j), low(i, j + 1),
                  high(i, j + 1), high(i + 1, j + 1), low(i + 1, j + 1)});
        }
    });
    return out.text;
}

inline Kinds ugrid_kinds() {
    return {
        {"text.ugrid", [] { return ugrid(true, false, 8, false); }},
        {"prisms.lb8.ugrid", [] { return ugrid(false, false, 8, true); }},
        {"hexahedra.b8.ugrid", [] { return ugrid(false, true, 8, false); }},
        {"single.lb4.ugrid", [] { return ugrid(false, false, 4, false); }},
    };
}

}  // namespace ring
