// Finds sides that face nothing, such as the outsides of a room's walls: they exchange no light with other surfaces.
#pragma once

#include "operators/fields/patches/chart.h"

#include <vector>

namespace neumann {

class Facing {
public:
    explicit Facing(const Geometry& geometry);

    // Whether all surfaces lie behind this side of a plane or spherical chart, up to a millionth of the scene's size;
    // false if this is not known.
    bool nothing(const Chart& chart, bool front) const;

private:
    struct Ball {
        Vec3 center;
        double radius;
    };
    const Geometry& geometry_;
    std::vector<Ball> balls_;  // surfaces lie in their convex hull
};

}  // namespace neumann
