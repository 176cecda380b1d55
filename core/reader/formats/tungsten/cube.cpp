#include "core/reader/formats/tungsten/cube.h"

namespace neumann::reader::tungsten {

MeshFile make_cube() {
    MeshFile cube;
    for (int axis = 0; axis < 3; ++axis)
        for (const double side : {-0.5, 0.5}) {
            const auto first = static_cast<std::uint32_t>(cube.mesh.vertices.size());
            for (const Vec2 uv : {Vec2(0, 0), Vec2(1, 0), Vec2(1, 1), Vec2(0, 1)}) {
                Vec3 corner;
                corner[axis] = side;
                corner[(axis + 1) % 3] = uv.x - 0.5;
                corner[(axis + 2) % 3] = uv.y - 0.5;
                cube.mesh.vertices.push_back(corner);
                cube.mesh.uv.push_back(uv);
            }
            // The corners are counter-clockwise as seen from outside.
            for (const std::uint32_t corner : {1u, 2u}) {
                const std::uint32_t other = corner + 1;
                cube.mesh.triangles.push_back(
                    {first, first + (side > 0.0 ? corner : other), first + (side > 0.0 ? other : corner)});
            }
        }
    return cube;
}

}  // namespace neumann::reader::tungsten
