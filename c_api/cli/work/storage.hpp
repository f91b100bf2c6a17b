// The option of all commands that make a basis for the precision of the functions in the file.
#pragma once

#include "basics/library.hpp"
#include "mesh/mesh_file.hpp"
#include "options/arguments.hpp"

namespace cli {

// A basis as it was solved, or a copy in single precision in a separate block.
class Stored {
public:
    Stored(const Arguments& arguments, const Mesh& mesh,
           const hm_basis* solved);  // the basis must outlive this object

    const hm_basis* basis() const { return basis_; }
    std::size_t bytes() const;
    bool in_single() const { return block_.size() > 0; }

private:
    Block block_;
    const hm_basis* basis_;
};

}  // namespace cli
