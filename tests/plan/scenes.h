// Scenes for which something can be left out, beside those in scenes/.
#pragma once

#include "tests/physics/scene_maker.h"

#include <glm/gtc/matrix_transform.hpp>

namespace neumann::physics {

inline Mat4 looking(const Vec3& from, const Vec3& at) {
    const Vec3 d = glm::normalize(at - from);
    const Frame frame(d);
    return Mat4(glm::dvec4(frame.s, 0.0), glm::dvec4(frame.t, 0.0), glm::dvec4(d, 0.0), glm::dvec4(from, 1.0));
}

inline Scene looked_at(SceneMaker maker, const Vec3& from, const Vec3& at, int size = 12) {
    maker.parts.camera.to_world = looking(from, at);
    maker.parts.camera.fov = 1.2;
    maker.parts.film.width = maker.parts.film.crop_width = maker.parts.film.height = maker.parts.film.crop_height = size;
    return maker.make();
}

// A convex room whose ceiling shines.
inline Scene lit_room(const Rgb& reflectance, int size = 12) {
    SceneMaker maker;
    const auto faces = room({-1.0, -1.0, -1.0}, {1.0, 1.5, 1.2});
    for (std::size_t face = 0; face < faces.size(); ++face)
        maker.add(faces[face], face == ceiling ? Surface{reflectance, AreaLight(Rgb(2.0))} : Surface{reflectance, std::nullopt});
    return looked_at(maker, {0.3, -0.8, 0.1}, {-0.1, 1.0, -0.2}, size);
}

// A room that shines in one colour and reflects in another.
inline Scene coloured_furnace(int size = 12) {
    SceneMaker maker;
    maker.add(room({-1.0, -1.0, -1.0}, {1.0, 1.5, 1.2}), Surface{Rgb(0.7, 0.5, 0.3), AreaLight(Rgb(1.0, 2.0, 0.5))});
    return looked_at(maker, {0.3, -0.8, 0.1}, {-0.1, 1.0, -0.2}, size);
}

// A box under a sky.
inline Scene box_under(const Environment& sky, int size = 12) {
    SceneMaker maker;
    maker.add(box({-0.5, -0.5, -0.5}, {0.5, 0.6, 0.7}), Surface{Rgb(0.6, 0.5, 0.4), std::nullopt});
    maker.parts.lights.environment = sky;
    return looked_at(maker, {2.0, 1.5, 1.8}, {0.0, 0.0, 0.0}, size);
}

// A room with a box in it, lit by a point alone.
inline Scene point_lit_room(const Rgb& reflectance, int size = 12) {
    SceneMaker maker;
    maker.add(room({-1.0, -1.0, -1.0}, {1.0, 1.5, 1.2}), Surface{reflectance, std::nullopt});
    maker.add(box({-0.3, 0.2, -1.0}, {0.3, 0.6, -0.2}), Surface{reflectance, std::nullopt});
    maker.parts.lights.delta = {PointLight({0.2, -0.3, 0.8}, Rgb(1.0))};
    return looked_at(maker, {0.3, -0.8, 0.1}, {-0.1, 1.0, -0.2}, size);
}

// Two-sided walls at an angle, and a lamp, seen from where no light comes.
inline Scene room_from_behind(int size = 12) {
    SceneMaker maker;
    const auto faces = room({-1.0, -1.0, -1.0}, {1.0, 1.0, 1.0});
    const Surface wall{Rgb(0.7, 0.5, 0.3), std::nullopt, true};
    maker.add(faces[left], wall);
    maker.add(faces[floor], wall);
    maker.add(faces[back], wall);
    maker.add(patch({0.0, 0.0, 0.9}, {0.0, 0.0, -1.0}, 0.3), lamp(3.0));
    return looked_at(maker, {-4.0, -0.5, 0.3}, {0.0, 0.0, 0.0}, size);
}

}  // namespace neumann::physics
