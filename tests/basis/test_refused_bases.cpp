// Blocks that are no whole, unchanged basis of this mesh are refused with the reason.
#include <fixtures/solved.hpp>
#include <fixtures/bodies.hpp>
#include <fixtures/polygons.hpp>
#include <fixtures/single.hpp>

using namespace fixtures;
using harmorph::Index;

TEST_CASE("a basis that is truncated at any length is refused with the reason") {
    Case setup = tiny_case();
    Solved const solved(setup);
    BasisCopy whole(solved);
    REQUIRE(whole.attach() == HM_OK);
    for (std::size_t size = 0; size < whole.size(); ++size) {
        BasisCopy part(whole.data(), size);  // reading behind it would be noticed
        CHECK(part.attach() == HM_BAD_BASIS);
        bool const in_header = size < sizeof(harmorph::BasisHeader);
        CHECK(part.says(size == 0 ? "not a harmorph basis: the mark" : "truncated"));
        std::size_t const wanted = in_header ? sizeof(harmorph::BasisHeader) : whole.size();
        if (size > 0) CHECK(part.error.value == double(wanted - size));
    }
    // A longer block, such as a file with further contents, is accepted.
    std::vector<double> longer(whole.size() / 8 + 10, 3.0);
    std::memcpy(longer.data(), whole.data(), whole.size());
    const hm_basis* basis = nullptr;
    CHECK(hm_basis_attach(&basis, longer.data(), longer.size() * 8, nullptr, nullptr) == HM_OK);
}

TEST_CASE("a basis with any byte of header or contents changed is refused") {
    Case setup = tiny_case();
    Solved const solved(setup);
    BasisCopy copy(solved);
    hm_mesh const mesh = setup.mesh.view();
    REQUIRE(copy.attach(&mesh) == HM_OK);
    for (std::size_t k = 0; k < copy.size(); ++k)
        for (unsigned const flip : {1u, 0x80u, 0xFFu}) {
            copy.data()[k] = static_cast<unsigned char>(copy.data()[k] ^ flip);
            INFO("byte " << k << " flipped by " << flip);
            CHECK(copy.attach(&mesh) == HM_BAD_BASIS);
            copy.data()[k] = static_cast<unsigned char>(copy.data()[k] ^ flip);
        }
    CHECK(copy.attach(&mesh) == HM_OK);
}

TEST_CASE("each reason to refuse a basis has a sentence of its own") {
    Case setup = tiny_case();
    Solved const solved(setup);
    BasisCopy copy(solved);
    harmorph::BasisHeader const good = copy.header();

    using Header = harmorph::BasisHeader;
    std::string const format = "the basis has format version 1, but this library reads version " +
                               std::to_string(Header::current_format) + "; solve the basis again";
    auto const refused = [&](std::string const& words, auto const& change) {
        Header bad = good;
        change(bad);
        copy.set(bad);
        CHECK(copy.attach() == HM_BAD_BASIS);
        CHECK(copy.says(words.c_str()));
    };
    refused("not a harmorph basis", [](Header& h) { h.magic[0] = 'H'; });
    refused(
        "the basis was written on a machine with another byte order; solve the basis again on "
        "this machine",
        [](Header& h) { h.byte_order = 0x04030201; });
    refused(format, [](Header& h) { h.format = 1; });
    refused("truncated: 8", [](Header& h) { h.bytes += 8; });
    refused("counts in its header", [](Header& h) { h.counts.points += 1; });
    refused("checksum does not match", [](Header& h) { h.checksum ^= 1; });
    for (auto const count : {&harmorph::BasisCounts::points, &harmorph::BasisCounts::control,
                             &harmorph::BasisCounts::loops})
        for (Index const wrong : {-1, 0x7FFFFFFF, -0x7FFFFFFF - 1})  // no number overflows
            refused("counts in its header", [&](Header& h) { h.counts.*count = wrong; });
    copy.set(good);
    CHECK(copy.attach() == HM_OK);
    const hm_basis* basis = nullptr;
    CHECK(hm_basis_attach(&basis, copy.data() + 4, copy.size(), nullptr, nullptr) ==
          HM_BAD_ARGUMENT);  // misaligned
    CHECK(basis == nullptr);
}

