#include "refusal.hpp"

#include "OStringStream.H"

namespace Foam {

point Refusal::point_at(label number) const {
    return mesh_.position(info_.space_point ? info_.space_point[number] : number);
}

point Refusal::cell_at(label number) const {
    const hm_space_mesh space = mesh_.view();
    return mesh_.position(space.face_points[space.face_start[number]]);
}

string Refusal::place_of(std::int32_t kind, label number) const {
    OStringStream text;
    if (kind == HM_ITEM_MARKER && number >= 0 && number < patches_.size()) {
        text << " The marker " << number << " is the patch " << patches_[number] << '.';
    } else if (kind == HM_ITEM_POINT && number >= 0) {
        text << " The point " << number << " is at " << point_at(number) << " in points0.";
    } else if (kind == HM_ITEM_CELL && number >= 0) {
        text << " The first corner of the cell " << number << " is at " << cell_at(number)
             << " in points0.";
    }
    return text.str();
}

void Refusal::refuse(const char* what, const hm_error& error) const {
    FatalErrorInFunction << "harmorph cannot " << what << ": " << error.text << " ("
                         << hm_status_name(error.code) << ")."
                         << place_of(error.item_kind, error.item).c_str()
                         << place_of(error.other_kind, error.other).c_str() << exit(FatalError);
}

void Refusal::check(hm_status status, const char* what, const hm_error& error) const {
    if (status < 0) refuse(what, error);
}

}  // namespace Foam
