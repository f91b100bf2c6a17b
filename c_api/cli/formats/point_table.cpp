#include "formats/point_table.hpp"

#include "basics/elementary.hpp"
#include "basics/failure.hpp"
#include "basics/numbers.hpp"
#include "files/text_file.hpp"
#include "formats/bytes.hpp"
#include "formats/cgns.hpp"
#include "formats/cgns_fields.hpp"
#include "formats/deflate.hpp"
#include "formats/foam_list.hpp"
#include "formats/number_reader.hpp"
#include "formats/vtk_cells.hpp"
#include "formats/vtk_parallel.hpp"
#include "formats/vtk_xml_file.hpp"
#include "mesh/point_numbers.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace cli {

namespace {

// Fields at the points of a mesh in the files of VTK (.vtk, .vtu) and OpenFOAM (pointVectorField),
// as tables: the columns x, y, z of the coordinates (VTK), NAME of an array of one number, and
// NAME_x, NAME_y, NAME_z of vectors. The vectors of OpenFOAM have the name Sensitivity.

constexpr const char* component_names[] = {"_x", "_y", "_z"};

// Columns of the same length, which become the rows of a table.
class Columns {
public:
    // values [n * components], point by point. Arrays of more than three components are ignored.
    void add(const std::string& name, std::size_t components, const std::vector<double>& values) {
        if (components < 1 || components > 3) return;
        for (std::size_t d = 0; d < components; ++d) {
            names_.push_back(components == 1 ? name : name + component_names[d]);
            columns_.emplace_back();
            for (std::size_t k = d; k < values.size(); k += components)
                columns_.back().push_back(values[k]);
        }
    }
    void add_coordinates(const std::vector<double>& values) {
        const std::size_t first = names_.size();
        add("", 3, values);
        for (std::size_t d = 0; d < 3; ++d) names_[first + d] = component_names[d][1];
    }
    // Appends the columns of another piece of the file, which must have the same names.
    bool append(const Columns& other) {
        if (other.names_ != names_) return false;
        for (std::size_t c = 0; c < columns_.size(); ++c)
            columns_[c].insert(columns_[c].end(), other.columns_[c].begin(),
                               other.columns_[c].end());
        return true;
    }
    PointTable table(const std::shared_ptr<const TextFile>& file) const {
        PointTable table;
        table.file = file;
        table.names = names_;
        table.has_file_points = true;
        const std::size_t rows = columns_.empty() ? 0 : columns_[0].size();
        for (std::size_t row = 0; row < rows; ++row)
            for (const std::vector<double>& column : columns_) table.values.push_back(column[row]);
        return table;
    }

private:
    std::vector<std::string> names_;
    std::vector<std::vector<double>> columns_;
};

// ---- VTK XML

int bytes_of_type(const std::string& type) {
    return type == "Float32" ? 4 : type == "Float64" ? 8 : 0;
}

std::vector<double> numbers_of(const TextFile& file, const VtkEncoding& as, const VtkArray& array,
                               const std::string& name, std::int64_t n) {
    const int bytes = bytes_of_type(array.type);
    std::string decoded;
    std::size_t begin = array.begin, end = array.end;
    const bool is_binary = array.is_binary || array.is_appended;
    if (array.is_encoded(as)) {
        decoded = file.text();
        const VtkDecoded found = decode_vtk(
            file, as, array, name, static_cast<std::size_t>(n * array.number_bytes()), decoded);
        begin = found.bytes;
        end = found.bytes_end;
    } else if (array.is_appended) {
        const std::size_t size = file.text().size(),
                          header = static_cast<std::size_t>(as.header_bytes);
        if (as.appended == 0 || array.begin + as.appended + header > size)
            file.fail(array.tag, "the array " + name + " is not in the file");
        const char* const head = file.text().data() + as.appended + array.begin;
        const std::int64_t length = as.header_bytes == 8 ? load<std::int64_t>(head, as.swapped)
                                                         : load<std::uint32_t>(head, as.swapped);
        begin = as.appended + array.begin + header;
        if (length < 0 || static_cast<std::size_t>(length) > size - begin)
            file.fail(array.tag, "the array " + name + " is longer than the file");
        end = begin + static_cast<std::size_t>(length);
    }
    const TextFile text = decoded.empty() ? file : TextFile(file.path(), std::move(decoded));
    NumberReader reader(text);
    reader.is_binary = is_binary;
    reader.swapped = as.swapped;
    reader.jump(begin);
    reader.stop_at(end);
    std::vector<double> values;
    while (!reader.at_end()) values.push_back(reader.real("a finite number", bytes));
    return values;
}

Columns piece_columns(const TextFile& file, const VtkEncoding& as, const VtkPiece& piece) {
    Columns columns;
    const auto add = [&](const std::string& name, const VtkArray& array) {
        if (bytes_of_type(array.type) == 0) return;
        std::int64_t components = 1;
        if (!array.components.empty() && !parse(array.components, components)) components = 0;
        if (components < 1 || components > 3) return;
        const std::vector<double> values =
            numbers_of(file, as, array, name, components * piece.n_points);
        if (static_cast<std::int64_t>(values.size()) != components * piece.n_points) {
            file.fail(array.tag, "the array " + name + " has " +
                                     plural(static_cast<std::int64_t>(values.size()), "number") +
                                     ", not those of " + plural(piece.n_points, "point"));
        }
        if (name.empty()) columns.add_coordinates(values);
        else columns.add(name, static_cast<std::size_t>(components), values);
    };
    if (!piece.points.is_there || piece.points.components != "3")
        file.fail(piece.tag, "expected points with NumberOfComponents=\"3\"");
    add("", piece.points);
    for (const auto& [name, array] : piece.point_data) add(name, array);
    return columns;
}

PointTable read_vtk_xml(const std::shared_ptr<const TextFile>& file) {
    if (is_parallel_vtk(*file)) {
        file->fail(0,
                   "fields in the pieces of a file .pvtu are not read, because pieces repeat the "
                   "points where they meet; join the pieces and these points in one file .vtu "
                   "(ParaView: Clean to Grid)");
    }
    const VtkXmlFile content = read_vtk_xml_tags(*file);
    Columns all;
    for (std::size_t k = 0; k < content.pieces.size(); ++k) {
        const Columns piece = piece_columns(*file, content.encoding, content.pieces[k]);
        if (k == 0) all = piece;
        else if (!all.append(piece))
            file->fail(content.pieces[k].tag, "this piece has other arrays than the first one");
    }
    return all.table(file);
}

// ---- VTK legacy

class LegacyReader {
public:
    explicit LegacyReader(const TextFile& file) : file_(file), numbers_(file) {
        numbers_.swapped = little_endian_machine();
    }

