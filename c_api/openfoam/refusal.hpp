// Ends the program with what the library says, and with the names and places that OpenFOAM knows.
#ifndef HARMORPH_REFUSAL_HPP
#define HARMORPH_REFUSAL_HPP

#include "gathered_mesh.hpp"
#include "wordList.H"

#include <vector>

namespace Foam {

// Makes a call that takes memory: make(&memory) first asks for the size, and is made again with the
// block. Returns the status of the last of the two.
template <class Make>
hm_status with_memory(std::vector<unsigned char>& block, const Make& make) {
    hm_memory memory = {};
    const hm_status status = make(&memory);
    if (status < 0) return status;
    block.resize(memory.bytes);
    memory.block = block.data();
    return make(&memory);
}

class Refusal {
public:
    Refusal(const GatheredMesh& mesh, const wordList& patches) : mesh_(mesh), patches_(patches) {}
    // After this call, numbers of points and cells in errors are those of the mesh of the plane.
    void set_plane(const hm_plane_info& info) { info_ = info; }

    // Ends the program if the status is negative; `what` says what was to be done.
    void check(hm_status status, const char* what, const hm_error& error) const;
    void refuse(const char* what, const hm_error& error) const;
    // The place of a point or of the first corner of a cell of the plane, from 0, before any
    // movement.
    point point_at(label number) const;
    point cell_at(label number) const;

private:
    string place_of(std::int32_t kind, label number) const;

    const GatheredMesh& mesh_;
    wordList patches_;
    hm_plane_info info_ = {};
};

}  // namespace Foam

#endif
