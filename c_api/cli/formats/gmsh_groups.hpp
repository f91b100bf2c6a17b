// The physical groups of a Gmsh file, from which the markers get their names. The sections that
// define groups may follow the elements that are in them.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

namespace cli {

class GmshGroups {
public:
    // Names a physical group of curves (dimension 1) or surfaces (2).
    void add_name(int dimension, std::int64_t physical, std::string_view name);

    // Puts a curve or a surface into a physical group, as $Entities of version 4.1 does. The sign
    // of the group tells the orientation and is dropped. Returns false if the entity is in too many
    // groups.
    bool add_to_group(int dimension, std::int64_t entity, std::int64_t physical);

    // Returns the index in names() of the elements of an entity, or -1 for elements that are no
    // curve and no surface. physical: the group of the element; 0 if the element has none (version
    // 2), or if the groups are those of the entity (version 4.1).
    std::int32_t find(int dimension, std::int64_t physical, std::int64_t entity);

    // Returns the names for each index that find() returned: the names or numbers of the physical
    // groups, or else "curve:TAG" or "surface:TAG". All sections must have been read.
    std::vector<std::vector<std::string>> names() const;

    static constexpr std::size_t max_groups = 16;  // of one curve or surface

private:
    using Item = std::pair<int, std::int64_t>;  // a dimension, and a number there
    struct Group {
        int dimension;
        std::int64_t physical, entity;
    };
    std::map<Item, std::string> names_;                    // of physical groups
    std::map<Item, std::vector<std::int64_t>> physicals_;  // of entities
    std::map<std::tuple<int, std::int64_t, std::int64_t>, std::int32_t> places_;  // in groups_
    std::vector<Group> groups_;
};

}  // namespace cli
