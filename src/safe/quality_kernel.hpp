// The energies of corners and their derivatives, with the registers of one instruction set;
// quality_energy.cpp compiles this file for each set. The formulas of derivatives are those of
// CornerMap. tests/safe/test_quality_energy.cpp covers this file.

namespace harmorph::corner_energies::HARMORPH_SET {
namespace {

using Registers = simd::HARMORPH_SET::Registers<Real>;
using Vector = Registers::Vector;

constexpr Index lanes = Registers::lanes;
// A list is filled up to a multiple of this number of corners, the largest number of lanes.
constexpr Index max_lanes = 8;

struct Pair {
    Vector x, y;
};
HARMORPH_INLINE Pair operator+(Pair a, Pair b) noexcept { return {a.x + b.x, a.y + b.y}; }
HARMORPH_INLINE Pair operator*(Vector a, Pair b) noexcept { return {a * b.x, a * b.y}; }
HARMORPH_INLINE Vector dot(Pair a, Pair b) noexcept { return a.x * b.x + a.y * b.y; }
HARMORPH_INLINE Vector cross(Pair a, Pair b) noexcept { return a.x * b.y - a.y * b.x; }
HARMORPH_INLINE Vector square(Pair a) noexcept { return dot(a, a); }
HARMORPH_INLINE Pair conjugate(Pair a) noexcept { return {a.x, -a.y}; }
HARMORPH_INLINE Pair product(Pair a, Pair b) noexcept {
    return {a.x * b.x - a.y * b.y, a.x * b.y + a.y * b.x};
}

// The corners of a list from number i on.
struct Corners {
    Pair a, b, c, d;  // the sides of the target and of the corner
    Vector any_ratio, weight, scale, per_area;

    HARMORPH_INLINE Corners(CornerList const& list, Index i) noexcept
        : a(pair(list.target, i)),
          b(pair(list.target + 2, i)),
          c(pair(list.now, i)),
          d(pair(list.now + 2, i)),
          any_ratio(Registers::load(list.any_ratio + i)),
          weight(Registers::load(list.weight + i)),
          scale(Registers::load(list.scale + i)),
          per_area(1 / cross(a, b)) {}

    static HARMORPH_INLINE Pair pair(const Real (*from)[CornerList::max_count], Index i) noexcept {
        return {Registers::load(from[0] + i), Registers::load(from[1] + i)};
    }
    HARMORPH_INLINE Vector determinant() const noexcept { return per_area * cross(c, d); }
};

// Copies the last corner to the places after it, up to a full register of any set.
void fill_up(CornerList& list) noexcept {
    for (Index i = list.n; i % max_lanes != 0; ++i) {
        for (Index k = 0; k < 4; ++k) {
            list.now[k][i] = list.now[k][list.n - 1];
            list.target[k][i] = list.target[k][list.n - 1];
        }
        list.any_ratio[i] = list.any_ratio[list.n - 1];
        list.weight[i] = list.weight[list.n - 1];
        list.scale[i] = list.scale[list.n - 1];
    }
}

HARMORPH_INLINE Vector raised(Vector base, Index power) noexcept {
    Vector out = base;
    for (Index k = 1; k < power; ++k) out *= base;
    return out;
}

// p + q is (|a|^2 |d|^2 + |b|^2 |c|^2 - 2 (a b) (c d)) / 2 A^2, where A is the area of the target's
// parallelogram. The ratio of sides that fits best makes the first two terms equal. Beyond `most`,
// derivatives could overflow: they are up to 4 power energy max(s, 1) / d^2, divided by the area of
// the target.
Real energies(CornerList& list, Real* energy) noexcept {
    constexpr Real min_area = 1e-50, largest = 1e280;
    Real max_base = 1e256;  // the power of this number is not above 1e256
    for (Index k = 1; k < list.power; k *= 2) max_base = sqrt(max_base);
    fill_up(list);
    Vector const zero = {}, one = zero + 1, highest = zero + max_base;
    for (Index i = 0; i < list.n; i += lanes) {
        Corners const corner(list, i);
        Vector const per_area = corner.per_area, determinant = corner.determinant();
        Vector const aa = per_area * square(corner.a), bb = per_area * square(corner.b),
                     cc = per_area * square(corner.c), dd = per_area * square(corner.d);
        Vector const lengths = corner.any_ratio > 0
                                   ? Registers::sqrt(aa * bb) * Registers::sqrt(cc * dd)
                                   : 0.5 * (aa * dd + bb * cc);
        Vector const s =
            lengths - (per_area * dot(corner.a, corner.b)) * (per_area * dot(corner.c, corner.d));
        Vector const unit = Registers::max(s, one);
        auto const is_valid = (determinant > min_area * unit) & (determinant < 1 / min_area);
        Vector const d = is_valid ? determinant : one, per_d = 1 / d;
        Vector const shape = (is_valid ? s : one) * per_d;
        Vector const base = corner.scale * shape * shape * (0.5 * (d + per_d));
        Vector const small = Registers::min(d, one), area = 1 / per_area;
        Vector const room = largest * Registers::min(area, one) * small * small / unit;
        auto const is_below = base <= highest;
        Vector const value = raised(is_below ? base : one, list.power);
        auto const is_finite = is_valid & is_below & (value <= room);
        Registers::store(energy + i, is_finite ? corner.weight * value : zero + infinity);
    }
    Real sum = 0;
    for (Index i = 0; i < list.n; ++i) sum += energy[i];
    return sum;
}

// The derivatives of the logarithm 2 ln s - 2 ln d + ln (d + 1/d), with s = p + q and d = p - q,
// and from these those of the energy, divided by power weight energy.
struct Density {
    Vector by_p, by_q, by_pp, by_qq, by_pq;

