#include "basis/packed_rows.hpp"

#include "base/hash.hpp"

namespace harmorph {
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
    auto const begin = reinterpret_cast<const unsigned char*>(basis.shape.data());
    auto const end = reinterpret_cast<const unsigned char*>(basis.wall_point.data());
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
