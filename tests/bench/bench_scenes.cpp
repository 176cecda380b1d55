#include "bench_scenes.h"

#include "core/reader/read_scene.h"

#include <glm/gtc/matrix_transform.hpp>

namespace neumann {

namespace {

constexpr double quarter_turn = 1.57079632679489661923;

Mat4 facing(const Vec3& position, const Vec3& axis, double angle, double size) {
    return glm::scale(glm::rotate(glm::translate(Mat4(1.0), position), angle, axis), Vec3(size));
}

}  // namespace

Scene cornell_box() { return read_scene(SCENES "/cornell-box/cornell-box.xml", {{"res", "128"}}); }

Scene landscape(int n) {
    SceneParts parts;
    const auto add = [&](Shape shape, int material, int light) {
        parts.shapes.push_back(std::move(shape));
        parts.sides_of_shape.push_back({material, material});
        parts.lights.of_shape.push_back(light);
    };
    parts.bsdfs = {Diffuse(Rgb(0.7, 0.6, 0.5)), Diffuse(Rgb(0.3, 0.6, 0.3))};
    parts.lights.area = {AreaLight(Rgb(10.0))};

    TriangleMesh ground;
    const auto steps = static_cast<std::uint32_t>(n);
    for (std::uint32_t y = 0; y <= steps; ++y)
        for (std::uint32_t x = 0; x <= steps; ++x) {
            const double a = 2.0 * x / n - 1.0, b = 2.0 * y / n - 1.0;
            ground.vertices.emplace_back(a, b, -0.6 + 0.2 * std::sin(7.0 * a) * std::cos(9.0 * b) + 0.02 * std::sin(61.0 * a * b));
        }
    for (std::uint32_t y = 0; y < steps; ++y)
        for (std::uint32_t x = 0; x < steps; ++x) {
            const std::uint32_t corner = y * (steps + 1) + x;
            ground.triangles.push_back({corner, corner + 1, corner + steps + 2});
            ground.triangles.push_back({corner, corner + steps + 2, corner + steps + 1});
        }
    add(std::move(ground), 1, Emitters::none);
    const Vec3 x(1, 0, 0), y(0, 1, 0);
    add(make_rectangle(facing({0, 0, 1}, x, 2.0 * quarter_turn, 1.0)), 0, Emitters::none);
    add(make_rectangle(facing({-1, 0, 0}, y, quarter_turn, 1.0)), 0, Emitters::none);
    add(make_rectangle(facing({1, 0, 0}, y, -quarter_turn, 1.0)), 0, Emitters::none);
    add(make_rectangle(facing({0, 1, 0}, x, quarter_turn, 1.0)), 0, Emitters::none);
    add(make_rectangle(facing({0, 0, 0.98}, x, 2.0 * quarter_turn, 0.25)), 0, 0);

    // From the open side, looking along +y.
    parts.camera.to_world = facing({0, -2.6, 0.2}, x, -quarter_turn, 1.0);
    parts.camera.fov = 0.75;
    parts.film.width = parts.film.crop_width = parts.film.height = parts.film.crop_height = 128;
    parts.film.filter = BoxFilter();
    return make_scene(std::move(parts));
}

}  // namespace neumann
