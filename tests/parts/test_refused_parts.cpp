// Parts, conditions and calls that do not fit together are refused with the place.

#include "private.h"
#include <harmorph_study.h>
#include "fixtures/memory.hpp"
#include <fixtures/parted.hpp>
#include <fixtures/refused.hpp>

using namespace fixtures;

TEST_CASE("parts that do not fit together are refused with the place") {
    Case setup = two_airfoils();
    Partition const partition = stripes(setup.mesh, 2);
    auto const refusal = [&](std::function<void(std::vector<PartOfMesh>&)> const& spoil) {
        std::vector<PartOfMesh> parts = cut(setup.mesh, partition, false);
        spoil(parts);
        Parted parted(std::move(parts));
        bool const accepted =
            parted.match() && parted.equate(setup.problem(), options_of(HM_LAPLACE));
        CHECK(!accepted);
        CHECK(parted.status == HM_BAD_MESH);
        CHECK(parted.error.text[0] != 0);
        return std::string(parted.error.text);
    };
    auto const has = [](std::string const& text, const char* words) {
        CAPTURE(text);
        CAPTURE(std::string(words));
        CHECK(text.find(words) != std::string::npos);
    };
    auto const shared_point = [&](std::vector<PartOfMesh> const& parts) {
        std::set<std::int64_t> const first(parts[0].numbers.begin(), parts[0].numbers.end());
        for (std::size_t k = 0; k < parts[1].numbers.size(); ++k)
            if (first.count(parts[1].numbers[k]) > 0) return k;
        return std::size_t{0};
    };
    has(refusal(
            [&](std::vector<PartOfMesh>& parts) { parts[1].mesh.x[shared_point(parts)] += 1e-9; }),
        "has different coordinates in two parts");
    has(refusal([&](std::vector<PartOfMesh>& parts) {  // two numbers in each other's place
            std::size_t const at = shared_point(parts);
            std::swap(parts[1].numbers[at], parts[1].numbers[at == 0 ? 1 : 0]);
        }),
        "");
    has(refusal([&](std::vector<PartOfMesh>& parts) { parts[1].numbers[0] = parts[1].numbers[1]; }),
        "have the same global number");
    has(refusal([&](std::vector<PartOfMesh>& parts) { parts[0].numbers[3] = -1; }),
        "but it must be from 0 to 2^61");
    has(refusal([&](std::vector<PartOfMesh>& parts) {
            parts[0].mesh.faces.resize(parts[0].mesh.faces.size() - 2);
            parts[0].mesh.face_markers.pop_back();
        }),
        "no marker");
    has(refusal([&](std::vector<PartOfMesh>& parts) {  // a cell less: a gap
            Mesh& mesh = parts[1].mesh;
            mesh.cells.resize(std::size_t(mesh.cell_start[mesh.cell_start.size() - 2]));
            mesh.cell_start.pop_back();
        }),
        "edge");
    has(refusal([&](std::vector<PartOfMesh>&
                        parts) {  // a marker on an edge that has cells on both sides
            std::set<std::int64_t> const first(parts[0].numbers.begin(), parts[0].numbers.end());
            Mesh& mesh = parts[1].mesh;
            for (std::size_t cell = 0; cell + 1 < mesh.cell_start.size(); ++cell)
                for (std::int32_t k = mesh.cell_start[cell]; k + 1 < mesh.cell_start[cell + 1];
                     ++k) {
                    std::int32_t const a = mesh.cells[std::size_t(k)],
                                       b = mesh.cells[std::size_t(k) + 1];
                    if (first.count(parts[1].numbers[std::size_t(a)]) == 0) continue;
                    if (first.count(parts[1].numbers[std::size_t(b)]) == 0) continue;
                    mesh.add_face(a, b, far_field);
                    return;
                }
        }),
        "has a marker, but two parts have a cell at this edge");
    has(refusal([&](std::vector<PartOfMesh>& parts) {  // a part twice
            PartOfMesh copy;
            copy.mesh = parts[0].mesh;
            copy.numbers = parts[0].numbers;
            copy.global_point = parts[0].global_point;
            parts.push_back(std::move(copy));
        }),
        "cells of two parts overlap at the edge between the points with global numbers");
    has(refusal([&](std::vector<PartOfMesh>& parts) {  // two corners in one place
            Mesh& mesh = parts[0].mesh;
            std::size_t const one = std::size_t(mesh.cells[0]);
            std::size_t const other = std::size_t(mesh.cells[1]);
            mesh.x[one] = mesh.x[other];
            mesh.y[one] = mesh.y[other];
        }),
        "is inverted or has no area: the smallest area at its corners is");
}

TEST_CASE("conditions that are refused for a whole mesh are refused for parts as well") {
    Case setup = two_airfoils();
    Parted parted(cut(setup.mesh, stripes(setup.mesh, 2), false));
    REQUIRE(parted.match());
    setup.conditions[0].marker = 77;
    CHECK(!parted.equate(setup.problem(), options_of(HM_LAPLACE)));
    CHECK(parted.status == HM_BAD_CONDITION);
    setup.conditions[0].marker = body;
    auto const refusal = [&](std::function<void(Options&)> const& spoil) {
        Options options = options_of(HM_LAPLACE);
        spoil(options);
        CHECK(!parted.equate(setup.problem(), options));
        CHECK(parted.status == HM_UNSUPPORTED);
        return std::string(parted.error.text);
    };
    CHECK(refusal([](Options& o) { o.scheme = HM_BOUNDED; }) ==
          "a mesh in parts needs the compact scheme (HM_COMPACT)");
    CHECK(refusal([](Options& o) { o.engine = HM_MULTIGRID; }) ==
          "options.engine must be HM_DIRECT for a mesh in parts");
    setup.set_rotation(setup.conditions[0].marker + 50, setup.conditions[0].marker + 51);
    CHECK(refusal([](Options&) {}) ==
          "HM_ROTATION_PAIR is not available for a mesh in parts; HM_PERIODIC_PAIR is");
    setup.conditions.pop_back();
    setup.set_slip(far_field);
    setup.conditions.back().along = &setup.curves.view();
    setup.conditions.back().n_curves = setup.conditions.back().along->n_curves;
    CHECK(refusal([](Options&) {}) ==
          "hm_condition.along is not available for a mesh in parts; leave it NULL");
    setup.conditions.pop_back();
    setup.give(0, 0.5);
    CHECK(refusal([](Options&) {}) == "problem.n_known must be 0 for a mesh in parts");
}

TEST_CASE("arrays that are too short for the edges or the entries of a part are refused") {
    Case setup = two_airfoils();
    Parted parted(cut(setup.mesh, stripes(setup.mesh, 2), false));
    REQUIRE(parted.match());
    PartOfMesh& one = parted.parts[0];
    std::int32_t n = 0, none = 0;
    hm_private_part_edges(one.part, nullptr, 0, &n, nullptr);
    REQUIRE(parted.equate(setup.problem(), options_of(HM_LAPLACE)));
    std::int64_t entries = 0;
    std::string const room = "edges has room for " + std::to_string(n - 1) +
                             " edges, but the part has " + std::to_string(n);
    check_texts({
        {HM_BAD_ARGUMENT, room.c_str(),
         call_by(hm_private_part_edges, one.part, parted.edges.data(), n - 1, &none)},
        {HM_BAD_ARGUMENT,
         "capacity is smaller than the number of entries, which *n_entries now contains",
         call_by(hm_private_equations_entries, one.equations, 0, 1, nullptr, nullptr, nullptr, 0,
                 &entries)},
    });
}
