// The formula of the skew quality, for one cell and for several at a time.
#pragma once

namespace harmorph {

// The skew quality of a triangle from twice its area and the sum of the squares of its sides, and
// of a quad from twice the areas of its corners, the roots of squared products of the sides 0 and
// 1, 1 and 2, 2 and 3, and the square of the second root. Number: a Real, or a vector of them for
// several cells, which is why results are references. Numerator and denominator; the quad's is 4 /
// (l0 l1 / A1 + l1 l2 / A2 + l2 l3 / A3 + l3 l0 / A0) over the common denominator, with three roots
// for the four products of lengths.
template <class Number>
__attribute__((always_inline)) inline void skew_of_triangle(Number const& area,
                                                            Number const& squares, Number& above,
                                                            Number& under) noexcept {
    above = 2 * 1.7320508075688772 * area;
    under = squares;
}
template <class Number>
__attribute__((always_inline)) inline void skew_of_quad(Number const (&area)[4],
                                                        Number const (&root)[3],
                                                        Number const& opposite, Number& above,
                                                        Number& under) noexcept {
    Number const first = area[1] * area[2], last = area[3] * area[0];
    above = 4 * root[1] * (first * last);
    under = (root[0] * root[1] * area[2] + opposite * area[1]) * last +
            root[2] * (root[1] * area[0] + root[0] * area[3]) * first;
}

}  // namespace harmorph
