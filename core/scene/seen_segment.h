// A line in the scene as the camera sees it.
#pragma once

#include "core/scene/scene.h"

#include <vector>

namespace neumann {

struct SeenPiece {
    Vec2 from, to;  // positions on the film, which may be beyond its edges
    bool hidden;    // whether a surface is in front of it
};

// The pieces of the line from a to b, cut where surfaces come in between, up to 2⁻²⁰ of its length; surfaces that hide less than
// 1/64 of it may be overlooked. What is not between the near and the far plane has no place on the film, and with sensors whose
// pixels all measure the same nothing has. `sensor` is the index in a batch. A lens sees from its middle.
std::vector<SeenPiece> seen_pieces(const Scene& scene, const Vec3& a, const Vec3& b, std::uint32_t sensor = 0);

}  // namespace neumann
