// The area of each shape, and of its largest face. The faces of a mesh that stands in the scene at several places are looked at
// once, unless a place stretches it in one direction more than in others.
#pragma once

#include "core/geometry/geometry.h"

#include <vector>

namespace neumann {

struct ShapeArea {
    double area = 0.0;
    double largest_face = 0.0;  // a bound, on instances that are stretched
    // Of an instance: each face has the same share of the area as in the mesh.
    bool keeps_shares = false;
};

std::vector<ShapeArea> shape_areas(const Geometry& geometry);
double sum_of_areas(const std::vector<ShapeArea>& shapes);

}  // namespace neumann
