#include "work/basis_file.hpp"

#include "basics/failure.hpp"
#include "basics/geometry.hpp"
#include "basics/numbers.hpp"
#include "curves/curves.hpp"
#include "mesh/mesh_file.hpp"

#include <harmorph_bases.h>
#include <harmorph_design.h>
#include <harmorph_study.h>

#include <algorithm>
#include <cmath>
#include <ostream>
#include <sstream>

namespace cli {

namespace {

// Returns the bytes of the file of a basis.
std::string as_file(const hm_basis* basis, const Mesh& mesh) {
    std::ostringstream out;
    write_basis(out, basis, mesh);
    return out.str();
}

// Attaches the basis. Returns whether the mesh has moved. The library's message about a block that
// is cut off is replaced by one about the file.
bool attach(const hm_basis** basis, std::string_view block, const hm_mesh* mesh,
            const std::string& path) {
    hm_error error = {};
    const hm_status status = hm_basis_attach(basis, block.data(), block.size(), mesh, &error);
    if (status == HM_BAD_BASIS && error.value > 0) {
        const std::string found = std::to_string(block.size());
        const std::string expected =
            std::to_string(block.size() + static_cast<std::size_t>(error.value));
        const std::string text =
            "it has " + found + " bytes, but at least " + expected + " are needed";
        throw Failure(exit_file, path + ": the file is cut off: " + text);
    }
    if (status < 0) refuse(error, path);
    return status == HM_MOVED;
}

hm_basis_info info_of(const hm_basis* basis, const std::string& path) {
    auto info = sized<hm_basis_info>();
    call(path, hm_basis_info_get, basis, &info);
    return info;
}

constexpr const char* title_of_names = "harmorph markers ";

// Reads the text after the first `bytes` of the file.
class TextAfterBlock {
public:
    TextAfterBlock(std::string_view block, std::uint64_t bytes, const std::string& path)
        : path_(path), text_(std::string(block.substr(static_cast<std::size_t>(bytes)))) {
        next_line();  // the line feed before the title
    }

    std::vector<std::string> names() {
        std::int32_t n = 0;
        if (!next_line() || !begins_with(title_of_names) || !parse(rest_after(title_of_names), n) ||
            n < 0) {
            refuse("the file has no names of markers");
        }
        std::vector<std::string> names;
        while (names.size() < static_cast<std::size_t>(n) && next_line() && !text_.eof())
            names.push_back(line_);
        if (names.size() == static_cast<std::size_t>(n)) return names;
        throw Failure(exit_file, path_ + ": the file is cut off: it has " +
                                     std::to_string(names.size()) +
                                     " names of markers, but must have " + std::to_string(n));
    }

private:
    bool next_line() { return static_cast<bool>(std::getline(text_, line_)); }
    bool begins_with(std::string_view word) const {
        return line_.compare(0, word.size(), word) == 0;
    }
    std::string_view rest_after(std::string_view word) const {
        return std::string_view(line_).substr(word.size());
    }
    [[noreturn]] void refuse(const char* text) const {
        throw Failure(exit_file,
                      path_ + ": " + text + "; solve the basis again with harmorph solve");
    }

