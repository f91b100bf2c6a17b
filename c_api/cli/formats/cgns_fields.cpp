#include "formats/cgns_fields.hpp"

#include "formats/cgns.hpp"

#ifdef HARMORPH_CGNS
#include "formats/cgns_file.hpp"

#include <algorithm>

namespace cli {

namespace {

struct CgnsField {
    std::string name, solution;
    int solution_number;  // from 1
};

class CgnsFieldReader {
public:
    explicit CgnsFieldReader(const TextFile& file) : cgns_(file.path(), CG_MODE_READ, file.path()) {
        int cell_dimension = 0;
        zones_ = read_zones(cgns_, file.text().size(), cell_dimension);
        auto places = std::make_shared<TextFile>(file.path(), "");
        places->name_places([zones = zones_](std::size_t row) {
            std::size_t z = zones.size() - 1;
            while (zones[z].first > row) --z;
            return zones[z].point(row - zones[z].first);
        });
        table_.file = places;
    }

    PointTable read() {
        const std::vector<CgnsField> first = fields_of(0, table_.left_out);
        table_.names = {"x", "y", "z"};
        for (const CgnsField& field : first) table_.names.push_back(field.name);
        table_.has_file_points = true;
        const std::size_t rows = zones_.back().first + zones_.back().points();
        table_.values.assign(rows * table_.names.size(), 0.0);
        for (std::size_t row = 0; row < rows; ++row) table_.offsets.push_back(row);
        for (std::size_t z = 0; z < zones_.size(); ++z) {
            const int number = static_cast<int>(z) + 1;
            std::size_t column = 0;
            for (const CgnsArray& array : read_arrays(cgns_, number, in_zone(zones_[z]))) {
                read_array(z, column++, array.name, [&](const cgsize_t* low, const cgsize_t* high) {
                    return cg_coord_read(cgns_.file, cgns_base, number, array.name.c_str(),
                                         RealDouble, low, high, buffer_.data());
                });
            }
            std::string left_out;
            const std::vector<CgnsField> fields = z == 0 ? first : fields_of(z, left_out);
            for (const CgnsField& field : fields) refuse_missing(first, 0, field.name, z);
            for (const CgnsField& wanted : first) {
                const CgnsField& field = refuse_missing(fields, z, wanted.name, 0);
                read_array(z, table_.column(field.name), field.name,
                           [&](const cgsize_t* low, const cgsize_t* high) {
                               return cg_field_read(cgns_.file, cgns_base, number,
                                                    field.solution_number, field.name.c_str(),
                                                    RealDouble, low, high, buffer_.data());
                           });
            }
        }
        return std::move(table_);
    }

private:
    // The arrays at the vertices of a zone. left_out says why arrays of other solutions are none of
    // them.
    std::vector<CgnsField> fields_of(std::size_t z, std::string& left_out) const {
        const int zone = static_cast<int>(z) + 1;
        const std::string where = in_zone(zones_[z]);
        std::vector<CgnsField> fields;
        int n_solutions = 0;
        cgns_(cg_nsols(cgns_.file, cgns_base, zone, &n_solutions), where);
        for (int s = 1; s <= n_solutions; ++s) {
            char name[33] = "";
            GridLocation_t location;
            PointSetType_t set;
            cgsize_t n_listed = 0;
            cgns_(cg_sol_info(cgns_.file, cgns_base, zone, s, name, &location), where);
            cgns_(cg_sol_ptset_info(cgns_.file, cgns_base, zone, s, &set, &n_listed), where);
            if (location != Vertex || set != PointSetTypeNull) {
                left_out += (left_out.empty() ? "" : ", ") + std::string("the solution ") +
                            in_quotes(name) + " is at " +
                            (location != Vertex ? cg_GridLocationName(location) : "some points") +
                            ", not at all vertices";
                continue;
            }
            add_fields(fields, zone, s, name, where);
        }
        if (fields.empty()) {
            cgns_.fail(where + " has no values at its vertices: " +
                       (left_out.empty() ? "it has no FlowSolution_t with arrays" : left_out));
        }
        return fields;
    }

    void add_fields(std::vector<CgnsField>& fields, int zone, int solution,
                    const std::string& solution_name, const std::string& where) const {
        int n = 0;
        cgns_(cg_nfields(cgns_.file, cgns_base, zone, solution, &n), where);
        for (int f = 1; f <= n; ++f) {
            char name[33] = "";
            DataType_t type;
            cgns_(cg_field_info(cgns_.file, cgns_base, zone, solution, f, &type, name), where);
            if (type == Character) continue;
            for (const CgnsField& other : fields) {
                if (other.name != name) continue;
                cgns_.fail(where + ": the solutions " + in_quotes(other.solution) + " and " +
                           in_quotes(solution_name) + " both have the array " + in_quotes(name) +
                           "; keep one of them in the file");
            }
            fields.push_back({name, solution_name, solution});
        }
    }

    const CgnsField& refuse_missing(const std::vector<CgnsField>& fields, std::size_t z,
                                    const std::string& name, std::size_t z_with) const {
        const auto found = std::find_if(fields.begin(), fields.end(),
                                        [&](const CgnsField& field) { return field.name == name; });
        if (found == fields.end()) {
            cgns_.fail(in_zone(zones_[z]) + " has no array " + in_quotes(name) +
                       " at its vertices, but " + in_zone(zones_[z_with]) + " has");
        }
        return *found;
    }

    template <class Read>
    void read_array(std::size_t z, std::size_t column, const std::string& name, const Read& read) {
        cgsize_t low[3], high[3];
        whole_range(zones_[z], low, high);
        buffer_.resize(zones_[z].points());
        cgns_(read(low, high), in_zone(zones_[z]) + ", " + name);
        for (std::size_t k = 0; k < buffer_.size(); ++k)
            table_.values[(zones_[z].first + k) * table_.names.size() + column] = buffer_[k];
    }

    Cgns cgns_;
    std::vector<CgnsZone> zones_;
    std::vector<double> buffer_;  // one array of one zone
    PointTable table_;
};

}  // namespace

PointTable read_cgns_fields(const TextFile& file) { return CgnsFieldReader(file).read(); }

}  // namespace cli
#else
namespace cli {

PointTable read_cgns_fields(const TextFile& file) { refuse_cgns(file); }

}  // namespace cli
#endif
