// A basis is one relocatable block: whole and its own, or refused with the reason.
#include <doctest/doctest.h>

#include <fixtures/bodies.hpp>

#include <harmorph/basis/basis.hpp>

#include <cstdio>

using namespace fixtures;

namespace {

// A copy of the block at an address of its own, aligned to 8 bytes and to nothing larger.
class Copy {
public:
    Copy(const void* from, std::size_t bytes) : block_(bytes, 8) { std::memcpy(block_.data(), from, bytes); }
    explicit Copy(Solved const& solved) : Copy(solved.basis, static_cast<std::size_t>(solved.info().bytes)) {}

    unsigned char* data() { return block_.data(); }
    std::size_t size() const { return block_.size(); }
    harmorph::BasisHeader header() {
        harmorph::BasisHeader out;
        std::memcpy(static_cast<void*>(&out), data(), sizeof out);
        return out;
    }
    void set(harmorph::BasisHeader const& header) { std::memcpy(data(), &header, sizeof header); }

    hm_status attach(const hm_mesh* mesh = nullptr) { return attach_part(size(), mesh); }
    hm_status attach_part(std::size_t bytes, const hm_mesh* mesh = nullptr) {
        basis = nullptr;
        error = hm_error{};
        hm_status const status = hm_basis_attach(&basis, data(), bytes, mesh, &error);
        CHECK((basis != nullptr) == (status >= 0));
        CHECK(error.code == status);
        CHECK((status == HM_OK) == (error.text[0] == '\0'));
        return status;
    }
    bool says(const char* word) const { return std::string(error.text).find(word) != std::string::npos; }

    const hm_basis* basis = nullptr;
    hm_error error{};

private:
    Guarded block_;
};

}  // namespace

TEST_CASE("a copy at another address is the same basis") {
    Case its = two_body_case();
    std::vector<double> expected, moved_x(its.mesh.x.size()), moved_y(its.mesh.x.size());
    std::vector<double> const move = some_move(20, 0.1, 1);
    std::unique_ptr<Copy> copy;
    {
        Solved const solved(its);
        expected = solved.all_values();
        REQUIRE(hm_morph(solved.basis, move.data(), points_in(its.mesh.x, its.mesh.y), points_out(moved_x, moved_y),
                         nullptr, nullptr) == HM_OK);
        copy = std::make_unique<Copy>(solved);
    }   // the original, its plan and its analysis are gone
    hm_mesh const mesh = its.mesh.view();
    REQUIRE(copy->attach(&mesh) == HM_OK);
    std::vector<double> values, x(its.mesh.x.size()), y(its.mesh.x.size());
    for (std::int32_t i = 0; i < 20; ++i) {
        REQUIRE(hm_basis_values(copy->basis, i, 0, x.data(), nullptr) == HM_OK);
        values.insert(values.end(), x.begin(), x.end());
    }
    CHECK(same_bits(values, expected));
    REQUIRE(hm_morph(copy->basis, move.data(), points_in(its.mesh.x, its.mesh.y), points_out(x, y), nullptr, nullptr) ==
            HM_OK);
    CHECK(same_bits(x, moved_x));
    CHECK(same_bits(y, moved_y));
    double error = 1;
    CHECK(hm_boundary_error(copy->basis, move.data(), points_in(its.mesh.x, its.mesh.y), points_in(x, y), &error,
                            nullptr, nullptr) == HM_OK);
    CHECK(error < 1e-14);
}

