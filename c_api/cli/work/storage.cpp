#include "work/storage.hpp"

#include <harmorph_bases.h>

namespace cli {

const Option storage_option = {
    "--storage", "P",
    "precision of the functions in BASIS: double (default), or single: half the memory, faster "
    "morphs, values\n"
    "rounded by 2^-24 at most but exact on curves; not for --safe and transfer"};

Stored::Stored(const Arguments& arguments, const Mesh& mesh, const hm_basis* solved)
    : basis_(solved) {
    if (arguments.choice("--storage", {{"double", HM_DOUBLE}, {"single", HM_SINGLE}}) == HM_DOUBLE)
        return;
    hm_basis* single = nullptr;
    with_memory(block_, [&](hm_memory* memory) {
        return call(mesh, hm_single_init, &single, memory, solved);
    });
    basis_ = single;
}

std::size_t Stored::bytes() const {
    auto info = sized<hm_basis_info>();
    hm_basis_info_get(basis_, &info, nullptr);
    return static_cast<std::size_t>(info.bytes);
}

}  // namespace cli
