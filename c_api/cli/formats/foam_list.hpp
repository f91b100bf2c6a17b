// OpenFOAM's files: a header that says how numbers are stored, then one list, in text or binary.
#pragma once

#include "mesh/mesh_file.hpp"

#include <array>

namespace cli {

struct FoamHeader {
    bool is_binary = false;
    int label_bytes = 4, scalar_bytes = 8;
    std::string type;     // the entry "class"
    std::size_t end = 0;  // the place after the header
};

// Reads the header of a file of OpenFOAM. Returns false if the file has none.
bool read_foam_header(const TextFile& file, FoamHeader& header);

// Reads a file word by word. Brackets and semicolons are words; comments are skipped.
class FoamReader {
public:
    explicit FoamReader(const TextFile& file);

    const FoamHeader& header() const { return header_; }
    std::string_view word();               // the next word; empty at the end
    std::int64_t count(const char* what);  // the next number, not negative
    void expect(std::string_view wanted);  // refuses another word
    bool is_next(
        std::string_view wanted);  // tells whether this word follows; it stays the next one
    std::size_t offset() const { return word_; }
    [[noreturn]] void fail(const std::string& message) const { file_.fail(word_, message); }
    [[noreturn]] void expected(std::string_view what) const;

    // Reads a list of at most max_count whole numbers: N (...), N {value} or binary.
    std::vector<std::int64_t> labels(std::int64_t max_count);
    // Reads a faceList or faceCompactList: the first place of each face in `points`, the points of
    // all faces, and the place of each face in the file.
    void faces(std::vector<std::int64_t>& start, std::vector<std::int64_t>& points,
               std::vector<std::size_t>& offsets);
    void vectors(std::array<std::vector<double>, 3>& x,
                 std::array<std::vector<std::size_t>, 3>& offsets);

private:
    void skip();
    const char* binary(std::int64_t n, int bytes, const char* what);  // ( n numbers )
    std::int64_t label_at(const char* at) const;

    const TextFile& file_;
    FoamHeader header_;
    std::size_t at_ = 0, word_ = 0;
};

}  // namespace cli
