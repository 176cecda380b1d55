// Closed scenes of many shapes, for laws that hold in every closed scene.
#pragma once

#include "operators/experiments/known/scene_maker.h"

#include <string>
#include <vector>

namespace neumann::known {

struct ClosedScene {
    std::string name;
    SceneMaker maker;
};

// Closed scenes in which all surfaces are alike. The origin is inside and sees a surface in every direction.
inline std::vector<ClosedScene> enclosures(const Surface& surface) {
    std::vector<ClosedScene> all;
    const auto enclose = [&](const std::string& name) -> SceneMaker& { return all.emplace_back(ClosedScene{name, {}}).maker; };
    enclose("cube").add(make_cube(Mat4(1.0), true), surface);
    enclose("room of six rectangles").add(room({-1.1, -0.7, -0.4}, {0.9, 1.3, 0.8}), surface);
    enclose("sphere").add(Sphere{{0.1, -0.2, 0.3}, 1.7, true}, surface);
    enclose("tessellated sphere").add(flipped(icosphere(2)), surface);
    enclose("tetrahedron").add(flipped(tetrahedron(1.3)), surface);
    SceneMaker& box_in_room = enclose("room with a box in it");
    box_in_room.add(room({-1, -1, -1}, {1, 1, 1}), surface);
    box_in_room.add(box({0.3, 0.2, -0.8}, {0.7, 0.8, 0.1}), surface);
    SceneMaker& spheres = enclose("sphere in a sphere");
    spheres.add(Sphere{{0, 0, 0}, 1.0, true}, surface);
    spheres.add(Sphere{{0.4, 0.3, 0.2}, 0.3, false}, surface);
    SceneMaker& tube = enclose("cylinder closed by discs");
    tube.add(Cylinder{{0.2, -0.1, -0.6}, {0, 0, 1}, 1.4, 0.7, true}, surface);
    tube.add(Disk{{0.2, -0.1, -0.6}, {0.7, 0, 0}, {0, 0.7, 0}, {0, 0, 1}}, surface);
    tube.add(Disk{{0.2, -0.1, 0.8}, {0.7, 0, 0}, {0, 0.7, 0}, {0, 0, -1}}, surface);
    return all;
}

}  // namespace neumann::known