TEST_CASE("it gives back the curves, the points and the parameters it was solved with") {
    Case its = two_body_case();
    its.curves.index_base = 1;
    for (CurveSet::Shape& shape : its.curves.shapes)
        for (std::int32_t& index : shape.indices) ++index;
    for (int k = 0; k < 20; ++k) its.curves.weights.push_back(1 + 0.01 * k);
    Solved const solved(its);
    hm_curves set{};
    set.struct_size = sizeof set;
    hm_curve shape[2];
    CHECK(hm_basis_curves(solved.basis, &set, shape, 1, nullptr) == HM_BAD_ARGUMENT);
    REQUIRE(hm_basis_curves(solved.basis, &set, shape, 2, nullptr) == HM_OK);
    CHECK(hm_curves_check(&set, nullptr) == HM_OK);
    CHECK(set.n_curves == 2);
    CHECK(set.n_control == 20);
    CHECK(set.index_base == 0);
    CHECK(set.curve == shape);
    CHECK(same_bits({set.control, set.control + 40}, its.curves.control));
    CHECK(same_bits({set.weights, set.weights + 20}, its.curves.weights));
    for (std::size_t c = 0; c < 2; ++c) {
        CurveSet::Shape const& own = its.curves.shapes[c];
        CHECK(shape[c].degree == own.degree);
        CHECK(same_bits({shape[c].knots, shape[c].knots + own.knots.size()}, own.knots));
        for (std::size_t k = 0; k < own.indices.size(); ++k) CHECK(shape[c].indices[k] == own.indices[k] - 1);
    }
    hm_basis_info const info = solved.info();
    CHECK(info.solved == 1);
    CHECK(info.points == its.mesh.n_points());
    CHECK(info.cells == its.mesh.n_cells());
    CHECK(info.functions == 20);
    CHECK(info.curves == 2);
    CHECK(info.curve_points == 96);
    CHECK(info.numbers_per_value == 1);
    CHECK(info.operator_kind == HM_LAPLACE);
    CHECK(info.scheme == HM_COMPACT);
    CHECK(info.engine == HM_DIRECT);
    for (std::int32_t k = 0; k < info.curve_points; ++k) {
        double xy[2];
        REQUIRE(hm_curve_point(&set, info.point_curve[k], info.point_u[k], 0, xy, nullptr) == HM_OK);
        Point const p = its.mesh.point(info.curve_point[k]);
        CHECK(distance(p, {xy[0], xy[1]}) < 0.05);
    }
}

TEST_CASE("moved curves: control points plus their movement, all else as it was") {
    Case its = airfoil_case();
    Solved const solved(its);
    auto const n = static_cast<std::size_t>(solved.info().functions);
    std::vector<double> move = some_move(static_cast<std::int32_t>(n), 0.1, 5), control(2 * n, 7);
    hm_curves before{}, after{};
    before.struct_size = after.struct_size = sizeof before;
    hm_curve shape[2], moved[2];
    REQUIRE(hm_basis_curves(solved.basis, &before, shape, 2, nullptr) == HM_OK);
    REQUIRE(hm_moved_curves(solved.basis, move.data(), control.data(), &after, moved, 2, nullptr) == HM_OK);
    CHECK(hm_curves_check(&after, nullptr) == HM_OK);
    CHECK(after.control == control.data());
    CHECK(after.weights == before.weights);
    CHECK(after.n_curves == before.n_curves);
    for (std::size_t k = 0; k < 2 * n; ++k) CHECK(control[k] == before.control[k] + move[k]);
    for (std::int32_t c = 0; c < after.n_curves; ++c) CHECK(moved[c].knots == shape[c].knots);
    // The wall is where it was, plus what hm_morph moves it by.
    std::vector<double> x(its.mesh.x), y(its.mesh.y);
    REQUIRE(hm_morph(solved.basis, move.data(), points_in(x, y), points_out(x, y), nullptr, nullptr) == HM_OK);
    hm_basis_info const info = solved.info();
    for (std::int32_t k = 0; k < info.curve_points; ++k) {
        double from[2], to[2];
        REQUIRE(hm_curve_point(&before, info.point_curve[k], info.point_u[k], 0, from, nullptr) == HM_OK);
        REQUIRE(hm_curve_point(&after, info.point_curve[k], info.point_u[k], 0, to, nullptr) == HM_OK);
        auto const point = static_cast<std::size_t>(info.curve_point[k]);
        CHECK(std::abs(x[point] - its.mesh.x[point] - (to[0] - from[0])) < 1e-13);
        CHECK(std::abs(y[point] - its.mesh.y[point] - (to[1] - from[1])) < 1e-13);
    }
    // Refused, with outputs as they were.
    std::vector<double> const kept = control;
    move[3] = std::nan("");
    CHECK(hm_moved_curves(solved.basis, move.data(), control.data(), &after, moved, 2, nullptr) == HM_BAD_ARGUMENT);
    move[3] = 0;
    CHECK(hm_moved_curves(solved.basis, move.data(), control.data(), &after, moved, 0, nullptr) == HM_BAD_ARGUMENT);
    CHECK(hm_moved_curves(solved.basis, nullptr, control.data(), &after, moved, 2, nullptr) == HM_BAD_ARGUMENT);
    CHECK(hm_moved_curves(solved.basis, move.data(), nullptr, &after, moved, 2, nullptr) == HM_BAD_ARGUMENT);
    CHECK(same_bits(control, kept));
}

