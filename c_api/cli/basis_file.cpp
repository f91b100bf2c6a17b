#include "basis_file.hpp"

#include "failure.hpp"
#include "marker_names.hpp"
#include "numbers.hpp"

#include <filesystem>
#include <fstream>
#include <ostream>
#include <sstream>

namespace cli {

namespace {

Block read_block(const std::string& path) {
    std::error_code error;
    const std::uintmax_t bytes = std::filesystem::file_size(path, error);
    if (error) throw Failure(exit_file, path + ": cannot be read: " + error.message());
    Block block(static_cast<std::size_t>(bytes));
    std::ifstream file(path, std::ios::binary);
    if (!file.read(reinterpret_cast<char *>(block.data()), static_cast<std::streamsize>(bytes))) {
        throw Failure(exit_file, path + ": cannot be read");
    }
    return block;
}

// The library speaks of blocks; what is missing of a file is told in its own terms.
bool attach(const hm_basis** basis, const Block& block, const hm_mesh* mesh, const std::string& path) {
    hm_error error = {};
    const hm_status status = hm_basis_attach(basis, block.data(), block.size(), mesh, &error);
    if (status == HM_BAD_BASIS && error.value > 0) {
        const std::string found = std::to_string(block.size());
        const std::string expected = std::to_string(block.size() + static_cast<std::size_t>(error.value));
        throw Failure(exit_file, path + ": the file is cut off: it has " + found + " bytes, at least " + expected +
                                     " are expected");
    }
    if (status < 0) refuse(error, path);
    return status == HM_MOVED;
}

hm_basis_info info_of(const hm_basis* basis, const std::string& path) {
    auto info = sized<hm_basis_info>();
    call(path, hm_basis_info_get, basis, &info);
    return info;
}

constexpr const char* title = "harmorph markers ";

// The names behind the first `bytes` of the file.
std::vector<std::string> read_names(const Block& block, std::uint64_t bytes, const std::string& path) {
    const char* const data = reinterpret_cast<const char *>(block.data());
    std::istringstream text(std::string(data + bytes, data + block.size()));
    std::string line;
    std::getline(text, line); // the line feed before the title
    std::getline(text, line);
    const std::size_t length = std::char_traits<char>::length(title);
    std::int32_t n = 0;
    if (line.compare(0, length, title) != 0 || !parse(std::string_view(line).substr(length), n) || n < 0) {
        throw Failure(exit_file, path + ": holds a basis without the names of its mesh's markers, so that it is not known "
                                        "which are meant: solve it again with harmorph solve");
    }
    std::vector<std::string> names;
    while (names.size() < static_cast<std::size_t>(n) && std::getline(text, line) && !text.eof()) names.push_back(line);
    if (names.size() == static_cast<std::size_t>(n)) return names;
    throw Failure(exit_file, path + ": the file is cut off: it has " + std::to_string(names.size()) +
                                 " names of markers, expected are " + std::to_string(n));
}

void refuse_other_markers(const std::vector<std::string>& names, const std::string& path, const Mesh& mesh) {
    if (names == mesh.markers) return;
    throw Failure(exit_file, path + ": the basis belongs to another mesh: its markers are " + listed(names) + "; those of " +
                                 mesh.file.path() + " are " + listed(mesh.markers));
}

} // namespace

Basis::Basis(const std::string& path, const Mesh& mesh)
    : path_(path), block_(read_block(path)), info_(sized<hm_basis_info>()), curves_(sized<hm_curves>()) {
    attach(&basis_, block_, nullptr, path_);
    info_ = info_of(basis_, path_);
    refuse_other_markers(read_names(block_, info_.bytes, path_), path_, mesh);
    const hm_mesh view = mesh.view();
    mesh_has_moved_ = attach(&basis_, block_, &view, path_);
    if (info_.solved == 0) throw Failure(exit_file, path_ + ": holds no functions: it has not been solved");
    curve_.assign(static_cast<std::size_t>(info_.curves) + 1, sized<hm_curve>()); // never none
    call(path_, hm_basis_curves, basis_, &curves_, curve_.data(), info_.curves);
    conditions_.assign(mesh.markers.size() + 1, sized<hm_condition>()); // at least one, whose size tells that of all
    std::int32_t n = 0;
    call(path_, hm_basis_conditions, basis_, conditions_.data(), static_cast<std::int32_t>(conditions_.size()), &n);
    conditions_.resize(static_cast<std::size_t>(n));
}

std::vector<double> Basis::values(std::int32_t function, std::int32_t number, const Mesh& mesh) const {
    std::vector<double> values(mesh.x.size());
    call(path_, hm_basis_values, basis_, function, number, values.data());
    return values;
}

void write_basis(std::ostream& out, const hm_basis* basis, const Mesh& mesh) {
    const hm_basis_info info = info_of(basis, "basis");
    out.write(reinterpret_cast<const char *>(basis), static_cast<std::streamsize>(info.bytes));
    out << '\n' << title << mesh.markers.size() << '\n';
    for (const std::string& name : mesh.markers) out << name << '\n';
}

} // namespace cli
