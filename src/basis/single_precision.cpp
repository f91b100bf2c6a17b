#include "basis/single_precision.hpp"

#include <cstring>

namespace harmorph {
namespace {

constexpr Real largest_float = 0x1.fffffep+127;

// Copies the data between header and values, which are the same in both.
void copy_problem(Basis const& from, Basis const& to) noexcept {
    auto const begin = reinterpret_cast<const unsigned char*>(from.shape.data());
    auto const end = reinterpret_cast<const unsigned char*>(from.value.data());
    std::memcpy(to.shape.data(), begin, static_cast<Size>(end - begin));
}

}  // namespace

BasisCounts single_counts(Basis const& from) noexcept {
    BasisCounts counts = from.header->counts;
    counts.storage = Precision::in_single;
    return counts;
}

Status store_single(Basis const& from, Basis const& to, Fault& fault) noexcept {
    // This is the largest value of the whole basis even if `from` is a share of it, so it is kept.
    Real const largest = from.header->largest;
    if (!(largest <= largest_float)) {
        return fault.refuse(
            Status::unsupported,
            "a value of the functions, ~, is too large for single precision, which ends at 3.4e38",
            {}, {}, largest);
    }
    BasisCounts const counts = single_counts(from);
    std::memset(static_cast<void*>(to.header), 0, Basis::bytes(counts));
    *to.header = *from.header;
    to.header->counts = counts;
    to.header->bytes = Basis::bytes(counts);
    copy_problem(from, to);
    Index const length = from.row_length();
    for (Size k = 0; k < from.value.size(); ++k) to.single[k] = static_cast<float>(from.value[k]);
    auto const clear = [&](Index point) {
        auto const row = to.single_row(point);
        for (Index k = 0; k < length; ++k) row[k] = 0;
    };
    for (Index slot = 0; slot < from.wall_point.count(); ++slot) {
        copy_row(to.row(slot), from.row(from.wall_point[slot]), length);
        clear(from.wall_point[slot]);
    }
    for (Index const point : from.joined_point) clear(point);
    to.seal(max(largest, static_cast<Real>(static_cast<float>(largest))));
    return Status::ok;
}

}  // namespace harmorph
