#include "operators/experiments/known/extreme/unit_cube.h"

namespace neumann::known {

namespace {

// g_i (cubes.cpp).
constexpr double floor_centre[] = {0.23945647046077306, 0.13875246294508298, 0.18030273351449316};

}  // namespace

std::vector<double> cube_terms(double rho, double radiance) {
    std::vector<double> terms;
    for (const double g : floor_centre) terms.push_back(radiance * g * std::pow(rho, static_cast<double>(terms.size() + 1)));
    return terms;
}
SceneMaker lit_cube(double rho, double radiance, const Mat4& to_world, int floor_pieces) {
    SceneMaker maker;
    const auto faces = room({0, 0, 0}, {1, 1, 1});
    for (std::size_t i = 0; i < 6; ++i)
        maker.add(transformed(i == floor ? strips({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, floor_pieces) : faces[i], to_world),
                  i == ceiling ? glowing(rho, radiance) : matte(rho));
    return maker;
}
void sample_cube(Figures& figures, std::uint64_t seed, const Scene& scene, const Mat4& to_world, double radiance) {
    const double size = glm::length(Vec3(to_world[0]));
    const Vec3 p(to_world * glm::dvec4(0.5, 0.5, 0, 1)), n = glm::normalize(Vec3(to_world * glm::dvec4(0, 0, 1, 0)));
    figures.terms(sharp_probe(scene, at(scene, p, n, 1e-3 * size), Technique::mis, {.samples = 1024, .bounces = 3, .seed = seed}),
                  cube_terms(0.8, radiance), 1, 2.4e-8 * radiance);
}

}  // namespace neumann::known
