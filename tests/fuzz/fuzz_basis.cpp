// The block of a solved basis, in double or single precision, damaged anywhere, through every call
// that takes a basis. Either any bytes are changed, or one number of one of the arrays of indices,
// which are few among the values. A damaged block is refused by its checksum; half of them are
// sealed again by the library's own checksum, so that what lies behind it is tested, too.
#include <harmorph_bases.h>
#include <harmorph_design.h>
#include "private.h"
#include <harmorph_study.h>
#include "solution.hpp"
#include "target.hpp"

#include "basis/basis.hpp"

#include <iterator>
#include <fixtures/memory.hpp>

namespace fuzz {
namespace {

// Restores the problem from a basis as a caller does; the markers and the numbers of the conditions
// may have any values.
void restore(hm_curves const& curves, const hm_condition* conditions, std::int32_t n,
             Problem const& problem) {
    hm_problem restored = sized<hm_problem>();
    restored.mesh = &problem.mesh;
    restored.curves = curves.n_curves > 0 ? &curves : nullptr;
    restored.n_conditions = n;
    restored.conditions = conditions;
    hm_error error{};
    std::size_t bytes = 0;
    hm_status status = fixtures::analysis_size(&restored, nullptr, &bytes, &error);
    expect_told(status, error);
    if (status < 0 || bytes > 1 << 24) return;
    Block const block(bytes, 0, 0x7F);
    hm_analysis* analysis = nullptr;
    status = hm_analysis_init(&analysis, fixtures::Memory(block.data(), bytes), &restored, nullptr,
                              &error);
    expect_told(status, error);
}

// One number in one of the arrays of indices.
void spoil_index(harmorph::Basis const& basis, Input& input) {
    harmorph::Span<harmorph::Index> const arrays[] = {
        basis.indices,
        basis.wall_point,
        basis.wall_curve,
        basis.joined_point,
        basis.joined_slot,
        basis.boundary_point,
        basis.loop_start,
        basis.pieces.start,
        basis.pieces.guard_start,
        basis.pieces.point,
        // structs of indices
        {reinterpret_cast<harmorph::Index*>(basis.shape.data()), 4 * basis.shape.size()},
        {reinterpret_cast<harmorph::Index*>(basis.conditions.data()),
         sizeof(harmorph::Condition) / sizeof(harmorph::Index) * basis.conditions.size()}};
    std::vector<harmorph::Span<harmorph::Index>> filled;
    for (harmorph::Span<harmorph::Index> const& one : arrays)
        if (!one.empty()) filled.push_back(one);
    harmorph::Span<harmorph::Index> const array =
        filled[input.below(static_cast<std::uint32_t>(filled.size()))];
    harmorph::Index& number = array[input.from(0, array.count() - 1)];
    number = input.one_in(2) ? input.wild_index() : number + input.any_of({-1, 1, 2, 16, 1000});
}

// Every call with a basis that was attached: it may refuse, or compute anything, but touch no
// memory of others.
void use(const hm_basis* basis, Problem const& problem, Input& input) {
    hm_basis_info info = sized<hm_basis_info>();
    hm_error error{};
    if (hm_basis_info_get(basis, &info, &error) < 0) return;
    expect(info.points >= 0 && info.points < 1 << 20 && info.functions >= 0,
           "sizes that the block cannot hold");
    if (info.functions > 1 << 16)
        return;  // of a share, which holds few of the functions that it claims there are
    std::size_t const n = at(info.points), pairs = 2 * at(info.functions);
    std::vector<double> move(pairs + 2), x(n + 1), y(n + 1), gradient(pairs + 2);
    for (double& number : move) number = input.between(-1, 1);
    hm_points_out const out{x.data(), y.data(), 1};
    hm_points const in{x.data(), y.data(), 1};
    hm_morph(basis, move.data(), nullptr, &out, nullptr, &error);
    hm_adjoint(basis, &in, gradient.data(), nullptr, &error);
    double worst = 0;
    hm_boundary_error(basis, move.data(), &in, &in, &worst, nullptr, &error);
    std::size_t work_bytes = 0;
    if (fixtures::recover_movement_size(basis, &work_bytes, &error) >= 0 && work_bytes < 1 << 24) {
        Block const work(work_bytes, 0, 0x3F);
        hm_recover_movement(basis, &in, 0, gradient.data(), nullptr,
                            fixtures::Memory(work.data(), work_bytes), &error);
        work.expect_intact();
    }
    std::vector<hm_curve> curves(at(info.curves) + 1);
    hm_curves set = sized<hm_curves>();
    for (hm_curve& curve : curves) curve.struct_size = sizeof curve;
    if (hm_basis_curves(basis, nullptr, nullptr, &set, curves.data(), info.curves, &error) >= 0 &&
        set.n_curves > 0) {
        double xy[4], u, distance;
        for (std::int32_t c = 0; c < set.n_curves; ++c) {
            hm_curve_point(&set, c, input.between(-1, 10), 1, xy, &error);
            hm_curve_project(&set, c, input.between(-1, 1), input.between(-1, 1), &u, &distance,
                             &error);
        }
    }
    hm_condition conditions[16];
    conditions[0].struct_size = sizeof conditions[0];
    std::int32_t n_conditions = 0;
    if (hm_basis_conditions(basis, conditions, 16, &n_conditions, &error) >= 0)
        restore(set, conditions, n_conditions, problem);
    if (info.functions > 0)
        hm_basis_values(basis, input.from(0, info.functions - 1), 0, x.data(), &error);
    hm_step_report step = sized<hm_step_report>();
    hm_quality_report quality = sized<hm_quality_report>();
    hm_assess(basis, &problem.mesh, nullptr, &in, nullptr, nullptr, &step, &quality, &error);
    std::size_t bytes = 0;
    if (fixtures::single_size(basis, &bytes, &error) >= 0 && bytes < 1 << 24) {
        Block const block(bytes, 0, 0xFF);
        hm_basis* single = nullptr;
        if (hm_single_init(&single, fixtures::Memory(block.data(), bytes), basis, &error) >= 0) {
            hm_morph(single, move.data(), nullptr, &out, nullptr, &error);
            hm_adjoint(single, &in, gradient.data(), nullptr, &error);
            if (info.functions > 0) hm_basis_values(single, 0, 0, x.data(), &error);
        }
    }
    std::int32_t const few[] = {problem.mesh.index_base, info.points - 1 + problem.mesh.index_base,
                                0, 1};
    if (hm_private_extract_size(basis, 4, &bytes, &error) >= 0 && bytes < 1 << 24) {
        Block const block(bytes, 0, 0x7F);
        hm_basis* rows = nullptr;
        if (hm_private_extract_init(&rows, block.data(), bytes, basis, 4, few, &error) >= 0)
            hm_morph(rows, move.data(), nullptr, &out, nullptr, &error);
    }
}

}  // namespace

Outcome run_basis(Input& input) {
    std::unique_ptr<Problem> const problem = make_problem(input);
    Solution solution(*problem, input);
    if (solution.status < 0) return Outcome::refused;
    hm_basis_info info = sized<hm_basis_info>();
    expect(hm_basis_info_get(solution.basis, &info, nullptr) == HM_OK,
           "no information about a solved basis");

    const hm_basis* good = solution.basis;
    std::size_t bytes = 0;
    hm_error error{};
    if (input.one_in(2) && fixtures::single_size(good, &bytes, &error) >= 0) {
        hm_basis* single = nullptr;
        if (hm_single_init(&single, fixtures::Memory(solution.blocks.take(bytes).data(), bytes),
                           good, &error) >= 0)
            good = single;
        expect(hm_basis_info_get(good, &info, nullptr) == HM_OK,
               "no information about a basis in single precision");
    }
    Block const copy(info.bytes, 8 * input.below(8) + (8 - info.bytes % 8) % 8, 0);
    std::memcpy(copy.data(), static_cast<const void*>(good), info.bytes);
    bytes = info.bytes;
    const hm_basis* attached = nullptr;
    hm_status status = hm_basis_attach(&attached, copy.data(), bytes, &problem->mesh, &error);
    expect(status == HM_OK, std::string("a copy of a basis is refused: ") + error.text);

    bool const cut = input.one_in(4);
    if (cut) bytes -= 1 + input.below(static_cast<std::uint32_t>(bytes));
    std::size_t const of_header = 256;
    bool const one_index = !cut && input.one_in(2);
    if (one_index) spoil_index(harmorph::Basis::view(static_cast<void*>(copy.data())), input);
    for (std::int32_t k = one_index ? 0 : input.from(cut ? 0 : 1, 4); k > 0; --k) {
        std::size_t const most = input.one_in(2) ? std::min(of_header, info.bytes) : info.bytes;
        std::size_t const at = input.below(static_cast<std::uint32_t>(most));
        copy.data()[at] = static_cast<unsigned char>(
            input.one_in(2) ? copy.data()[at] ^ 1u << input.below(8) : input.below(256));
    }
    bool const sealed = one_index || (!cut && input.one_in(2));
    bool const same = std::memcmp(copy.data(), static_cast<const void*>(good), info.bytes) == 0;
    if (sealed) {
        harmorph::BasisHeader& header = *reinterpret_cast<harmorph::BasisHeader*>(copy.data());
        header.bytes = info.bytes;  // the checksum reads as far
        header.checksum = harmorph::checksum_of(header);
    }
    status = hm_basis_attach(&attached, copy.data(), bytes,
                             input.one_in(2) ? &problem->mesh : nullptr, &error);
    expect_told(status, error);
    if (!sealed && (cut || !same)) expect(status == HM_BAD_BASIS, "a damaged basis is taken");
    if (status < 0) return Outcome::refused;
    use(attached, *problem, input);
    return Outcome::done;
}

}  // namespace fuzz
