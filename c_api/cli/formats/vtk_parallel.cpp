#include "formats/vtk_parallel.hpp"

#include "basics/failure.hpp"
#include "files/paths.hpp"
#include "formats/vtk_xml_file.hpp"

#include <algorithm>
#include <set>
#include <system_error>

namespace cli {

namespace {

constexpr std::string_view parallel_type = "PUnstructuredGrid";

std::string piece_path(const TextFile& parallel, const std::string& source) {
    return path_in(folder_of(parallel.path()), source);
}

class JoinedPieces {
public:
    explicit JoinedPieces(const TextFile& parallel) : parallel_(parallel) {}
    TextFile join();

private:
    struct Segment {  // a part of the text that was copied from a file
        std::size_t begin, begin_in_file;
        std::string path;
    };

    void add_file(const XmlTag& tag);
    void add_pieces(const TextFile& file);
    void read_head(const TextFile& file, const XmlTag& tag);
    void copy(const TextFile& file, std::size_t begin, std::size_t end, std::string& to);
    void add_appended(const TextFile& file, const XmlTag& tag);

    const TextFile& parallel_;
    std::set<std::string> names_;
    std::string text_, appended_, head_;
    std::string appended_kind_;         // the attribute "encoding"; empty: no appended data yet
    VtkEncoding encoding_;              // of the first piece
    std::vector<Segment> segments_;     // of text_
    std::vector<Segment> in_appended_;  // of appended_
};

TextFile JoinedPieces::join() {
    XmlReader tags(parallel_);
    while (tags.next()) {
        const XmlTag& tag = tags.tag();
        const std::string_view level = tag.attribute("GhostLevel");
        if (tag.name == parallel_type && !level.empty() && trimmed(level) != "0") {
            parallel_.fail(tag.begin, "the pieces have ghost cells (GhostLevel " +
                                          in_quotes(level) +
                                          "), so they overlap; save the grid without ghost cells");
        }
        if (tag.name == "Piece") add_file(tag);
    }
    if (names_.empty())
        parallel_.fail(parallel_.text().size(),
                       "the file needs <Piece here, but the end of the file follows");
    text_ += "</UnstructuredGrid>\n";
    if (!appended_kind_.empty()) {
        text_ += "<AppendedData encoding=\"" + appended_kind_ + "\">\n_";
        for (Segment& segment : in_appended_) segment.begin += text_.size();
        segments_.insert(segments_.end(), in_appended_.begin(), in_appended_.end());
        text_ += appended_ + "\n</AppendedData>\n";
    }
    TextFile joined(parallel_.path(), text_ + "</VTKFile>\n");
    joined.name_places([segments = segments_](std::size_t offset) {
        const auto after =
            std::upper_bound(segments.begin(), segments.end(), offset,
                             [](std::size_t at, const Segment& one) { return at < one.begin; });
        const Segment& segment = after == segments.begin() ? *after : *(after - 1);
        return TextFile(segment.path)
            .place(segment.begin_in_file + offset - std::min(offset, segment.begin));
    });
    return joined;
}

void JoinedPieces::add_file(const XmlTag& tag) {
    const std::string source = xml_decoded(tag.attribute("Source"));
    if (source.empty()) parallel_.fail(tag.begin, "the piece has no attribute Source");
    const std::string path = piece_path(parallel_, source);
    if (!names_.insert(normal_path(path)).second)
        parallel_.fail(tag.begin, "the file " + in_quotes(source) + " is named a second time");
    if (!is_regular_file(path))
        parallel_.fail(tag.begin,
                       "the file " + in_quotes(source) + " of this piece does not exist");
    add_pieces(TextFile(path));
}

void JoinedPieces::copy(const TextFile& file, std::size_t begin, std::size_t end, std::string& to) {
    (&to == &text_ ? segments_ : in_appended_).push_back({to.size(), begin, file.path()});
    to.append(file.text(), begin, end - begin);
}

void JoinedPieces::read_head(const TextFile& file, const XmlTag& tag) {
    const std::string_view type = tag.attribute("type");
    if (type != "UnstructuredGrid") {
        file.fail(tag.begin,
                  "the type of a piece must be UnstructuredGrid, not " + in_quotes(type));
    }
    const VtkEncoding encoding = vtk_encoding(file, tag);
    if (text_.empty()) {
        encoding_ = encoding;
        copy(file, tag.begin, tag.end, text_);
        text_ += "\n<UnstructuredGrid>\n";
    }
    if (encoding.swapped != encoding_.swapped || encoding.compressor != encoding_.compressor ||
        encoding.header_bytes != encoding_.header_bytes) {
        file.fail(tag.begin,
                  "the piece differs from the first one in byte_order, header_type or compressor; "
                  "save all pieces with the same settings");
    }
}

// Copies <Piece ...> ... </Piece>, with other offsets of appended arrays.
void JoinedPieces::add_pieces(const TextFile& file) {
    XmlReader tags(file);
    std::size_t copied = 0;  // 0: not inside a piece
    bool has_head = false;
    const auto copy_to = [&](std::size_t end) {
        if (copied > 0) copy(file, copied, end, text_);
        copied = end;
    };
    const std::size_t before = appended_.size();
    while (tags.next() && tags.tag().name != "AppendedData") {
        const XmlTag& tag = tags.tag();
        if (tag.name == "VTKFile") {
            read_head(file, tag);
            has_head = true;
        } else if (!has_head) {
            file.fail(tag.begin, "the file needs <VTKFile here");
        } else if (tag.name == "Piece" && copied == 0) {
            copied = tag.begin;
        }
        if (tag.name == "/Piece" || (tag.name == "Piece" && tag.is_empty)) {
            copy_to(tag.end);
            copied = 0;
            text_ += '\n';
        }
        const std::string_view offset = tag.attribute("offset");
        if (tag.name != "DataArray" || copied == 0 || offset.empty()) continue;
        copy_to(static_cast<std::size_t>(offset.data() - file.text().data()));
        text_ += std::to_string(before + appended_offset(file, tag));
        copied += offset.size();
    }
    if (!has_head)
        file.fail(file.text().size(),
                  "the file needs <VTKFile here, but the end of the file follows");
    if (copied > 0) file.fail(copied, "the piece has no end </Piece>");
    if (tags.tag().name == "AppendedData") add_appended(file, tags.tag());
}

void JoinedPieces::add_appended(const TextFile& file, const XmlTag& tag) {
    VtkEncoding encoding;
    find_appended(file, tag, encoding);
    const std::string kind(tag.attribute("encoding"));
    if (!appended_kind_.empty() && kind != appended_kind_)
        file.fail(tag.begin, "the appended data of the pieces have different encodings");
    appended_kind_ = kind;
    const std::size_t end = file.text().rfind("</AppendedData");
    if (end == std::string::npos || end < encoding.appended)
        file.fail(tag.begin, "the appended data have no end </AppendedData>");
    copy(file, encoding.appended, end, appended_);
}

}  // namespace

bool is_parallel_vtk(const TextFile& file) {
    XmlReader tags(file);
    return tags.next() && tags.tag().name == "VTKFile" &&
           tags.tag().attribute("type") == parallel_type;
}

TextFile joined_pieces(const TextFile& parallel) { return JoinedPieces(parallel).join(); }

std::vector<std::string> piece_files(const std::string& parallel) {
    std::vector<std::string> paths;
    try {
        const TextFile file(parallel);
        XmlReader tags(file);
        while (tags.next()) {
            const std::string source = xml_decoded(tags.tag().attribute("Source"));
            if (!source.empty()) paths.push_back(piece_path(file, source));
        }
    } catch (const Failure&) {
        paths.clear();  // The reader of the mesh says what is wrong with the file.
    }
    return paths;
}

}  // namespace cli
