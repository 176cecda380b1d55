// Spot lights: where they look, and how they fall off.
#pragma once

#include "core/base/vec.h"

namespace neumann::reader::collada {

// What looks along −z of a node, +y up, as it looks along +z of a Mitsuba file; without the node's scale.
Mat4 facing_back(const Mat4& node);

// COLLADA's light falls off as cos^exponent up to the cutoff, Mitsuba's linearly from the angle of its beam to the cutoff: the beam
// with which both give off the same power, or 0 if all are brighter. Degrees.
double spot_beam_width(double cutoff, double exponent);

}  // namespace neumann::reader::collada