    Columns read() {
        const std::string_view text = file_.text();
        is_binary_ = text.find("\nBINARY") < text.find("\nDATASET");
        jump_after("\nPOINTS ", 0);
        n_ = numbers_.count("the number of points");
        columns_.add_coordinates(array(3));
        jump_after("\nPOINT_DATA ", numbers_.offset());
        if (numbers_.count("the number of points") != n_)
            numbers_.expected("the number of points, " + std::to_string(n_));
        while (read_section()) {}
        return columns_;
    }

private:
    void jump_after(const std::string& name, std::size_t from) {
        const std::size_t at = file_.text().find(name, from);
        if (at == std::string::npos)
            file_.fail(0, "the file has no section" + name.substr(0, name.size() - 1));
        numbers_.jump(at + name.size());
    }
    bool read_section() {
        const std::string kind(numbers_.word());
        if (kind == "VECTORS" || kind == "NORMALS") {
            const std::string name(numbers_.word());
            columns_.add(name, 3, array(3));
        } else if (kind == "SCALARS") {
            const std::string name(numbers_.word()), type(numbers_.word());
            const std::string components = rest_of_line();
            std::int64_t n = 1;
            if (!components.empty() && (!parse(components, n) || n < 1 || n > 4))
                numbers_.fail("the array " + name + " must have 1 to 4 components, not " +
                              in_quotes(components));
            const std::size_t here = numbers_.offset();
            if (numbers_.word() != "LOOKUP_TABLE") numbers_.jump(here);
            else rest_of_line();
            columns_.add(name, static_cast<std::size_t>(n),
                         array_of(type, static_cast<std::size_t>(n)));
        } else if (kind == "FIELD") {
            numbers_.word();
            const std::int64_t arrays = numbers_.count("the number of arrays");
            for (std::int64_t k = 0; k < arrays; ++k) {
                const std::string name(numbers_.word());
                const std::int64_t components = numbers_.count("a number of components");
                if (numbers_.count("the number of points") != n_)
                    numbers_.expected("the number of points, " + std::to_string(n_));
                columns_.add(name, static_cast<std::size_t>(components),
                             array(static_cast<std::size_t>(components)));
            }
        } else if (kind == "METADATA") {
            const std::size_t end = file_.text().find("\n\n", numbers_.offset());
            if (end == std::string::npos) return false;
            numbers_.jump(end + 2);
        } else {
            return false;  // the end of the file, or the beginning of data that are not read
        }
        return true;
    }
    std::size_t end_of_line() const {
        return std::min(file_.text().find('\n', numbers_.offset()), file_.text().size());
    }
    std::string rest_of_line() {
        const std::size_t begin = numbers_.offset(), end = end_of_line();
        numbers_.jump(end);
        return std::string(trimmed(file_.text().substr(begin, end - begin)));
    }
    std::vector<double> array(std::size_t components) {
        return array_of(std::string(numbers_.word()), components);
    }
    std::vector<double> array_of(const std::string& type, std::size_t components) {
        const bool is_long = type == "vtktypeint64" || type == "long";
        const bool is_real = type == "float" || type == "double";
        if (!is_real && !is_long && type != "int" && type != "vtktypeint32")
            numbers_.expected("an array of type float, double or int");
        const int bytes = type == "double" || is_long ? 8 : 4;
        if (is_binary_) numbers_.jump(std::min(end_of_line() + 1, file_.text().size()));
        numbers_.is_binary = is_binary_;
        std::vector<double> values;
        for (std::size_t k = 0; k < static_cast<std::size_t>(n_) * components; ++k) {
            values.push_back(is_real
                                 ? numbers_.real("a finite number", bytes)
                                 : static_cast<double>(numbers_.whole("a whole number", bytes)));
        }
        numbers_.is_binary = false;
        return values;
    }