TEST_CASE("a basis with a valid checksum but indices out of range or infinite numbers is refused") {
    Case setup = two_body_case(Cells::hybrid, 4, 3);
    Solved const solved(setup);
    hm_mesh const mesh = setup.mesh.view();
    BasisCopy copy(solved);
    harmorph::BasisHeader const good = copy.header();
    harmorph::Basis const basis = harmorph::Basis::view(static_cast<void*>(copy.data()));
    auto const attach_sealed = [&] {
        basis.header->checksum = harmorph::checksum_of(*basis.header);
        return copy.attach(&mesh);
    };
    auto const spoils = [&](auto& number, auto wrong, const char* word) {
        auto const right = number;
        number = wrong;
        CHECK(attach_sealed() == HM_BAD_BASIS);
        CHECK(copy.says(word));
        number = right;
    };
    for (std::int32_t const far : {-1, 0x7FFFFFFF}) {
        spoils(basis.indices[3], far, "data of its curves");
        spoils(basis.shape[1].first_knot, far, "data of its curves");
        spoils(basis.shape[0].n_indices, far, "data of its curves");
        spoils(basis.conditions[1].first_curve, far, "a condition is unknown");
        spoils(basis.wall_point[5], far, "data of its wall points");
        spoils(basis.wall_curve[5], far, "data of its wall points");
        spoils(basis.boundary_point[9], far, "boundary loops are inconsistent");
        spoils(basis.loop_start[1], far, "boundary loops are inconsistent");
        spoils(basis.header->filled, far, "option of its solution");
        spoils(basis.header->counts.bodies, far, "counts in its header");
        spoils(basis.header->counts.combination, far, "counts in its header");
    }
    Case cut = cut_ring();  // has points that are joined to points of the wall
    Solved const of_cut(cut);
    BasisCopy cut_copy(of_cut);
    harmorph::Basis const joined = harmorph::Basis::view(static_cast<void*>(cut_copy.data()));
    REQUIRE(joined.joined_slot.count() > 0);
    Index const n_wall = joined.wall_point.count(), n_points = joined.n_points();
    Index& slot = joined.joined_slot[0];
    Index& point = joined.joined_point[0];
    struct Joined {
        Index& number;
        Index wrong;
        bool is_refused;
    };
    for (Joined const& damage : {Joined{slot, -1, true},
                                 {slot, n_wall, true},
                                 {slot, 0x7FFFFFFF, true},
                                 {slot, n_wall - 1, false},
                                 {slot, 0, false},
                                 {point, -1, true},
                                 {point, n_points, true},
                                 {point, 0x7FFFFFFF, true},
                                 {point, n_points - 1, false}}) {
        Index const right = damage.number;
        damage.number = damage.wrong;
        joined.header->checksum = harmorph::checksum_of(*joined.header);
        CHECK(cut_copy.attach() == (damage.is_refused ? HM_BAD_BASIS : HM_OK));
        if (damage.is_refused) CHECK(cut_copy.says("data of its wall points"));
        damage.number = right;
    }
    spoils(basis.knots[4], std::nan(""), "data of its curves");
    spoils(basis.control[4], std::nan(""), "data of its curves");
    spoils(basis.wall_u[4], std::nan(""), "data of its wall points");
    spoils(basis.value[100], 1e9, "exceeds the largest value");
    spoils(basis.header->largest, 0.5, "exceeds the largest value");
    harmorph::Method& method = basis.header->method;
    spoils(method.operator_kind, harmorph::Operator{17}, "names an unknown operator, 17");
    spoils(method.scheme, harmorph::Scheme{-1}, "names an unknown scheme, -1");
    spoils(method.engine, harmorph::Engine{3}, "names an unknown engine, 3");
    CHECK(attach_sealed() == HM_OK);
    CHECK(basis.header->checksum == good.checksum);

    // Each word other than the values is refused when changed, or has no effect on where data are
    // read.
    std::int32_t* const words = reinterpret_cast<std::int32_t*>(copy.data());
    std::ptrdiff_t const n = reinterpret_cast<std::int32_t*>(basis.value.data()) - words;
    std::vector<double> const move = some_move(20, 0.1, 1);
    std::vector<double> x(setup.mesh.x.size()), y = x, gradient(40);
    int accepted = 0;
    for (std::ptrdiff_t k = sizeof(harmorph::BasisHeader) / 4; k < n; ++k)
        for (std::int32_t const wrong : {-1, 1 << 30, 0x7FF00000}) {
            std::int32_t const right = words[k];
            words[k] = wrong;
            if (attach_sealed() >= 0) {
                ++accepted;
                CHECK(hm_morph(copy.basis, move.data(), &mesh.points, points_out(x, y), nullptr,
                               nullptr) == HM_OK);
                CHECK(hm_adjoint(copy.basis, &mesh.points, gradient.data(), nullptr, nullptr) ==
                      HM_OK);
            }
            words[k] = right;
        }
    CHECK(accepted > 0);
    CHECK(accepted < 3 * n);
}

