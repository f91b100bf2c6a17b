#include "work/storage.hpp"

#include <harmorph_bases.h>

namespace cli {

Stored::Stored(const Arguments& arguments, const Mesh& mesh, const hm_basis* solved)
    : basis_(solved) {
    if (arguments.choice("--storage", {{"double", HM_DOUBLE}, {"single", HM_SINGLE}}) == HM_DOUBLE)
        return;
    std::size_t bytes = 0;
    call(mesh, hm_single_size, solved, &bytes);
    block_.resize(bytes);
    hm_basis* single = nullptr;
    call(mesh, hm_single_init, &single, block_.data(), bytes, solved);
    basis_ = single;
}

std::size_t Stored::bytes() const {
    auto info = sized<hm_basis_info>();
    hm_basis_info_get(basis_, &info, nullptr);
    return static_cast<std::size_t>(info.bytes);
}

}  // namespace cli
