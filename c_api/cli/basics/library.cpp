#include "basics/library.hpp"

#include "basics/failure.hpp"
#include "basics/marker_names.hpp"
#include "basics/numbers.hpp"

#include <new>
#include <sstream>

namespace cli {

namespace {

ExitCode exit_code(hm_status status) {
    switch (status) {
        case HM_BAD_MESH:
        case HM_BAD_CURVE:
        case HM_BAD_BASIS: return exit_file;
        case HM_BAD_ARGUMENT:
        case HM_BAD_CONDITION:
        case HM_UNSUPPORTED: return exit_usage;
        default: return exit_unusable;
    }
}

// The line of the first cell, face or point that the sentence names; the library counts as the file
// does.
std::string place_named_in(const std::string& sentence, const Mesh& mesh) {
    std::istringstream words(sentence);
    std::string kind, word;
    while (words >> word) {
        if (word.find_last_not_of(",.:;") != std::string::npos)
            word.resize(word.find_last_not_of(",.:;") + 1);
        const std::vector<std::size_t>* offsets = nullptr;
        if (kind == "cell" || kind == "cells") offsets = &mesh.cell_offset;
        if (kind == "face" || kind == "faces") offsets = &mesh.face_offset;
        if (kind == "point" || kind == "points") offsets = &mesh.point_offset;
        std::int32_t number = -1;
        if (offsets != nullptr && parse(word, number) && number >= 0 &&
            static_cast<std::size_t>(number) < offsets->size()) {
            return mesh.file.place((*offsets)[static_cast<std::size_t>(number)]);
        }
        kind = word;
    }
    return mesh.file.path();
}

}  // namespace

void Block::resize(std::size_t bytes) {
    if (!memory_ || bytes > capacity_) {
        memory_.reset();  // first, so that old and new are never there together
        data_ = nullptr;
        capacity_ = 0;
        memory_.reset(std::malloc(hm_pages_room(bytes)));
        if (!memory_) throw std::bad_alloc();
        data_ = static_cast<unsigned char*>(hm_pages_place(memory_.get(), bytes));
        capacity_ = bytes;
    }
    size_ = bytes;
}

void refuse(const hm_error& error, const std::string& path) {
    throw Failure(exit_code(error.code), path + ": " + error.text);
}

void refuse(const hm_error& error, const Mesh& mesh) {
    const bool of_the_mesh = error.code == HM_BAD_MESH || error.code == HM_NOT_POSITIVE ||
                             error.code == HM_BAD_CONDITION;
    const std::string place = of_the_mesh ? place_named_in(error.text, mesh) + ": " : std::string();
    throw Failure(exit_code(error.code), place + name_markers(error.text, mesh.markers));
}

}  // namespace cli