TEST_CASE("truncated at any length: refused, and the reason is given") {
    Case its = tiny_case();
    Solved const solved(its);
    Copy whole(solved);
    REQUIRE(whole.attach() == HM_OK);
    for (std::size_t size = 0; size < whole.size(); ++size) {
        Copy part(whole.data(), size);   // reading behind it would be noticed
        CHECK(part.attach() == HM_BAD_BASIS);
        bool const in_header = size < sizeof(harmorph::BasisHeader);
        CHECK(part.says(size == 0 ? "not a harmorph basis" : "truncated"));
        std::size_t const wanted = in_header ? sizeof(harmorph::BasisHeader) : whole.size();
        if (size > 0) CHECK(part.error.value == static_cast<double>(wanted - size));
    }
    // A longer block, as a file with something behind it, is none of its business.
    std::vector<double> longer(whole.size() / 8 + 10, 3.0);
    std::memcpy(longer.data(), whole.data(), whole.size());
    const hm_basis* basis = nullptr;
    CHECK(hm_basis_attach(&basis, longer.data(), longer.size() * 8, nullptr, nullptr) == HM_OK);
}

TEST_CASE("any byte changed, of the header or behind it: refused") {
    Case its = tiny_case();
    Solved const solved(its);
    Copy copy(solved);
    hm_mesh const mesh = its.mesh.view();
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

TEST_CASE("each reason has its own sentence") {
    Case its = tiny_case();
    Solved const solved(its);
    Copy copy(solved);
    harmorph::BasisHeader const good = copy.header();

    harmorph::BasisHeader bad = good;
    bad.magic[0] = 'H';
    copy.set(bad);
    CHECK(copy.attach() == HM_BAD_BASIS);
    CHECK(copy.says("not a harmorph basis"));
    bad = good;
    bad.byte_order = 0x04030201;
    copy.set(bad);
    CHECK(copy.attach() == HM_BAD_BASIS);
    CHECK(copy.says("byte order"));
    bad = good;
    bad.format = 1;
    copy.set(bad);
    CHECK(copy.attach() == HM_BAD_BASIS);
    CHECK(copy.says("format version 1"));
    bad = good;
    bad.bytes += 8;
    copy.set(bad);
    CHECK(copy.attach() == HM_BAD_BASIS);
    CHECK(copy.says("truncated: 8"));
    bad = good;
    bad.counts.points += 1;
    copy.set(bad);
    CHECK(copy.attach() == HM_BAD_BASIS);
    CHECK(copy.says("contradict"));
    for (harmorph::Index harmorph::BasisCounts::*count :
         {&harmorph::BasisCounts::points, &harmorph::BasisCounts::control, &harmorph::BasisCounts::loops}) {
        for (harmorph::Index const wrong : {-1, 0x7FFFFFFF, -0x7FFFFFFF - 1}) {   // no overflow, no reading far away
            bad = good;
            bad.counts.*count = wrong;
            copy.set(bad);
            CHECK(copy.attach() == HM_BAD_BASIS);
            CHECK(copy.says("contradict"));
        }
    }
    bad = good;
    bad.checksum ^= 1;
    copy.set(bad);
    CHECK(copy.attach() == HM_BAD_BASIS);
    CHECK(copy.says("checksum"));
    copy.set(good);
    CHECK(copy.attach() == HM_OK);
    const hm_basis* basis = nullptr;
    CHECK(hm_basis_attach(&basis, copy.data() + 4, copy.size(), nullptr, nullptr) == HM_BAD_ARGUMENT);   // misaligned
    CHECK(basis == nullptr);
}

TEST_CASE("numbers that lead nowhere are found behind a good checksum, too") {
    Case its = two_body_case(Cells::hybrid, 4, 3);
    Solved const solved(its);
    hm_mesh const mesh = its.mesh.view();
    Copy copy(solved);
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
        spoils(basis.indices[3], far, "curves");
        spoils(basis.shape[1].first_knot, far, "curves");
        spoils(basis.shape[0].n_indices, far, "curves");
        spoils(basis.conditions[1].first_curve, far, "conditions");
        spoils(basis.wall_point[5], far, "points on curves");
        spoils(basis.wall_curve[5], far, "points on curves");
        spoils(basis.boundary_point[9], far, "boundary");
        spoils(basis.loop_start[1], far, "boundary");
        spoils(basis.header->filled, far, "method");
        spoils(basis.header->counts.bodies, far, "contradict");
        spoils(basis.header->counts.combination, far, "contradict");
    }
    spoils(basis.knots[4], std::nan(""), "curves");
    spoils(basis.control[4], std::nan(""), "curves");
    spoils(basis.wall_u[4], std::nan(""), "points on curves");
    spoils(basis.value[100], 1e9, "largest");
    spoils(basis.header->largest, 0.5, "largest");
    CHECK(attach_sealed() == HM_OK);
    CHECK(basis.header->checksum == good.checksum);

    // Any word of all that is not values: refused, or of no use to whom would read elsewhere.
    std::int32_t* const words = reinterpret_cast<std::int32_t*>(copy.data());
    std::ptrdiff_t const n = reinterpret_cast<std::int32_t*>(basis.value.data()) - words;
    std::vector<double> const move = some_move(20, 0.1, 1);
    std::vector<double> x(its.mesh.x.size()), y = x, gradient(40);
    int accepted = 0;
    for (std::ptrdiff_t k = sizeof(harmorph::BasisHeader) / 4; k < n; ++k)
        for (std::int32_t const wrong : {-1, 1 << 30, 0x7FF00000}) {
            std::int32_t const right = words[k];
            words[k] = wrong;
            if (attach_sealed() >= 0) {
                ++accepted;
                CHECK(hm_morph(copy.basis, move.data(), &mesh.points, points_out(x, y), nullptr, nullptr) == HM_OK);
                CHECK(hm_adjoint(copy.basis, &mesh.points, gradient.data(), nullptr, nullptr) == HM_OK);
            }
            words[k] = right;
        }
    CHECK(accepted > 0);
    CHECK(accepted < 3 * n);
}

