#include "library.hpp"

#include "failure.hpp"

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

// The word before a number in a sentence: "cell" for 12 in "cell 12 is inverted".
std::string word_before(std::int32_t number, const std::string& sentence) {
    std::istringstream words(sentence);
    std::string before, word;
    while (words >> word) {
        if (word.find_last_not_of(",.:;") != std::string::npos) word.resize(word.find_last_not_of(",.:;") + 1);
        if (word == std::to_string(number)) return before;
        before = word;
    }
    return "";
}

// The library counts as the file does. What error.item counts stands in its sentence.
std::string place(const hm_error& error, const Mesh& mesh) {
    const std::string kind = word_before(error.item, error.text);
    const auto line_of = [&](const std::vector<std::size_t>& offsets) {
        const bool exists = error.item >= 0 && static_cast<std::size_t>(error.item) < offsets.size();
        return exists ? mesh.file.place(offsets[static_cast<std::size_t>(error.item)]) : mesh.file.path();
    };
    if (kind == "cell" || kind == "cells") return line_of(mesh.cell_offset);
    if (kind == "face" || kind == "faces") return line_of(mesh.face_offset);
    if (kind == "point" || kind == "points") return line_of(mesh.point_offset);
    return mesh.file.path();
}

} // namespace

void Block::resize(std::size_t bytes) {
    if (!memory_ || bytes > capacity_) {
        memory_.reset(); // first, so that old and new are never there together
        memory_.reset(new unsigned char[bytes]);
        capacity_ = bytes;
    }
    size_ = bytes;
}

void refuse(const hm_error& error, const std::string& path) {
    throw Failure(exit_code(error.code), path + ": " + error.text);
}

void refuse(const hm_error& error, const Mesh& mesh) {
    const bool of_the_mesh = error.code == HM_BAD_MESH || error.code == HM_NOT_POSITIVE;
    throw Failure(exit_code(error.code), (of_the_mesh ? place(error, mesh) + ": " : std::string()) + error.text);
}

} // namespace cli