    const TextFile& file_;
    NumberReader numbers_;
    bool is_binary_ = false;
    std::int64_t n_ = 0;
    Columns columns_;
};

// ---- OpenFOAM

PointTable read_foam_field(const std::shared_ptr<const TextFile>& file) {
    FoamReader reader(*file);
    if (reader.header().type != "pointVectorField") {
        file->fail(0, "expected a file of OpenFOAM of the class pointVectorField, found " +
                          in_quotes(reader.header().type));
    }
    std::string_view word = reader.word();
    while (!word.empty() && word != "internalField") word = reader.word();
    reader.expect("nonuniform");
    reader.expect("List<vector>");
    std::array<std::vector<double>, 3> x;
    std::array<std::vector<std::size_t>, 3> offsets;
    reader.vectors(x, offsets);
    std::vector<double> values;
    for (std::size_t k = 0; k < x[0].size(); ++k)
        values.insert(values.end(), {x[0][k], x[1][k], x[2][k]});
    Columns columns;
    columns.add("Sensitivity", 3, values);
    PointTable table = columns.table(file);
    table.offsets = offsets[0];
    return table;
}

bool is_point_fields(const TextFile& file) {
    FoamHeader header;
    return is_vtk_legacy(file) || is_vtk_xml(file) || read_foam_header(file, header);
}

PointTable read_point_fields(const std::shared_ptr<const TextFile>& file) {
    if (is_vtk_xml(*file)) return read_vtk_xml(file);
    if (is_vtk_legacy(*file)) return LegacyReader(*file).read().table(file);
    return read_foam_field(file);
}

// ---- SU2's restart files: five integers, names of 33 characters, numbers point by point

constexpr std::int32_t restart_magic = 535532;
constexpr std::size_t restart_header = 5 * sizeof(std::int32_t), restart_name = 33;

bool is_restart(std::string_view text) {
    return text.size() >= restart_header &&
           load<std::int32_t>(text.data(), !little_endian_machine()) == restart_magic;
}

PointTable read_restart(const std::shared_ptr<const TextFile>& file) {
    const std::string_view text = file->text();
    const auto number = [&](std::size_t at) {
        return load<std::int32_t>(text.data() + at * sizeof(std::int32_t),
                                  !little_endian_machine());
    };
    PointTable table;
    table.file = file;
    const std::int64_t columns = number(1), rows = number(2);
    const auto size = static_cast<std::int64_t>(text.size());
    const std::int64_t names = columns * static_cast<std::int64_t>(restart_name);
    const std::int64_t left = size - static_cast<std::int64_t>(restart_header) - names;
    if (columns < 1 || rows < 1 || rows > left / 8 / columns) {
        throw Failure(exit_file, file->path() + ": this SU2 restart file announces " +
                                     std::to_string(rows) + " points with " +
                                     std::to_string(columns) + " numbers each, but is shorter");
    }
    for (std::int64_t k = 0; k < columns; ++k) {
        const char* const name =
            text.data() + restart_header + static_cast<std::size_t>(k) * restart_name;
        table.names.emplace_back(name, std::find(name, name + restart_name, '\0'));
    }
    const char* at = text.data() + restart_header + static_cast<std::size_t>(names);
    table.values.reserve(static_cast<std::size_t>(rows * columns));
    for (std::int64_t i = 0; i < rows * columns; ++i, at += 8)
        table.values.push_back(load<double>(at, !little_endian_machine()));
    return table;
}

// ---- Text

PointTable read_csv(const std::shared_ptr<const TextFile>& file) {
    PointTable table;
    table.file = file;
    CsvReader records(*file);
    if (records.next()) table.names = records.cells();
    while (records.next()) {
        const std::vector<std::string>& cells = records.cells();
        if (cells.size() != table.names.size()) {
            records.fail("the file needs " +
                         plural(static_cast<std::int64_t>(table.names.size()), "column") +
                         " as in the first line here, but " +
                         plural(static_cast<std::int64_t>(cells.size()), "column") + " follow");
        }
        for (std::size_t k = 0; k < cells.size(); ++k) {
            double value = 0;
            if (!parse(trimmed(cells[k]), value)) {
                records.fail("the file needs a finite number for " + in_quotes(table.names[k]) +
                             " here, but " + in_quotes(cells[k]) + " follows");
            }
            table.values.push_back(value);
        }
        table.offsets.push_back(records.offset());
    }
    return table;
}

PointTable read_plain(const std::shared_ptr<const TextFile>& file) {
    PointTable table;
    table.file = file;
    table.names = {"point", "Sensitivity_x", "Sensitivity_y"};
    LineReader lines(*file, '#');
    while (lines.next()) {
        if (lines.words().size() != 3) lines.expected("point dJ/dx dJ/dy");
        for (std::size_t k = 0; k < 3; ++k) {
            const std::string_view word = lines.words()[k];
            double value = 0;
            if (!parse(word, value))
                lines.expected("a finite number for " + in_quotes(table.names[k]), word);
            table.values.push_back(value);
        }
        table.offsets.push_back(lines.offset());
    }
    return table;
}

}  // namespace

