// The formula of the skew quality, for one cell and for several at a time.
// tests/morph/test_quality.cpp and tests/morph/test_cell_batch.cpp cover this file.
#pragma once

namespace harmorph {

// Both functions return numerator and denominator of the skew quality. For a triangle they take
// twice the area and the sum of the squares of the sides. For a quad they take twice the areas of
// the corners, the roots of the squared products of the sides 0 and 1, 1 and 2, 2 and 3, and the
// square of the second root. Number is a Real, or a vector of them for several cells, so results
// are references. The quad's quality is 4 / (l0 l1 / A1 + l1 l2 / A2 + l2 l3 / A3 + l3 l0 / A0)
// over the common denominator, with three roots for the four products of lengths.
template <class Number>
__attribute__((always_inline)) inline void skew_of_triangle(Number const& area,
                                                            Number const& squares,
                                                            Number& numerator,
                                                            Number& denominator) noexcept {
    numerator = 2 * 1.7320508075688772 * area;
    denominator = squares;
}
template <class Number>
__attribute__((always_inline)) inline void skew_of_quad(Number const (&area)[4],
                                                        Number const (&root)[3],
                                                        Number const& opposite, Number& numerator,
                                                        Number& denominator) noexcept {
    Number const first = area[1] * area[2], last = area[3] * area[0];
    numerator = 4 * root[1] * (first * last);
    denominator = (root[0] * root[1] * area[2] + opposite * area[1]) * last +
                  root[2] * (root[1] * area[0] + root[0] * area[3]) * first;
}

}  // namespace harmorph
