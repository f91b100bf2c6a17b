// Files through the readers of the program: meshes of all formats, curves, movements, bases. A file
// is read, or refused with its name and a reason. What a mesh was read from is written again with
// other coordinates. Most files are one of the small ones below, damaged; some are the bytes of the
// case as they are, which libFuzzer shapes.
#include "work/basis_file.hpp"
#include "curves/curve_file.hpp"
#include "failure.hpp"
#include "formats/format.hpp"
#include "work/moves_file.hpp"
#include "target.hpp"

#include <harmorph.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <sstream>
#include <stdlib.h>
#include <unistd.h>
#include <fixtures/memory.hpp>

namespace fuzz {
namespace {

const char* const mesh_files[] = {
    "NDIME= 2\nNELEM= 2\n5 0 1 2 0\n9 1 3 4 2 1\nNPOIN= 5\n0 0 0\n1 0 1\n0 1 2\n2 0 3\n2 1.5 "
    "4\nNMARK= 1\nMARKER_TAG= "
    "wall\n"
    "MARKER_ELEMS= 5\n3 0 1\n3 1 3\n3 3 4\n3 4 2\n3 2 0\n",
    "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n1\n1 3 "
    "\"wall\"\n$EndPhysicalNames\n$Nodes\n3\n1 0 0 0\n2 1 "
    "0 0\n3 0 1 "
    "0\n$EndNodes\n$Elements\n4\n1 1 2 3 1 1 2\n2 1 2 3 1 2 3\n3 1 2 3 1 3 1\n4 2 2 7 1 1 2 "
    "3\n$EndElements\n",
    "# vtk DataFile Version 3.0\nmesh\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 4 double\n0 0 0 1 "
    "0 0 1 1 0 0 1 "
    "0\nCELLS 2 8\n3 0 "
    "1 2\n3 0 2 3\nCELL_TYPES 2\n5\n5\n",
    "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"0.1\" "
    "byte_order=\"LittleEndian\"><UnstructuredGrid><Piece "
    "NumberOfPoints=\"3\" NumberOfCells=\"1\"><Points><DataArray type=\"Float64\" "
    "NumberOfComponents=\"3\" "
    "format=\"ascii\">0 0 0 1 0 0 "
    "0 1 0</DataArray></Points><Cells><DataArray type=\"Int32\" Name=\"connectivity\" "
    "format=\"ascii\">0 1 "
    "2</DataArray><DataArray "
    "type=\"Int32\" Name=\"offsets\" format=\"ascii\">3</DataArray><DataArray type=\"UInt8\" "
    "Name=\"types\" "
    "format=\"ascii\">5</DataArray></Cells></Piece></UnstructuredGrid></VTKFile>\n",
    "3 3\n0 1 2 0 1 2 0 1 2\n0 0 0 1 1 1 2 2 2\n",
    "$Comments\nfrom a program\n$EndComments\n$MeshFormat\n2.0 0 8\n$EndMeshFormat\n$Nodes\n6\n1 0 "
    "0 0\n2 1 0 0\n3 0 1 0\n"
    "4 0 0 1\n5 1 0 1\n6 0 1 1\n$EndNodes\n$Elements\n6\n1 3 2 1 1 1 2 5 4\n2 3 2 1 1 2 3 6 5\n3 3 "
    "2 2 1 3 1 4 6\n"
    "4 3 2 1 1 3 1 4 6\n5 2 2 4 1 1 2 3\n6 6 2 3 1 1 2 3 4 5 6\n$EndElements\n$PhysicalNames\n2\n2 "
    "1 \"wall\"\n2 2 "
    "\"out\"\n$EndPhysicalNames\n",
    "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$Entities\n0 1 1 0\n1 0 0 0 1 1 0 2 1 2 0\n1 0 0 0 1 1 "
    "0 1 3 1 1\n$EndEntities\n"
    "$Nodes\n1 3 1 3\n2 1 0 3\n1\n2\n3\n0 0 0\n1 0 0\n0 1 0\n$EndNodes\n$Elements\n2 4 1 4\n1 1 1 "
    "3\n1 1 2\n2 2 3\n3 3 1\n"
    "2 1 2 1\n4 1 2 3\n$EndElements\n",
    "# vtk DataFile Version 3.0\nmesh\nASCII\nDATASET STRUCTURED_GRID\nDIMENSIONS 3 2 2\nPOINTS 12 "
    "double\n0 0 0 1 0 0 2 0 0 "
    "0 1 0 1 1 0 2 1 0 0 0 1 1 0 1 2 0 1 0 1 1 1 1 1 2 1 1\n",
    "# vtk DataFile Version 3.0\nmesh\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 6 double\n0 0 0 1 "
    "0 0 0 1 0 .5 0 0 .5 .5 0 "
    "0 .5 0\nCELLS 1 7\n6 0 1 2 3 4 5\nCELL_TYPES 1\n22\n",
    "<VTKFile type=\"UnstructuredGrid\"><UnstructuredGrid><Piece NumberOfPoints=\"3\" "
    "NumberOfCells=\"1\"><Points><DataArray "
    "type=\"Float32\" NumberOfComponents=\"3\" "
    "Format=\"binary\">JAAAAAAAAAAAAAAAAAAAAAAAgD8AAAAAAAAAAAAAAAAAAIA/AAAAAA==</DataArray>"
    "</Points><Cells><DataArray type=\"Int32\" Name=\"connectivity\">0 1 2</DataArray><DataArray "
    "type=\"Int32\" "
    "Name=\"offsets\" format=\"appended\" offset=\"0\"/><DataArray type=\"UInt8\" Name=\"types\" "
    "format=\"appended\" "
    "offset=\"12\"/></Cells></Piece></UnstructuredGrid><AppendedData "
    "encoding=\"base64\">_BAAAAAMAAAA=AQAAAAU=</AppendedData>"
    "</VTKFile>\n",
    "<VTKFile type=\"UnstructuredGrid\" "
    "compressor=\"vtkZLibDataCompressor\"><UnstructuredGrid><Piece NumberOfPoints=\"3\" "
    "NumberOfCells=\"1\"><Points><DataArray type=\"Float32\" NumberOfComponents=\"3\" "
    "format=\"binary\">"
    "AQAAACQAAAAAAAAAEAAAAA==eJxjYEAGDfYMWPgAFIoBfw==</DataArray></Points><Cells><DataArray "
    "type=\"Int32\" "
    "Name=\"connectivity\">0 1 2</DataArray><DataArray type=\"Int32\" "
    "Name=\"offsets\">3</DataArray><DataArray type=\"UInt8\" "
    "Name=\"types\">5</DataArray></Cells></Piece></UnstructuredGrid></VTKFile>\n",
    "2 2 2\n2*0 2*1 2*0 2*1 0 1 0 1 0 1 0 1 4*0 4*1\n",
    "6 2 3 0 0 1 0\n0 0 0  1 0 0  0 1 0  0 0 1  1 0 1  0 1 1\n1 3 2\n4 5 6\n1 2 5 4\n2 3 6 5\n3 1 "
    "4 6\n1 1 2 2 3\n"
    "1 2 3 4 5 6\n",
    "(0 \"grid\")\n(2 2)\n(10 (0 1 3 0 2))\n(10 (1 1 3 1 2)(0 0 1 0 0 1))\n(12 (0 1 1 0))\n(12 (2 "
    "1 1 1 1))\n(13 (0 1 "
    "3 0))\n(13 "
    "(3 1 3 3 2)(\n1 2 1 0\n2 3 1 0\n3 1 1 0))\n(45 (3 wall wall)())\n"};
const char* const curve_files[] = {
    "degree 2\nclosed periodic\npoints 4\n0 0\n1 0\n1 1\n0 1\nknots 9\n-2 -1 0 1 2 3 4 5 6\n",
    "degree 1\nclosed tied\npoints 3\n0 0\n1 0\n0 1\nknots 6\n0 0 1 2 3 3\nweights 3\n1\n2\n1\n"};
const char* const moves_files[] = {"1 0.1 0.2\n3 -1e-3 0\n", "# none\n2 1 1\n"};

template <std::size_t n>
const char* one_of(const char* const (&files)[n], Input& input) {
    return files[input.below(n)];
}

// A damaged copy of it.
std::string damaged(std::string text, Input& input) {
    if (input.one_in(8)) return input.rest();
    static const char* const words[] = {"-1",
                                        "0",
                                        "1e999",
                                        "nan",
                                        "2147483648",
                                        "99999999999999999999",
                                        "\r\n",
                                        "\t",
                                        "",
                                        "\"",
                                        "<",
                                        "(",
                                        "-9223372036854775808",
                                        "9223372036854775807",
                                        "-2147483648",
                                        "2147483647"};
    for (std::int32_t k = input.from(0, 4); k > 0; --k) {
        std::size_t const at = input.below(static_cast<std::uint32_t>(text.size() + 1));
        switch (input.below(5)) {
            case 0: text.resize(at); break;
            case 1: text.insert(at, words[input.below(16)]); break;
            case 2: text.erase(at, input.below(12)); break;
            case 3:
                if (at < text.size()) text[at] = static_cast<char>(input.below(256));
                break;
            default:
                text.insert(at,
                            text.substr(input.below(static_cast<std::uint32_t>(text.size() + 1)),
                                        input.below(40)));
        }
    }
    return text;
}

// A file of this process, which goes with it: in memory where the system has a directory for that.
class Scratch {
public:
    Scratch() {
        int file = -1;
        for (const char* const directory : {"/dev/shm", "/tmp"}) {
            path_ = std::string(directory) + "/harmorph-fuzz-XXXXXX";
            file = mkstemp(path_.data());
            if (file >= 0) break;
        }
        expect(file >= 0, "no scratch file");
        close(file);
    }
    ~Scratch() { std::remove(path_.c_str()); }
    std::string write(std::string const& text) const {
        std::ofstream(path_, std::ios::binary) << text;
        return path_;
    }

private:
    std::string path_;
};

void read_mesh(std::string const& path) {
    cli::Mesh const mesh = cli::read_mesh_file(path, {});
    std::vector<double> x = mesh.x, y = mesh.y;
    for (double& number : x) number += 0.25;
    cli::round_as_file(mesh, x, y);
    std::ostringstream out;
    cli::write_moved(out, mesh, x.data(), y.data());
    expect(out.str().size() > 0, "nothing is written");
}

// 4 x 4 points; the lowest four are on the marker "wall", the others of the boundary on "far".
std::string square() {
    std::ostringstream out;
    out << "NDIME= 2\nNELEM= 9\n";
    for (int k = 0; k < 11; ++k)
        if (k % 4 < 3) out << "9 " << k << ' ' << k + 1 << ' ' << k + 5 << ' ' << k + 4 << '\n';
    out << "NPOIN= 16\n";
    for (int k = 0; k < 16; ++k) out << k % 4 << ' ' << k / 4 << '\n';
    out << "NMARK= 2\nMARKER_TAG= wall\nMARKER_ELEMS= 3\n3 0 1\n3 1 2\n3 2 3\nMARKER_TAG= "
           "far\nMARKER_ELEMS= 9\n";
    for (int k = 0; k < 3; ++k)
        out << "3 " << 4 * k << ' ' << 4 * k + 4 << "\n3 " << 4 * k + 3 << ' ' << 4 * k + 7
            << "\n3 " << 12 + k << ' ' << 13 + k << '\n';
    return out.str();
}

// That mesh, and a basis of a polygon through its wall, as files.
struct SolvedSquare {
    Scratch mesh_file;
    cli::Mesh mesh;
    std::string basis_text;