TEST_CASE("another mesh is refused; the same mesh elsewhere is a warning") {
    Case its = tiny_case();
    Solved const solved(its);
    Copy copy(solved);

    Case other = its;
    other.mesh.add_point({9, 9});
    hm_mesh view = other.mesh.view();
    CHECK(copy.attach(&view) == HM_BAD_BASIS);
    CHECK(copy.says("another mesh: it has 48 points"));
    other = its;
    std::swap(other.mesh.cells[0], other.mesh.cells[2]);   // the same counts
    view = other.mesh.view();
    CHECK(copy.attach(&view) == HM_BAD_BASIS);
    CHECK(copy.says("the cells differ"));
    other = its;
    std::swap(other.mesh.face_markers.front(), other.mesh.face_markers.back());   // a face each on the other's marker
    REQUIRE(other.mesh.face_markers != its.mesh.face_markers);
    view = other.mesh.view();
    CHECK(copy.attach(&view) == HM_BAD_BASIS);
    CHECK(copy.says("its markers"));
    other = its;
    for (std::int32_t& marker : other.mesh.face_markers) marker += 7;   // the same points on markers of other numbers
    view = other.mesh.view();
    CHECK(copy.attach(&view) == HM_BAD_BASIS);
    CHECK(copy.says("its markers"));
    other = its;
    other.mesh.x[20] += 1e-12;
    view = other.mesh.view();
    CHECK(copy.attach(&view) == HM_MOVED);
    CHECK(copy.says("coordinates"));
    other.mesh.x[20] = std::nan("");
    CHECK(copy.attach(&view) == HM_BAD_MESH);

    // Numbering, layout and stride are ways of writing the same mesh; so are the order of faces and that of their ends.
    other = its;
    std::reverse(other.mesh.faces.begin(), other.mesh.faces.end());
    std::reverse(other.mesh.face_markers.begin(), other.mesh.face_markers.end());
    view = other.mesh.view();
    CHECK(copy.attach(&view) == HM_OK);
    other = its;
    other.index_base = 1;
    CHECK(copy.attach(&other.mesh_view()) == HM_OK);
    std::vector<std::int32_t> const quads = quads_of(its.mesh);
    view = its.mesh.view();
    view.cell_layout = HM_CELLS_QUADS;
    view.cell_points = quads.data();
    std::vector<double> xy;
    for (std::size_t k = 0; k < its.mesh.x.size(); ++k) xy.insert(xy.end(), {its.mesh.x[k], its.mesh.y[k]});
    view.points = {xy.data(), xy.data() + 1, 2};
    CHECK(copy.attach(&view) == HM_OK);
}

