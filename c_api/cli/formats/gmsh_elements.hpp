// The elements of Gmsh files, by their types.
#pragma once

#include "formats/element_mesh.hpp"

namespace cli {

struct GmshElementType {
    int number;
    ElementShape shape;
};
constexpr GmshElementType element_types[] = {
    {15, {0, 1}},
    {1, {1, 2}},
    {8, {1, 2, "01"}},
    {2, {2, 3}},
    {9, {2, 3, "01 12 20"}},
    {3, {2, 4}},
    {16, {2, 4, "01 12 23 30"}},
    {10, {2, 4, "01 12 23 30 0123"}},
    {4, {3, 4}},
    {11, {3, 4, "01 12 20 30 23 13"}},
    {5, {3, 8}},
    {17, {3, 8, "01 03 04 12 15 23 26 37 45 47 56 67"}},
    {12,
     {3, 8,
      "01 03 04 12 15 23 26 37 45 47 56 67 0321 0154 0473 1265 2376 4567 "
      "01234567"}},
    {6, {3, 6}},
    {18, {3, 6, "01 02 03 12 14 25 34 35 45"}},
    {13, {3, 6, "01 02 03 12 14 25 34 35 45 0143 0352 1254"}},
    {7, {3, 5}},
    {19, {3, 5, "01 03 04 12 14 23 24 34"}},
    {14, {3, 5, "01 03 04 12 14 23 24 34 0321"}}};

// Returns the shape of a type of elements, or NULL if the type is not read.
inline const ElementShape* gmsh_element(std::int64_t number) {
    for (const GmshElementType& type : element_types) {
        if (type.number == number) return &type.shape;
    }
    return nullptr;
}

}  // namespace cli