    SolvedSquare() : mesh(cli::read_mesh_file(mesh_file.write(square()), {})) {
        double const control[] = {0, 0, 1, 0, 2, 0, 3, 0}, knots[] = {0, 0, 1, 2, 3, 3};
        hm_curve const curve{sizeof curve, 1, 4, nullptr, knots};
        hm_curves const curves{sizeof curves, 0, 4, control, nullptr, 1, &curve};
        hm_condition on_curve{};
        on_curve.struct_size = sizeof on_curve;
        on_curve.marker = mesh.find_markers("wall")[0];
        on_curve.n_curves = 1;
        hm_mesh const view = mesh.view();
        hm_problem problem{};
        problem.struct_size = sizeof problem;
        problem.mesh = &view;
        problem.curves = &curves;
        problem.n_conditions = 1;
        problem.conditions = &on_curve;
        std::vector<char> blocks[3];
        hm_analysis* analysis = nullptr;
        hm_plan* plan = nullptr;
        hm_basis* basis = nullptr;
        std::size_t bytes = 0;
        auto const block = [&](int k) {
            return blocks[k].resize(bytes), static_cast<void*>(blocks[k].data());
        };
        fixtures::analysis_size(&problem, nullptr, &bytes, nullptr);
        hm_analysis_init(&analysis, fixtures::Memory(block(0), bytes), &problem, nullptr, nullptr);
        fixtures::plan_size(analysis, &bytes, nullptr);
        hm_plan_init(&plan, fixtures::Memory(block(1), bytes), analysis, nullptr);
        fixtures::basis_size(analysis, &bytes, nullptr);
        hm_basis_init(&basis, fixtures::Memory(block(2), bytes), analysis, nullptr);
        hm_plan_factor(plan, nullptr, nullptr);
        expect(hm_plan_solve(plan, basis, nullptr, nullptr) == HM_OK,
               "the square cannot be solved");
        std::ostringstream out;
        cli::write_basis(out, basis, mesh);
        basis_text = out.str();
    }
};

// Names of markers with characters that mean something in lists and lines; and a mesh whose markers
// have two faces each, which are not connected.
std::vector<std::string> random_names(Input& input) {
    static const char* const parts[] = {
        "wall",  " ",  "\"", "'",  "=", ",",   "@", "#",    ":", "8:2", "*",    "?",   "\\",
        "loop:", "\t", "\n", "\r", "1", "\\n", "a", "\\\"", "+", "far", "turn", "'a'", "\"a\""};
    std::vector<std::string> names;
    for (std::int32_t k = input.from(1, 4); k > 0; --k) {
        std::string name;
        for (std::int32_t part = input.from(1, 5); part > 0; --part) name += one_of(parts, input);
        if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
    }
    return names;
}

cli::Mesh mesh_with(std::vector<std::string> const& names) {
    cli::Mesh mesh;
    mesh.markers = names;
    for (std::int32_t face = 0; face < 2 * std::int32_t(names.size()); ++face) {
        for (std::int32_t end = 0; end < 2; ++end) {
            mesh.x.push_back(4.0 * face + end);
            mesh.y.push_back(1);
        }
        mesh.add_face(2 * face, 2 * face + 1, face / 2, 0);
    }
    return mesh;
}

// Every line that the program writes for a body is read back, and names the same markers in
// options.
void check_names(Input& input) {
    cli::Mesh const mesh = mesh_with(random_names(input));
    std::vector<hm_condition> conditions;
    bool const are_pieces = input.one_in(2);
    for (std::int32_t face = 0; face < mesh.faces(); face += are_pieces ? 1 : 2) {
        hm_condition condition = {};
        condition.struct_size = sizeof condition;
        condition.marker = face / 2;
        condition.kind = HM_RIGID;
        condition.body = std::int32_t(conditions.size());
        condition.piece = are_pieces ? 1 : 0;
        condition.near_x = are_pieces ? 4.0 * face + input.between(-1, 2) : 0;
        condition.near_y = are_pieces ? input.between(0, 2) : 0;
        conditions.push_back(condition);
    }
    std::vector<double> moves;
    std::ostringstream text;
    for (hm_condition const& condition : conditions) {
        for (std::int32_t k = 0; k < 4; ++k) moves.push_back(input.between(-0.5, 0.5));
        text << "  ";
        cli::write_body(text, mesh, condition, &moves[moves.size() - 4]);
        std::string const name = mesh.name_of(condition);
        for (std::string const& list : {name, mesh.split_binding(name + "=a=b").first}) {
            std::vector<cli::MarkerPiece> const found = mesh.find_pieces(list);
            expect(found.size() == 1 && found[0].marker == condition.marker &&
                       found[0].is_piece == are_pieces && found[0].x == condition.near_x &&
                       found[0].y == condition.near_y,
                   "a list is not the marker that was written: " + list);
        }
        expect(mesh.split_binding(name + "=a=b").second == "a=b", "the value behind " + name);
    }
    cli::Movable movable;
    movable.n_bodies = std::int32_t(conditions.size());
    movable.conditions = conditions;
    std::vector<double> const again =
        cli::read_moves({cli::TextFile("moves", text.str() + "# the end\n")}, movable, mesh);
    for (std::size_t k = 0; k < moves.size(); ++k)
        expect(std::fabs(again[k] - moves[k]) < 1e-12, "a line that is written: " + text.str());
}

}  // namespace

Outcome run_files(Input& input) {
    static Scratch const scratch;
    static SolvedSquare const square;
    std::uint32_t const what = input.below(4);
    if (what == 2 && input.one_in(3)) {
        check_names(input);
        return Outcome::done;
    }
    std::string const good = what == 0   ? one_of(mesh_files, input)
                             : what == 1 ? one_of(curve_files, input)
                             : what == 2 ? one_of(moves_files, input)
                                         : square.basis_text;
    std::string const path = scratch.write(damaged(good, input));
    try {
        if (what == 0) read_mesh(path);
        if (what == 1) cli::read_curves(path);
        if (what == 3) cli::Basis(path, square.mesh);
        static Scratch const whole;
        static cli::Basis const basis(whole.write(square.basis_text), square.mesh);
        if (what == 2)
            cli::read_moves({cli::text_of_moves(path)}, cli::movable_of(basis), square.mesh);
    } catch (cli::Failure const& failure) {
        expect(std::string(failure.what()).find(path) != std::string::npos,
               std::string("no name: ") + failure.what());
        return Outcome::refused;
    }
    return Outcome::done;
}

}  // namespace fuzz