TEST_CASE("a basis with a valid checksum but polygons out of order is refused") {
    Case setup = honeycomb_case();
    setup.mesh.cell_layout = HM_CELLS_POLYGONS;
    Solved const solved(setup);
    hm_mesh const mesh = setup.mesh.view();
    BasisCopy copy(solved);
    harmorph::Basis const basis = harmorph::Basis::view(static_cast<void*>(copy.data()));
    harmorph::Pieces const& pieces = basis.pieces;
    REQUIRE(pieces.given());
    auto const refuses = [&](Index& number, Index wrong) {
        Index const right = number;
        number = wrong;
        basis.header->checksum = harmorph::checksum_of(*basis.header);
        bool const is_refused =
            copy.attach(&mesh) == HM_BAD_BASIS && copy.says("pieces of its polygonal cells");
        number = right;
        return is_refused;
    };
    Index const cell = setup.mesh.n_cells() / 2;
    CHECK(refuses(pieces.start[cell], pieces.start[cell + 1]));  // a cell without a piece
    CHECK(refuses(pieces.guard_start[cell], pieces.guard_start[cell + 1] + 1));
    basis.header->checksum = harmorph::checksum_of(*basis.header);
    CHECK(copy.attach(&mesh) == HM_OK);
}

TEST_CASE("a basis with another mesh is refused; other coordinates give a warning") {
    Case setup = tiny_case();
    Solved const solved(setup);
    BasisCopy copy(solved);

    Case other = setup;
    hm_mesh view{};
    auto const differs = [&](hm_status status, const char* words, auto const& change) {
        other = setup;
        change(other.mesh);
        view = other.mesh.view();
        CHECK(copy.attach(&view) == status);
        CHECK(copy.says(words));
    };
    differs(HM_BAD_BASIS, "another mesh, which has 48 points", [](Mesh& mesh) {
        mesh.add_point({9, 9});
    });
    differs(HM_BAD_BASIS, "the cells differ",
            [](Mesh& mesh) { std::swap(mesh.cells[0], mesh.cells[2]); });
    differs(HM_BAD_BASIS, "the markers contain other points",
            [](Mesh& mesh) { std::swap(mesh.face_markers.front(), mesh.face_markers.back()); });
    differs(HM_BAD_BASIS, "the markers contain other points", [](Mesh& mesh) {
        for (std::int32_t& marker : mesh.face_markers) marker += 7;  // the same points
    });
    differs(HM_MOVED, "the mesh has other coordinates than the mesh on which the basis was solved",
            [](Mesh& mesh) { mesh.x[20] += 1e-12; });
    differs(HM_BAD_MESH, "", [](Mesh& mesh) { mesh.x[20] = std::nan(""); });

    // Numbering, layout and stride are ways of writing the same mesh; so are the order of faces and
    // that of their ends.
    other = setup;
    std::reverse(other.mesh.faces.begin(), other.mesh.faces.end());
    std::reverse(other.mesh.face_markers.begin(), other.mesh.face_markers.end());
    view = other.mesh.view();
    CHECK(copy.attach(&view) == HM_OK);
    other = setup;
    other.index_base = 1;
    CHECK(copy.attach(&other.mesh_view()) == HM_OK);
    std::vector<std::int32_t> const quads = quads_of(setup.mesh);
    view = setup.mesh.view();
    view.cell_layout = HM_CELLS_QUADS;
    view.cell_points = quads.data();
    std::vector<double> xy;
    for (std::size_t k = 0; k < setup.mesh.x.size(); ++k)
        xy.insert(xy.end(), {setup.mesh.x[k], setup.mesh.y[k]});
    view.points = {xy.data(), xy.data() + 1, 2};
    CHECK(copy.attach(&view) == HM_OK);
}
