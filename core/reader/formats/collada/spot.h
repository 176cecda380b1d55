// The direction and the falloff of spot lights.
#pragma once

#include "core/base/vec.h"

namespace neumann::reader::collada {

// The to_world of an object that looks along +z, as in a Mitsuba file, for one that looks along −z of a node with +y
// up; without the node's scale.
Mat4 facing_back(const Mat4& node);

// COLLADA's light falls off as cos^exponent up to the cutoff, Mitsuba's linearly from the angle of its beam to the
// cutoff. Returns the beam with which both emit the same power, or 0 if every beam emits more. Degrees.
double spot_beam_width(double cutoff, double exponent);

}  // namespace neumann::reader::collada
