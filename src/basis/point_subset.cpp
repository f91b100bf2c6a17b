#include "basis/point_subset.hpp"

#include "base/hash.hpp"
#include "base/sort.hpp"

namespace harmorph {
namespace {

BasisCounts counts_of(Basis const& whole, Index points, Index wall, Index shared) noexcept {
    BasisCounts counts = whole.header->counts;
    counts.points = points;
    counts.wall = wall;
    counts.shared = shared;
    counts.cells = counts.pieces = counts.guards = counts.boundary = counts.loops = 0;
    return counts.share(0, counts.functions());
}

}  // namespace

Status PointList::check(Index n_points, Fault& fault) const noexcept {
    HARMORPH_TRY(check_length(count(), fault));
    for (Index k = 0; k < count(); ++k) {
        Offset const number = Offset{point[k]} - index_base;
        if (number >= 0 && number < n_points) continue;
        return fault.refuse(Status::bad_argument,
                            "entry # of the list names point @, which is not in the mesh",
                            entry_item(k), {ItemKind::point, number});
    }
    return Status::ok;
}

std::uint64_t PointList::fingerprint(Basis const& from) const noexcept {
    bool is_all = count() == from.n_points();
    Hash hash;
    hash.add(from.header->list);
    for (Index k = 0; k < count(); ++k) {
        is_all = is_all && (*this)[k] == k;
        hash.add(static_cast<std::uint64_t>((*this)[k]));
    }
    return is_all ? from.header->list : hash.value();
}

Status PointList::check_length(Index n, Fault& fault) noexcept {
    if (n >= 0 && n <= max_count) return Status::ok;
    return fault.refuse(Status::bad_argument,
                        "the list has # points, but a list may have 0 to @ points", plain(n),
                        plain(max_count));
}

void Extract::take_work(Arena& arena, Basis const& whole) noexcept {
    Index const n_wall = whole.wall_point.count();
    arena.take(wall, n_wall + whole.joined_point.count());
    arena.take(position, n_wall);
    arena.take(slot, n_wall);
}

// The number of wall points in the list, and of repeated ones, is known only when the list is read.
// The most memory is needed if the list names all wall points once. Where a few repeated points
// replace them, other arrays may cross the limit of a cache line, which takes a few more lines.
void Extract::count(Arena& arena, Basis const& whole, Index n_points) noexcept {
    constexpr Index spare = 24;
    Extract bound;
    bound.take_work(arena, whole);
    BasisCounts counts = counts_of(whole, n_points, min(n_points, whole.wall_point.count()),
                                   whole.shared_slot.count());
    counts.joined = n_points - counts.wall + spare;
    bound.basis.lay_out(arena, counts);
}

void Extract::lay_out(Arena& arena, Basis const& whole, PointList const& list) noexcept {
    take_work(arena, whole);
    if (arena.overflown()) return;
    find_wall_points(whole, list);
    Index n_wall = 0, n_joined = 0, n_shared = 0;
    for (Index const first : position) n_wall += first != none ? 1 : 0;
    for_each_joined(list, [&](Index, Index) { ++n_joined; });
    for (Index const whole_slot : whole.shared_slot) n_shared += slot[whole_slot] != none ? 1 : 0;
    BasisCounts counts = counts_of(whole, list.count(), n_wall, n_shared);
    counts.joined = n_joined;
    basis.lay_out(arena, counts);
    if (arena.overflown()) return;
    std::memset(static_cast<void*>(basis.header), 0, Basis::bytes(counts));
    basis.header->counts = counts;
}

Index Extract::slot_of(Index point) const noexcept {
    Index begin = 0, end = wall.count();
    while (begin < end) {
        Index const middle = begin + (end - begin) / 2;
        if (wall[middle].point < point) begin = middle + 1;
        else end = middle;
    }
    return begin < wall.count() && wall[begin].point == point ? wall[begin].slot : none;
}

void Extract::find_wall_points(Basis const& whole, PointList const& list) const noexcept {
    Index const n_wall = whole.wall_point.count();
    for (Index k = 0; k < n_wall; ++k) wall[k] = {whole.wall_point[k], k};
    for (Index k = 0; k < whole.joined_point.count(); ++k) {
        wall[n_wall + k] = {whole.joined_point[k], whole.joined_slot[k]};
    }
    sort(wall, [](WallPoint const& a, WallPoint const& b) { return a.point < b.point; });
    fill(position, none);
    for (Index k = 0; k < list.count(); ++k) {
        Index const whole_slot = slot_of(list[k]);
        if (whole_slot != none && position[whole_slot] == none) position[whole_slot] = k;
    }
    Index n = 0;  // The slots are in the order of the boundary.
    for (Index k = 0; k < n_wall; ++k) slot[k] = position[k] != none ? n++ : none;
}

template <class Body>
void Extract::for_each_joined(PointList const& list, Body const& body) const noexcept {
    for (Index k = 0; k < list.count(); ++k) {
        Index const whole_slot = slot_of(list[k]);
        if (whole_slot != none && position[whole_slot] != k) body(k, whole_slot);
    }
}

void Extract::init(Basis const& whole, PointList const& list) const noexcept {
    BasisHeader const counted = *basis.header;
    *basis.header = *whole.header;
    basis.header->counts = counted.counts;
    basis.header->bytes = Basis::bytes(counted.counts);
    basis.header->list = list.fingerprint(whole);
    basis.header->filled = 0;
    basis.unseal();
    copy(basis.shape, Span<const Basis::CurveShape>(whole.shape));
    copy(basis.indices, Span<const Index>(whole.indices));
    copy(basis.knots, Span<const Real>(whole.knots));
    copy(basis.control, Span<const Real>(whole.control));
    copy(basis.weights, Span<const Real>(whole.weights));
    copy(basis.combination, Span<const Real>(whole.combination));
    copy(basis.conditions, Span<const Condition>(whole.conditions));
    basis.along.copy_from(whole.along);
    for (Index whole_slot = 0; whole_slot < slot.count(); ++whole_slot) {
        if (slot[whole_slot] == none) continue;
        basis.wall_point[slot[whole_slot]] = position[whole_slot];
        basis.wall_curve[slot[whole_slot]] = whole.wall_curve[whole_slot];
        basis.wall_u[slot[whole_slot]] = whole.wall_u[whole_slot];
        basis.wall_offset[slot[whole_slot]] = whole.wall_offset[whole_slot];
        basis.wall_start[slot[whole_slot]] = whole.wall_start[whole_slot];
    }
    Index n = 0;
    for (Index k = 0; k < whole.shared_slot.count(); ++k) {
        Index const own = slot[whole.shared_slot[k]];
        if (own == none) continue;
        basis.shared_point[n] = basis.wall_point[own];
        basis.shared_condition[2 * n] = whole.shared_condition[2 * k];
        basis.shared_condition[2 * n + 1] = whole.shared_condition[2 * k + 1];
        basis.shared_place[n] = whole.shared_place[k];
        basis.shared_slot[n++] = own;
    }
    n = 0;
    for_each_joined(list, [&](Index k, Index whole_slot) {
        basis.joined_point[n] = k;
        basis.joined_slot[n++] = slot[whole_slot];
    });
}

void Extract::copy_rows(Basis const& whole, PointList const& list) const noexcept {
    Index const length = basis.row_length();
    if (basis.in_single()) {
        for (Index k = 0; k < list.count(); ++k)
            copy_row(basis.single_row(k), whole.single_row(list[k]), length);
        for (Index whole_slot = 0; whole_slot < slot.count(); ++whole_slot) {
            if (slot[whole_slot] != none)
                copy_row(basis.row(slot[whole_slot]), whole.row(whole_slot), length);
        }
    } else {
        for (Index k = 0; k < list.count(); ++k) copy_row(basis.row(k), whole.row(list[k]), length);
    }
    basis.header->filled = basis.n_functions();
    basis.seal(whole.header->largest);
}

namespace {

// Two bases of one mesh with the same conditions have the same functions if this fingerprint is
// equal, too.
std::uint64_t functions_of(Basis const& basis) noexcept {
    BasisCounts const& counts = basis.header->counts;
    Method const& method = basis.header->method;
    std::int32_t const numbers[] = {static_cast<std::int32_t>(method.operator_kind),
                                    static_cast<std::int32_t>(method.scheme),
                                    method.exponent_quarters,
                                    method.offset_correction,
                                    counts.bodies,
                                    counts.combined,
                                    counts.combination,
                                    counts.modes};
    Hash hash;
    for (std::int32_t const number : numbers) hash.add(static_cast<std::uint32_t>(number));
    // The hash includes curves, combination and conditions, in this order.
    const auto* const begin = reinterpret_cast<const unsigned char*>(basis.shape.data());
    const auto* const end = reinterpret_cast<const unsigned char*>(basis.wall_point.data());
    hash.add(hash_of_words(begin, static_cast<Size>(end - begin) / 8));
    return hash.value();
}

ParcelLabel label_of(Basis const& share, PointList const& list) noexcept {
    BasisHeader const& header = *share.header;
    BasisCounts const& counts = header.counts;
    return {ParcelLabel::mark,       header.topology,     header.coordinates,     header.conditions,
            list.fingerprint(share), functions_of(share), header.largest,         list.count(),
            counts.first_stored,     counts.stored,       numbers_of(counts.kind)};
}

// Checks that the parcel contains the functions that the rows need next.
Status check_label(ParcelLabel const& label, Basis const& rows, Fault& fault) noexcept {
    BasisHeader const& header = *rows.header;
    if (!(header.topology == label.topology) || header.conditions != label.conditions ||
        header.coordinates != label.coordinates ||
        label.numbers != numbers_of(header.counts.kind) || label.functions != functions_of(rows)) {
        return fault.refuse(Status::bad_basis,
                            "the parcel comes from a basis of another problem: mesh, conditions, "
                            "curves or method differ");
    }
    if (label.points != rows.n_points()) {
        return fault.refuse(Status::bad_basis,
                            "the parcel contains the rows of # points, but the basis has @ points",
                            plain(label.points), plain(rows.n_points()));
    }
    if (label.list != header.list) {
        return fault.refuse(
            Status::bad_basis,
            "the parcel was packed for another list of points than the list of the rows");
    }
    if (!header.counts.complete()) {
        return fault.refuse(
            Status::bad_basis,
            "a parcel needs rows of all functions, but these rows have a share of the functions");
    }
    if (header.solved == 1)
        return fault.refuse(Status::bad_basis,
                            "the rows already contain all functions, so no parcel can be added");
    if (label.first != header.filled || label.n < 0 || label.n > rows.n_functions() - label.first) {
        return fault.refuse(Status::bad_basis,
                            "the parcel begins with function #, but the next function to add is @",
                            function_item(label.first), function_item(header.filled));
    }
    return Status::ok;
}

}  // namespace

void pack_parcel(Basis const& share, PointList const& list, Real* parcel) noexcept {
    ParcelLabel const label = label_of(share, list);
    std::memcpy(parcel, &label, sizeof label);
    Index const length = share.row_length();
    Real* to = parcel + label_words;
    for (Index k = 0; k < list.count(); ++k, to += length) copy_row(to, share.row(list[k]), length);
}

Status unpack_parcel(Basis const& rows, const Real* parcel, Offset words, Fault& fault) noexcept {
    ParcelLabel label;
    if (words < label_words)
        return fault.refuse(Status::bad_basis,
                            "the parcel is truncated: it is shorter than its label");
    std::memcpy(static_cast<void*>(&label), parcel, sizeof label);
    if (label.magic != ParcelLabel::mark)
        return fault.refuse(
            Status::bad_basis,
            "the data are not a parcel of rows: the mark at their start is missing");
    HARMORPH_TRY(check_label(label, rows, fault));
    Offset const length = Offset{label.numbers} * label.n;
    if (words != label_words + label.points * length)
        return fault.refuse(
            Status::bad_basis,
            "the length of the parcel does not fit the rows that its label announces");

    const Real* from = parcel + label_words;
    for (Index k = 0; k < label.points; ++k) {
        auto const row = rows.row(k);
        for (Index plane = 0; plane < label.numbers; ++plane, from += label.n) {
            for (Index i = 0; i < label.n; ++i)
                row[plane * rows.n_functions() + label.first + i] = from[i];
        }
    }
    BasisHeader& header = *rows.header;
    header.filled += label.n;
    header.largest = max(header.largest, label.largest);
    if (header.filled == rows.n_functions()) rows.seal(header.largest);
    return Status::ok;
}

}  // namespace harmorph
