// The room that the wrong tracer renders.
#include "operators/experiments/known/scene_maker.h"
#include "tests/blame/wrong_tracer.h"

#include <glm/gtc/matrix_transform.hpp>

namespace neumann::blame_test {

using namespace known;

namespace {

Surface coloured(double r, double g, double b) { return {Rgb(r, g, b), std::nullopt}; }

}  // namespace

// x to the left as the camera sees it, y up, z away from the camera.
Scene blame_room(int resolution) {
    SceneMaker maker;
    const auto walls = room({-1, 0, 0}, {1, 2, 2});
    maker.add(walls[left], coloured(0.25, 0.6, 0.3));
    maker.add(walls[right], coloured(0.65, 0.25, 0.2));
    maker.add(walls[front], coloured(0.7, 0.65, 0.55));    // y low: what one stands on
    maker.add(walls[back], coloured(0.75, 0.7, 0.72));     // y high
    maker.add(walls[floor], coloured(0.6, 0.5, 0.65));     // z low: between the camera and its near plane
    maker.add(walls[ceiling], coloured(0.45, 0.55, 0.7));  // z high

    // It faces down and a little to the camera, so that the camera sees its front, and its back the upper part of the walls.
    maker.add(parallelogram({-0.65, 1.9, 0.4}, {1.0, 0, 0}, {0, -0.25, 0.8}), {std::nullopt, AreaLight(Rgb(12, 10, 7))});

    // The block's bottom would lie on the floor.
    maker.add(part(box({0.2, 0, 0.9}, {0.7, 0.55, 1.4}), [](const Vec3& middle) { return middle.y > 0.1; }),
              coloured(0.6, 0.5, 0.3));
    maker.add(Sphere{{-0.5, 0.55, 1.4}, 0.4}, made_of(Conductor({}, Rgb(0.9, 0.85, 0.8))));
    maker.add(Sphere{{-0.2, 0.33, 0.6}, 0.3}, boundary(Dielectric(1.5), Dielectric(1.0 / 1.5)));
    // Its front faces the wall behind it.
    Surface panel = coloured(0.5, 0.7, 0.6);
    panel.two_sided = true;
    maker.add(parallelogram({0.4, 0.85, 1.6}, {0.5, 0, -0.25}, {0, 0.5, 0}), panel);

    maker.parts.camera.to_world = glm::translate(Mat4(1.0), Vec3(-0.1, 1.0, -3.2));
    maker.parts.camera.fov = 0.6;
    maker.parts.camera.near_clip = 3.25;
    maker.parts.film = {
        .width = resolution, .height = resolution, .crop_width = resolution, .crop_height = resolution, .filter = BoxFilter()};
    return maker.make();
}

}  // namespace neumann::blame_test
