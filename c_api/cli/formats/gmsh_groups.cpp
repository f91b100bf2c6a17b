#include "formats/gmsh_groups.hpp"

#include <cstdlib>

namespace cli {

namespace {

bool has_groups(int dimension) { return dimension == 1 || dimension == 2; }

}  // namespace

void GmshGroups::add_name(int dimension, std::int64_t physical, std::string_view name) {
    // A group whose name is empty is selected by its number, as one without a name.
    if (has_groups(dimension) && !name.empty()) names_[{dimension, physical}] = name;
}

bool GmshGroups::add_to_group(int dimension, std::int64_t entity, std::int64_t physical) {
    if (!has_groups(dimension)) return true;
    std::vector<std::int64_t>& groups = physicals_[{dimension, entity}];
    groups.push_back(std::abs(physical));
    return groups.size() <= max_groups;
}

std::int32_t GmshGroups::find(int dimension, std::int64_t physical, std::int64_t entity) {
    if (!has_groups(dimension)) return -1;
    const auto known =
        places_.emplace(std::make_tuple(dimension, physical, physical == 0 ? entity : 0),
                        static_cast<std::int32_t>(groups_.size()));
    if (known.second) groups_.push_back({dimension, physical, entity});
    return known.first->second;
}

std::vector<std::vector<std::string>> GmshGroups::names() const {
    std::vector<std::vector<std::string>> result;
    for (const Group& group : groups_) {
        std::vector<std::int64_t> physicals;
        if (group.physical != 0) physicals.push_back(group.physical);
        const auto of_entity = physicals_.find({group.dimension, group.entity});
        if (group.physical == 0 && of_entity != physicals_.end()) physicals = of_entity->second;
        std::vector<std::string> names;
        for (const std::int64_t physical : physicals) {
            const auto name = names_.find({group.dimension, physical});
            names.push_back(name == names_.end() ? std::to_string(physical) : name->second);
        }
        const char* const kind = group.dimension == 1 ? "curve:" : "surface:";
        if (names.empty()) names.push_back(kind + std::to_string(group.entity));
        result.push_back(names);
    }
    return result;
}

}  // namespace cli
