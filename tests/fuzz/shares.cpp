// Shares of the functions, rows for lists of points, and sums of gradients: bit by bit those of the
// whole basis.
#include "work_in_parts.hpp"

#include "private.h"
#include <harmorph_study.h>

#include <cmath>

namespace fuzz {
namespace {

using Numbers = std::vector<double>;

class Shares {
public:
    Shares(Solution& whole, Input& input)
        : its_(whole), input_(input), n_(whole.problem.domain.points.size()) {
        info_ = info_of(its_.basis);
        for (std::int32_t k = 0; k < its_.problem.mesh.n_points; ++k)
            lists_[input_.below(2)].push_back(k);
    }

    void all() {
        for (std::vector<std::int32_t> const& list : lists_)
            if (!list.empty()) rows(list);
        gradient();
        its_.blocks.expect_intact();
    }

private:
    hm_basis* share(std::int32_t part, std::int32_t n_parts) {
        std::int32_t first = -1, n = -1;
        hm_basis* made = nullptr;
        expect(hm_private_share_of(its_.analysis, part, n_parts, &first, &n, &error_) == HM_OK,
               "no share");
        expect(first == next_ && n >= 0, "shares have gaps");
        next_ = first + n;
        hm_status const status =
            its_.blocks.make(error_, size_by(hm_private_share_size, its_.analysis, first, n),
                             init_by(hm_private_share_init, &made, its_.analysis, first, n));
        expect(status == HM_OK, "a share is refused: " + std::string(error_.text));
        hm_status const solved = hm_plan_solve(its_.plan, made, nullptr, &error_);
        expect_told(solved, error_);
        expect(solved >= 0, "a share is not solved: " + std::string(error_.text));
        return made;
    }

    void rows(std::vector<std::int32_t> const& list) {
        std::int32_t const n_parts = input_.from(1, 4), n = static_cast<std::int32_t>(list.size());
        std::vector<std::int32_t> points = list;
        for (std::int32_t& k : points) k += its_.problem.mesh.index_base;
        hm_basis* rows = nullptr;
        next_ = 0;
        for (std::int32_t part = 0; part < n_parts; ++part) {
            hm_basis* const whole_share = share(part, n_parts);
            if (part == 0) {
                std::size_t bytes = 0;
                expect(hm_private_extract_size(whole_share, n, &bytes, &error_) == HM_OK,
                       "no size of rows");
                expect(hm_private_extract_init(&rows, its_.blocks.take(bytes).data(), bytes,
                                               whole_share, n, points.data(), &error_) == HM_OK,
                       "no rows: " + std::string(error_.text));
                if (n_parts == 1) break;  // all functions: the rows have their values
            }
            std::int64_t doubles = 0;
            expect(hm_private_parcel_size(whole_share, n, &doubles, &error_) == HM_OK,
                   "no size of a parcel");
            Numbers parcel(at(doubles));
            expect(hm_private_parcel_pack(whole_share, n, points.data(), parcel.data(), &error_) ==
                       HM_OK,
                   "no parcel");
            expect(hm_private_parcel_unpack(rows, parcel.data(), doubles - 1, &error_) < 0,
                   "a truncated parcel is taken");
            if (n > 1) {  // the same points, the last ones in another order
                std::vector<std::int32_t> other = points;
                std::swap(other[other.size() - 1], other[other.size() - 2]);
                Numbers turned(parcel.size());
                expect(hm_private_parcel_pack(whole_share, n, other.data(), turned.data(),
                                              &error_) == HM_OK,
                       "no parcel");
                expect(
                    hm_private_parcel_unpack(rows, turned.data(), doubles, &error_) == HM_BAD_BASIS,
                    "a parcel of another list is taken");
            }
            expect(hm_private_parcel_unpack(rows, parcel.data(), doubles, &error_) == HM_OK,
                   "a parcel is refused: " + std::string(error_.text));
        }
        expect(next_ == info_.functions, "shares do not have all functions");
        Numbers of_rows(list.size()), of_all(n_);
        for (std::int32_t i = 0; i < info_.functions; ++i)
            for (std::int32_t number = 0; number < info_.numbers_per_value; ++number) {
                expect(hm_basis_values(rows, i, number, of_rows.data(), &error_) == HM_OK,
                       "no values of rows");
                expect(hm_basis_values(its_.basis, i, number, of_all.data(), &error_) == HM_OK,
                       "no values");
                for (std::size_t k = 0; k < list.size(); ++k)
                    expect(of_rows[k] == of_all[at(list[k])], "a share has other bits");
            }
    }

    // Sums of two lists, elementwise, and the whole: bit by bit.
    void gradient() {
        std::size_t const n_sums = 4 * at(info_.functions * info_.numbers_per_value);
        Numbers x(n_), y(n_), whole(2 * at(info_.functions)), summed = whole;
        for (std::size_t k = 0; k < n_; ++k)
            x[k] = input_.between(-1, 1), y[k] = input_.between(-1, 1);
        if (input_.one_in(8)) x[input_.below(static_cast<std::uint32_t>(n_))] = input_.wild();
        hm_points const dj{x.data(), y.data(), 1};
        expect(hm_adjoint(its_.basis, &dj, whole.data(), nullptr, &error_) == HM_OK, "no gradient");
        std::vector<std::int64_t> sums(n_sums, 0), of_part(n_sums);
        std::int32_t scale = 0;
        Numbers part_x[2], part_y[2];
        for (int pass = 0; pass < 2; ++pass)
            for (std::size_t p = 0; p < 2; ++p) {
                part_x[p].assign(n_, 0), part_y[p].assign(n_, 0);
                for (std::int32_t const k : lists_[p]) {
                    part_x[p][at(k)] = x[at(k)];
                    part_y[p][at(k)] = y[at(k)];
                }
                hm_points const gradient_points{part_x[p].data(), part_y[p].data(), 1};
                std::int32_t own_scale = 0;
                if (pass == 0) {
                    expect(hm_private_adjoint_scale(its_.basis, &gradient_points, &own_scale,
                                                    nullptr, &error_) == HM_OK,
                           "no scale");
                    scale = p == 0 ? own_scale : std::max(scale, own_scale);
                    continue;
                }
                expect(hm_private_adjoint_sums(its_.basis, &gradient_points, scale, of_part.data(),
                                               nullptr, &error_) == HM_OK,
                       "no sums: " + std::string(error_.text));
                for (std::size_t k = 0; k < n_sums; ++k)
                    sums[k] = static_cast<std::int64_t>(static_cast<std::uint64_t>(sums[k]) +
                                                        static_cast<std::uint64_t>(of_part[k]));
            }
        expect(hm_private_adjoint_finish(its_.basis, scale, sums.data(), summed.data(), &error_) ==
                   HM_OK,
               "no total");
        for (std::size_t k = 0; k < whole.size(); ++k)
            expect(whole[k] == summed[k] || (std::isnan(whole[k]) && std::isnan(summed[k])),
                   "sums of parts have other bits");
    }

    Solution& its_;
    Input& input_;
    std::size_t n_;
    hm_basis_info info_{};
    hm_error error_{};
    std::vector<std::int32_t> lists_[2];
    std::int32_t next_ = 0;
};

}  // namespace

void check_shares(Solution& whole, Input& input) { Shares(whole, input).all(); }

}  // namespace fuzz
