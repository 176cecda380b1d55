// The area of each shape, and of its largest face. The faces of a mesh that stands in the scene at several places are
// added up once, unless an instance stretches the mesh in one direction more than in others.
#pragma once

#include "core/geometry/geometry.h"

#include <vector>

namespace neumann {

struct ShapeArea {
    double area = 0.0;
    double largest_face = 0.0;  // only an upper bound for instances that are stretched
    // Whether each face of an instance has the same share of the area as in the mesh.
    bool keeps_shares = false;
};

std::vector<ShapeArea> shape_areas(const Geometry& geometry);
double sum_of_areas(const std::vector<ShapeArea>& shapes);

}  // namespace neumann