    HARMORPH_INLINE Density(Vector s, Vector d, Real power) noexcept {
        Vector const square_of_d = d * d, per_d = 1 / d,
                     per_below = per_d * (1 / (square_of_d + 1));
        Vector const by_s = 2 / s, by_ss = -0.5 * by_s * by_s;
        Vector const by_d = (square_of_d - 1) * per_below - 2 * per_d;
        Vector const by_dd =
            (1 + 4 * square_of_d - square_of_d * square_of_d) * per_below * per_below +
            2 * per_d * per_d;
        by_p = by_s + by_d;
        by_q = by_s - by_d;
        by_pp = by_ss + by_dd + power * by_p * by_p;
        by_qq = by_ss + by_dd + power * by_q * by_q;
        by_pq = by_ss - by_dd + power * by_p * by_q;
    }
};

// The Hessian by z maps v to turning v + along u^2 conj(v), where u is the direction of z; that by
// w likewise.
struct Parts {
    Vector turning_z, along_z, turning_w, along_w, coupling;

    HARMORPH_INLINE Parts(Density const& by, Vector p, Vector q, Vector root,
                          Vector min_curvature) noexcept {
        Vector const zero = {};
        Vector const a = 2 * by.by_p + 4 * p * by.by_pp, b = 4 * root * by.by_pq,
                     c = 2 * by.by_q + 4 * q * by.by_qq;
        Vector const middle = 0.5 * (a + c), half = 0.5 * (a - c);
        Vector const radius = Registers::sqrt(half * half + b * b);
        Vector const per_radius = 1 / (radius > 0 ? radius : zero + 1);
        Vector const cosine = radius > 0 ? per_radius * half : zero + 1, sine = per_radius * b;
        Vector const high = Registers::max(middle + radius, min_curvature),
                     low = Registers::max(middle - radius, min_curvature);
        Vector const mean = 0.5 * (high + low), difference = 0.5 * (high - low);
        Vector const turn_z = Registers::max(2 * by.by_p, min_curvature),
                     turn_w = Registers::max(2 * by.by_q, min_curvature);
        Vector const scaling_z = mean + difference * cosine, scaling_w = mean - difference * cosine;
        coupling = 0.5 * difference * sine;
        turning_z = 0.5 * (scaling_z + turn_z);
        turning_w = 0.5 * (scaling_w + turn_w);
        along_z = 0.5 * (scaling_z - turn_z);
        along_w = 0.5 * (scaling_w - turn_w);
    }
};

// Stores the block that maps v to t v + c conj(v), with a real t.
HARMORPH_INLINE void store_symmetric(Real (*to)[CornerList::max_count], Index i, Vector t,
                                     Pair c) noexcept {
    Registers::store(to[0] + i, t + c.x);
    Registers::store(to[1] + i, c.y);
    Registers::store(to[2] + i, t - c.x);
}

void differentiate(CornerList& list, Real min_curvature, CornerForms& forms) noexcept {
    // No q that is not 0 is smaller than this number.
    constexpr Real tiny = 1e-200;
    Real const power = static_cast<Real>(list.power);
    fill_up(list);
    Vector const zero = {}, one = zero + 1;
    auto const store = [&](Index k, Index i, Vector v) { Registers::store(forms.value[k] + i, v); };
    for (Index i = 0; i < list.n; i += lanes) {
        Corners const corner(list, i);
        Pair const c = corner.c, d = corner.d;
        auto const is_free = corner.any_ratio > 0;
        Vector const cc = is_free ? square(c) : one, dd = is_free ? square(d) : one;
        Vector const ratio = cc / dd * (square(corner.b) / square(corner.a)),
                     root_of_ratio = Registers::sqrt(Registers::sqrt(ratio)),
                     longer = is_free ? root_of_ratio : one;
        // With f and g, z = f c + g d and w = conj(f) c + conj(g) d.
        Vector const half = 0.5 * corner.per_area, per_longer = half / longer,
                     times_longer = half * longer;
        Pair const f = {per_longer * corner.b.y, per_longer * corner.b.x},
                   g = {-times_longer * corner.a.y, -times_longer * corner.a.x};
        Pair const z = product(f, c) + product(g, d),
                   w = product(conjugate(f), c) + product(conjugate(g), d);
        Vector const p = square(z), q = square(w), s = p + q, determinant = corner.determinant();
        Vector const per_d = 1 / determinant, shape = s * per_d;
        Vector const energy =
            raised(corner.scale * shape * shape * (0.5 * (determinant + per_d)), list.power);
        Vector const factor = power * (corner.weight * energy);
        Density const by(s, determinant, power);
        Vector const safe_q = Registers::max(q, zero + tiny), root = Registers::sqrt(p * safe_q),
                     per_pq = 1 / (p * safe_q);
        Parts const part(by, p, q, q > 0 ? root : zero, zero + 4 * min_curvature);

        Pair const by_z = 2 * factor * by.by_p * z, by_w = 2 * factor * by.by_q * w;
        Pair const by_side = product(conjugate(f), by_z) + product(f, by_w),
                   by_next = product(conjugate(g), by_z) + product(g, by_w);
        store(0, i, by_side.x);
        store(1, i, by_side.y);
        store(2, i, by_next.x);
        store(3, i, by_next.y);

        Pair const b_z = factor * part.along_z * (safe_q * per_pq) * product(z, z),
                   b_w = factor * part.along_w * (p * per_pq) * product(w, w);
        Vector const joint = factor * part.coupling * (root * per_pq);
        Pair const a_zw = joint * product(z, conjugate(w)), b_zw = joint * product(z, w);
        Vector const a_z = factor * part.turning_z, a_w = factor * part.turning_w, a = a_z + a_w;
        Pair const ff = product(f, f), gg = product(g, g), fg = product(f, g),
                   f_to_g = product(conjugate(f), g);
        Vector const f2 = square(f), g2 = square(g);
        store_symmetric(forms.value + 4, i, a * f2 + 2 * dot(a_zw, ff),
                        product(b_z, conjugate(ff)) + product(b_w, ff) + 2 * f2 * b_zw);
        store_symmetric(forms.value + 7, i, a * g2 + 2 * dot(a_zw, gg),
                        product(b_z, conjugate(gg)) + product(b_w, gg) + 2 * g2 * b_zw);
        Vector const t_x = a * f_to_g.x + 2 * dot(a_zw, fg), t_y = (a_z - a_w) * f_to_g.y;
        Pair const turned = product(b_z, conjugate(fg)) + product(b_w, fg) + 2 * f_to_g.x * b_zw;
        store(10, i, t_x + turned.x);
        store(11, i, turned.y - t_y);
        store(12, i, turned.y + t_y);
        store(13, i, t_x - turned.x);
    }
}

constexpr QualityKernels kernels{energies, differentiate};

}  // namespace
}  // namespace harmorph::corner_energies::HARMORPH_SET

namespace harmorph::simd {
template <>
inline constexpr const QualityKernels* table<QualityKernels, Kernel::HARMORPH_SET> =
    &harmorph::corner_energies::HARMORPH_SET::kernels;
}  // namespace harmorph::simd