std::size_t PointTable::find(const std::string& name) const {
    auto found = std::find(names.begin(), names.end(), name);
    const std::size_t end = name.size() - std::min<std::size_t>(name.size(), 2);
    for (const char* component : {"_xX0", "_yY1", "_zZ2"}) {
        if (name.compare(end, 2, component, 2) != 0) continue;
        const std::string stem = name.substr(0, end);
        for (const std::string& other :
             {stem + component[2], stem + ':' + component[3], stem + '_' + component[3]})
            if (found == names.end()) found = std::find(names.begin(), names.end(), other);
    }
    return static_cast<std::size_t>(found - names.begin());
}

std::size_t PointTable::column(const std::string& name) const {
    const std::size_t found = find(name);
    if (std::count(names.begin(), names.end(), name) > 1)
        throw Failure(exit_file, file->path() + ": two columns have the name " + in_quotes(name));
    if (found < names.size()) return found;
    throw Failure(exit_file, file->path() + ": there is no column " + in_quotes(name) +
                                 "; the columns are " + name_list() +
                                 (left_out.empty() ? "" : "; " + left_out));
}

std::string PointTable::name_list() const {
    std::string list;
    for (const std::string& name : names) list += (list.empty() ? "" : ", ") + in_quotes(name);
    return list;
}

PointColumns PointTable::point_columns() const {
    PointColumns columns = find_point_columns(names);
    if (has_file_points) columns.number = PointColumns::none;
    return columns;
}

std::string PointTable::place(std::size_t row) const {
    return offsets.empty() ? file->path() + ": point " + std::to_string(row)
                           : file->place(offsets[row]);
}

bool is_plain_table(const TextFile& file) {
    if (is_point_fields(file) || is_cgns(file) || is_restart(file.text())) return false;
    CsvReader records(file);
    return !records.next() || records.cells().size() == 1;
}

PointTable read_point_table(const std::shared_ptr<const TextFile>& file) {
    if (is_point_fields(*file)) return read_point_fields(file);
    if (is_cgns(*file)) return read_cgns_fields(*file);
    if (is_restart(file->text())) return read_restart(file);
    const PointTable table = is_plain_table(*file) ? read_plain(file) : read_csv(file);
    if (table.rows() == 0) file->fail(0, "the file has no numbers");
    return table;
}

PointTable read_point_table(const std::string& path) {
    return read_point_table(std::make_shared<const TextFile>(read_unpacked(path)));
}

}  // namespace cli