TEST_CASE("before it is solved it can do nothing, and is not attached") {
    Case its = tiny_case();
    Attempt attempt;
    REQUIRE(attempt.analyse(its.problem()));
    REQUIRE(attempt.prepare());
    std::vector<double> x = its.mesh.x, y = its.mesh.y, move(8, 0.1);
    hm_basis_info info{};
    info.struct_size = sizeof info;
    REQUIRE(hm_basis_info_get(attempt.basis, &info, nullptr) == HM_OK);
    CHECK(info.solved == 0);
    CHECK(hm_morph(attempt.basis, move.data(), points_in(x, y), points_out(x, y), nullptr, nullptr) == HM_BAD_BASIS);
    CHECK(hm_adjoint(attempt.basis, points_in(x, y), move.data(), nullptr, nullptr) == HM_BAD_BASIS);
    CHECK(hm_basis_values(attempt.basis, 0, 0, x.data(), nullptr) == HM_BAD_BASIS);
    CHECK(same_bits(x, its.mesh.x));
    CHECK(same_bits(y, its.mesh.y));
    CHECK(move[3] == 0.1);
    Copy copy(attempt.basis, static_cast<std::size_t>(info.bytes));
    CHECK(copy.attach() == HM_BAD_BASIS);
    CHECK(copy.says("not been solved"));
    REQUIRE(attempt.solve());
    CHECK(hm_morph(attempt.basis, move.data(), points_in(x, y), points_out(x, y), nullptr, nullptr) == HM_OK);
}

TEST_CASE("written to a file and read back") {
    Case its = airfoil_case();
    Solved const solved(its);
    std::size_t const bytes = static_cast<std::size_t>(solved.info().bytes);
    std::FILE* const file = std::tmpfile();
    REQUIRE(file != nullptr);
    REQUIRE(std::fwrite(solved.basis, 1, bytes, file) == bytes);
    std::rewind(file);
    std::vector<double> block(bytes / 8 + 1);
    CHECK(std::fread(block.data(), 1, bytes, file) == bytes);
    std::fclose(file);
    hm_mesh const mesh = its.mesh.view();
    const hm_basis* basis = nullptr;
    REQUIRE(hm_basis_attach(&basis, block.data(), bytes, &mesh, nullptr) == HM_OK);
    std::vector<double> values(its.mesh.x.size());
    REQUIRE(hm_basis_values(basis, 3, 0, values.data(), nullptr) == HM_OK);
    CHECK(same_bits(values, solved.values(3)));
}
