// The precision in which a basis is kept in its file: an option of every command that makes one.
#pragma once

#include "basics/arguments.hpp"
#include "basics/library.hpp"

namespace cli {

extern const Option storage_option;

// The basis as it is, or in single precision in a block of its own.
class Stored {
public:
    Stored(const Arguments& arguments, const Mesh& mesh,
           const hm_basis* solved);  // the basis must outlive it

    const hm_basis* basis() const { return basis_; }
    std::size_t bytes() const;
    bool in_single() const { return block_.size() > 0; }

private:
    Block block_;
    const hm_basis* basis_;
};

}  // namespace cli
