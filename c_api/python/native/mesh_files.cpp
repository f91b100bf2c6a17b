// The readers of the program behind a C interface. Exceptions end here.
#include "mesh_files.h"

#include "mesh/mesh_file.hpp"
#include "curves/section.hpp"
#include "formats/format.hpp"

#include <cstring>
#include <exception>
#include <memory>
#include <sstream>
#include <string>

struct hmpy_file {
    cli::Mesh mesh;
};

struct hmpy_text {
    std::string bytes;
};

struct hmpy_section {
    cli::Section section;
};

namespace {

void say(const char* sentence, char* text, std::int32_t capacity) {
    if (capacity <= 0) return;
    std::strncpy(text, sentence, static_cast<std::size_t>(capacity) - 1);
    text[capacity - 1] = '\0';
}

// Returns what `make` makes, or NULL with the reason in `text`.
template <class Make>
auto reason_or(char* text, std::int32_t capacity, const Make& make) -> decltype(make().release()) {
    try {
        return make().release();
    } catch (const std::bad_alloc&) {
        say("there is not enough memory", text, capacity);
    } catch (const std::exception& failure) {
        say(failure.what(), text, capacity);
    }
    return nullptr;
}

// A mesh to be written as a new file. The cells of the view are rows or polygons.
cli::Mesh copied(const hm_mesh& view, std::int32_t n_markers, const char* const* names) {
    cli::Mesh mesh;
    for (std::int32_t k = 0; k < view.n_points; ++k) {
        mesh.x.push_back(view.points.x[k * view.points.stride]);
        mesh.y.push_back(view.points.y[k * view.points.stride]);
    }
    mesh.cell_start.assign(view.cell_start, view.cell_start + view.n_cells + 1);
    mesh.cell_points.assign(view.cell_points, view.cell_points + view.cell_start[view.n_cells]);
    mesh.has_polygons = view.cell_layout == HM_CELLS_POLYGONS;
    mesh.face_points.assign(view.face_points, view.face_points + 2 * view.n_faces);
    mesh.face_markers.assign(view.face_markers, view.face_markers + view.n_faces);
    mesh.markers.assign(names, names + n_markers);
    return mesh;
}

std::int32_t say_place(const std::string& place, char* text, std::int32_t capacity) {
    if (capacity < 0 || place.size() >= static_cast<std::size_t>(capacity)) return 0;
    say(place.c_str(), text, capacity);
    return 1;
}

}  // namespace

hmpy_file* hmpy_read(const char* path, const char* format, const char* zone, char* text,
                     std::int32_t capacity) {
    return reason_or(text, capacity, [&] {
        auto file = std::make_unique<hmpy_file>(
            hmpy_file{cli::read_mesh_file(path, {1, format, zone, nullptr})});
        cli::number_by_name(file->mesh);
        return file;
    });
}

void hmpy_file_free(hmpy_file* file) { delete file; }

void hmpy_file_mesh(const hmpy_file* file, hm_mesh* mesh) { *mesh = file->mesh.view(); }

std::int32_t hmpy_file_markers(const hmpy_file* file) {
    return static_cast<std::int32_t>(file->mesh.markers.size());
}

const char* hmpy_file_marker(const hmpy_file* file, std::int32_t marker, std::size_t* length) {
    const std::string& name = file->mesh.markers[static_cast<std::size_t>(marker)];
    *length = name.size();
    return name.data();
}

std::int32_t hmpy_file_remarks(const hmpy_file* file) {
    return static_cast<std::int32_t>(file->mesh.remarks.size());
}

const char* hmpy_file_remark(const hmpy_file* file, std::int32_t remark) {
    return file->mesh.remarks[static_cast<std::size_t>(remark)].c_str();
}

hmpy_text* hmpy_moved(const hmpy_file* file, const char* path, const double* x, const double* y,
                      char* text, std::int32_t capacity) {
    return reason_or(text, capacity, [&] {
        cli::moved_file(file->mesh, path);
        std::ostringstream out;
        cli::write_moved(out, file->mesh, x, y);
        return std::make_unique<hmpy_text>(hmpy_text{out.str()});
    });
}

hmpy_text* hmpy_created(const hm_mesh* mesh, std::int32_t n_markers, const char* const* names,
                        const char* path, const char* format, char* text, std::int32_t capacity) {
    return reason_or(text, capacity, [&] {
        const cli::Format& chosen = cli::format_to_create(format, path);
        cli::Mesh copy = copied(*mesh, n_markers, names);
        cli::make_writable(copy, chosen);
        std::ostringstream out;
        chosen.create(out, copy);
        return std::make_unique<hmpy_text>(hmpy_text{out.str()});
    });
}

const char* hmpy_text_bytes(const hmpy_text* written, std::size_t* length) {
    *length = written->bytes.size();
    return written->bytes.data();
}

void hmpy_text_free(hmpy_text* written) { delete written; }

std::int32_t hmpy_place(const char* path, char* text, std::int32_t capacity) {
    return say_place(cli::mesh_file(path), text, capacity);
}

std::int32_t hmpy_names_place(const hmpy_file* file, const char* path, char* text,
                              std::int32_t capacity) {
    return say_place(cli::names_file(file->mesh, path), text, capacity);
}

hmpy_section* hmpy_read_section(const char* path, int32_t element, char* text, int32_t capacity) {
    return reason_or(text, capacity, [&] {
        return std::make_unique<hmpy_section>(hmpy_section{cli::read_section(path, element)});
    });
}

void hmpy_section_free(hmpy_section* section) { delete section; }

int32_t hmpy_section_points(const hmpy_section* section) {
    return static_cast<int32_t>(section->section.x.size());
}
const double* hmpy_section_x(const hmpy_section* section) { return section->section.x.data(); }
const double* hmpy_section_y(const hmpy_section* section) { return section->section.y.data(); }
const char* hmpy_section_layout(const hmpy_section* section) {
    return section->section.layout.c_str();
}
const char* hmpy_section_warning(const hmpy_section* section, int32_t k) {
    const auto& all = section->section.warnings;
    const auto at = static_cast<std::size_t>(k);
    return k >= 0 && at < all.size() ? all[at].c_str() : nullptr;
}