    std::string path_;
    std::istringstream text_;
    std::string line_;
};

void refuse_other_markers(const std::vector<std::string>& names, const std::string& path,
                          const Mesh& mesh) {
    if (names == mesh.markers) return;
    throw Failure(exit_file, path + ": the basis belongs to another mesh: its markers are " +
                                 listed(names) + "; those of " + mesh.file.path() + " are " +
                                 listed(mesh.markers));
}

// Checks the numbers of markers in conditions, which the library does not compare with the mesh.
// The program then uses them as indices.
void refuse_unknown_markers(const std::vector<hm_condition>& conditions, const std::string& path,
                            const Mesh& mesh) {
    const auto n = static_cast<std::int32_t>(mesh.markers.size());
    for (std::size_t i = 0; i < conditions.size(); ++i) {
        const hm_condition& condition = conditions[i];
        const bool is_pair = condition.kind == HM_PERIODIC_PAIR ||
                             condition.kind == HM_ROTATION_PAIR || condition.kind == HM_INTERFACE;
        for (const std::int32_t marker : {condition.marker, is_pair ? condition.partner : 0}) {
            if (0 <= marker && marker < n) continue;
            throw Failure(exit_file, path + ": the basis is damaged: its condition " +
                                         std::to_string(i) + " (from 0) names marker " +
                                         std::to_string(marker) + " (from 0); " + mesh.file.path() +
                                         " has " + plural(n, "marker"));
        }
    }
}

// Refuses functions of design variables and a share of the functions: the program moves all control
// points, bodies and modes.
void refuse_other_functions(const hm_basis_info& info, const std::string& path) {
    if (info.combined > 0) {
        throw Failure(exit_file, path +
                                     ": the functions of this basis are those of design variables, "
                                     "which only the library takes");
    }
    // The functions take more bytes than this, so no array becomes much larger than the file.
    if (static_cast<std::uint64_t>(info.functions) <= info.bytes / sizeof(float)) return;
    throw Failure(exit_file, path + ": the basis is a share: it does not hold all of its " +
                                 plural(info.functions, "function"));
}

}  // namespace

Basis::Basis(const std::string& path, const Mesh& mesh) : Basis(TextFile(path), mesh) {}

Basis::Basis(const hm_basis* solved, const Mesh& mesh)
    : Basis(TextFile(mesh.file.path(), as_file(solved, mesh)), mesh) {}

Basis::Basis(const TextFile& file, const Mesh& mesh)
    : path_(file.path()),
      file_(file),
      info_(sized<hm_basis_info>()),
      curves_(sized<hm_curves>()),
      moved_curves_(sized<hm_curves>()) {
    attach(&basis_, file_.text(), nullptr, path_);
    info_ = info_of(basis_, path_);
    TextAfterBlock text(file_.text(), info_.bytes, path_);
    refuse_other_markers(text.names(), path_, mesh);
    const hm_mesh view = mesh.view();
    mesh_has_moved_ = attach(&basis_, file_.text(), &view, path_);
    if (info_.solved == 0)
        throw Failure(exit_file, path_ + ": the basis has no functions, as it has not been solved");
    refuse_other_functions(info_, path_);
    curve_.assign(static_cast<std::size_t>(info_.curves) + 1, sized<hm_curve>());  // never empty
    call(path_, hm_basis_curves, basis_, nullptr, nullptr, &curves_, curve_.data(), info_.curves);
    std::int32_t n = 0;
    hm_basis_conditions(basis_, nullptr, 0, &n, nullptr);
    // One element more, so that the array has a first element, whose struct_size counts for all.
    conditions_.assign(static_cast<std::size_t>(n) + 1, sized<hm_condition>());
    call(path_, hm_basis_conditions, basis_, conditions_.data(), n + 1, &n);
    conditions_.resize(static_cast<std::size_t>(n));
    refuse_unknown_markers(conditions_, path_, mesh);
    find_slip_curves();
    moved_curves_ = curves_;
    if (mesh_has_moved_) find_movement(mesh);
}

// Finds the curves along which points slip. Conditions whose curves have the same arrays in the
// basis share one set, so that points can slip from one marker to the next.
void Basis::find_slip_curves() {
    std::vector<const double*> knots;  // of the first curve of each set
    for (std::size_t number = 0; number < conditions_.size(); ++number) {
        hm_condition& condition = conditions_[number];
        if (condition.kind != HM_SLIP || condition.n_curves == 0) continue;
        hm_curves found = sized<hm_curves>();
        std::vector<hm_curve> curve(static_cast<std::size_t>(condition.n_curves));
        call(path_, hm_basis_along, basis_, static_cast<std::int32_t>(number), &found, curve.data(),
             condition.n_curves);
        const std::size_t set = static_cast<std::size_t>(
            std::find(knots.begin(), knots.end(), curve[0].knots) - knots.begin());
        if (set == knots.size()) {
            knots.push_back(curve[0].knots);
            slip_curves_.push_back(std::make_shared<const CurveSet>(copied(found)));
        }
        condition.along = slip_curves_[set]->view.get();
    }
}

// Finds the movement that the mesh has made since the basis was solved, and from it the curves and
// which bodies have moved.
void Basis::find_movement(const Mesh& mesh) {
    Block work;
    std::vector<double> moves(2 * static_cast<std::size_t>(info_.functions) + 1);  // never empty
    const hm_points at = mesh.coordinates();
    hm_error error = {};
    auto report = sized<hm_recover_report>();
    const hm_status status = with_memory(work, [&](hm_memory* memory) {
        return hm_recover_movement(basis_, &at, 0, moves.data(), &report, memory, &error);
    });
    if (status == HM_BAD_MESH) {
        why_on_no_curve_ = mesh.file.path() + ": " + error.text;
        return;
    }
    if (status < 0) refuse(error, path_);
    distance_ =
        std::fabs(report.residual - report.rotated_offset);  // without the offsets that turned
    moved_control_.resize(2 * static_cast<std::size_t>(n_control()) + 1);
    call(path_, hm_basis_curves, basis_, moves.data(), moved_control_.data(), &moved_curves_,
         curve_.data(), info_.curves);
    recovered_ = std::move(moves);
    constexpr double rounding = 1e-9;
    double extent = 0;
    for (std::size_t k = 0; k < mesh.x.size(); ++k)
        extent = std::max({extent, std::fabs(mesh.x[k]), std::fabs(mesh.y[k])});
    for (std::int32_t body = 0; body < info_.bodies; ++body) {
        const double* const by = &recovered_[2 * place(n_control() + 2 * body)];
        const double shift = std::max(std::fabs(by[0]), std::fabs(by[1])),
                     turn = std::max(std::fabs(by[2]), std::fabs(by[3]));
        if (shift > rounding * extent || turn > rounding) has_moved_bodies_ = true;
    }
}

std::complex<double> Basis::body_rotation(std::int32_t body) const {
    if (!why_on_no_curve_.empty())
        throw Failure(exit_unusable, why_on_no_curve_ + "; solve again on this mesh");
    if (recovered_.empty()) return 1;
    const double* const of_body = &recovered_[2 * place(n_control() + 2 * body)];
    return {1 + of_body[2], of_body[3]};
}

const hm_curves& Basis::curves() const {
    if (why_on_no_curve_.empty() || info_.curves == 0) return moved_curves_;
    throw Failure(exit_unusable, why_on_no_curve_ + "; solve again on this mesh");
}

std::vector<double> Basis::values(std::int32_t function, std::int32_t number,
                                  const Mesh& mesh) const {
    std::vector<double> values(mesh.x.size());
    call(path_, hm_basis_values, basis_, function, number, values.data());
    return values;
}

void write_basis(std::ostream& out, const hm_basis* basis, const Mesh& mesh) {
    const hm_basis_info info = info_of(basis, "basis");
    out.write(reinterpret_cast<const char*>(basis), static_cast<std::streamsize>(info.bytes));
    out << '\n' << title_of_names << mesh.markers.size() << '\n';
    for (const std::string& name : mesh.markers) out << name << '\n';
}

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
