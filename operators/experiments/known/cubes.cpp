// The unit cube whose ceiling emits Le = 1, albedo ρ everywhere: K^i Le = ρ^i g_i, and g_i depends on the shape only. g_1 is
// Lambert's formula, g_2 is exact to 1e-13 by quadrature of closed forms, the others come from a Galerkin method with exact form
// factors, extrapolated from 16² … 256² patches a face; error at most 2.4e-8. The ceiling touches the walls, so light sampling
// alone has infinite variance and is left out (see monte_carlo.cpp).
#include "operators/algebra/term_series.h"
#include "operators/experiments/known/cube.h"
#include "operators/experiments/known/groups.h"
#include "operators/experiments/known/scene_maker.h"

#include <fmt/format.h>
#include <algorithm>

namespace neumann::known {

namespace {

// g_1 … g_10: means over a wall, the floor and the ceiling, and values at their centres.
constexpr double g[10][6] = {
    {0.2000437760754035, 0.1998248956983871, 0.0, 0.1901358823848065, 0.23945647046077306, 0.0},
    {0.15671177281026544, 0.11740200680622123, 0.25575090195271727, 0.16324094849140766, 0.13875246294508298, 0.2082837430892865},
    {0.1689384552182966, 0.1739746954863139, 0.15027148364050638, 0.16752924549132675, 0.18030273351449316, 0.14958028452019964},
    {0.16587258260211857, 0.15680139378415744, 0.17970827580737792, 0.16656445706042375, 0.16267141688353065, 0.17107075487477902},
    {0.16685279860138164, 0.16738917389794383, 0.16519963169654014, 0.1667080876744663, 0.16895329092840322, 0.16421435837373702},
    {0.16659112115335972, 0.1647001927503972, 0.16893532263617797, 0.16666763917837313, 0.1661555759197807, 0.1671738673667348},
    {0.166684169406733, 0.16660614828016215, 0.16665717409292297, 0.16666876030924682, 0.16706995791958834, 0.16625500084343406},
    {0.16665846984414612, 0.1662476122682594, 0.1671185083551757, 0.16666759901791062, 0.16661606665449477, 0.1667135372738749},
    {0.16666850297559505, 0.1666028784951586, 0.16672310960248407, 0.16666675643987058, 0.16674449296470686, 0.16658848127582612},
    {0.16666568587790348, 0.1665692051951137, 0.1667680512932966, 0.1666668480617492, 0.16666701288433364, 0.1666655948686882}};
constexpr double accuracy = 2.4e-8;  // of g
enum Column : std::size_t { wall_mean, floor_mean, ceiling_mean, wall_center, floor_center, ceiling_center };
constexpr const char* column_names[] = {"wall-mean", "floor-mean", "ceiling-mean", "wall-centre", "floor-centre", "ceiling-centre"};

constexpr double rho = 0.8;
// K^1 Le … K^count Le.
std::vector<double> terms(std::size_t column, std::size_t count) {
    std::vector<double> values;
    for (std::size_t i = 0; i < count; ++i) values.push_back(g[i][column] * std::pow(rho, static_cast<double>(i + 1)));
    return values;
}

Scene cube_lit_by(Face lit) {
    SceneMaker maker;
    const auto faces = room({0, 0, 0}, {1, 1, 1});
    for (std::size_t i = 0; i < 6; ++i) maker.add(faces[i], i == lit ? glowing(rho, 1.0) : matte(rho));
    return maker.make();
}

StartPicker place(const Scene& scene, std::size_t column) {
    constexpr std::uint32_t shapes[] = {left, floor, ceiling};
    if (column < wall_center) return anywhere_on(scene, shapes[column]);
    if (column == wall_center) return at(scene, {0, 0.5, 0.5}, {1, 0, 0});
    return column == floor_center ? at(scene, {0.5, 0.5, 0}, {0, 0, 1}) : at(scene, {0.5, 0.5, 1}, {0, 0, -1});
}

void add_walks(Cases& cases) {
    cases.push_back({"cube/figures", "4 walls + floor + ceiling = 1: exact", [](Figures& figures, std::uint64_t) {
                         for (std::size_t i = 0; i < 10; ++i)
                             figures.near(fmt::format("of g_{}", i + 1),
                                          4.0 * g[i][wall_mean] + g[i][floor_mean] + g[i][ceiling_mean], 1.0, 1e-8);
                     }});
    for (std::size_t column = 0; column < 6; ++column)
        for (const Technique technique : {Technique::mis, Technique::bsdf, Technique::pointwise}) {
            const std::size_t bounces = technique == Technique::pointwise ? 2 : technique == Technique::bsdf ? 4 : 10;
            cases.push_back({fmt::format("cube/ceiling-lit/{}/{}", column_names[column], short_name(technique)),
                             "rho^i g_i: closed form, quadrature 1e-13, Galerkin 2.4e-8",
                             [=](Figures& figures, std::uint64_t seed) {
                                 const Scene scene = cube_lit_by(ceiling);
                                 figures.terms(sharp_probe(scene, place(scene, column), technique,
                                                           {.samples = 1024, .bounces = static_cast<int>(bounces), .seed = seed}),
                                               terms(column, bounces), 1, accuracy);
                             }});
        }
    // By superposition: with one wall lit, g_i at the floor's centre is (1 − g_floor − g_ceiling)/4.
    cases.push_back({"cube/wall-lit/floor-centre/mis", "superposition of the above", [](Figures& figures, std::uint64_t seed) {
                         const Scene scene = cube_lit_by(right);
                         std::vector<double> exact;
                         for (const auto& row : g)
                             exact.push_back(std::pow(rho, static_cast<double>(exact.size() + 1)) * 0.25 *
                                             (1.0 - row[floor_center] - row[ceiling_center]));
                         figures.terms(sharp_probe(scene, place(scene, floor_center), Technique::mis,
                                                   {.samples = 1024, .bounces = 10, .seed = seed}),
                                       exact, 1, accuracy);
                     }});
    // Σ_{i>2} with ρ = 0.8: the table, and beyond it g_i = 1/6 to 1e-6.
    cases.push_back({"cube/ceiling-lit/floor-centre/rest", "the same added up: 1e-6", [](Figures& figures, std::uint64_t seed) {
                         const Scene scene = cube_lit_by(ceiling);
                         double exact = std::pow(rho, 11) / (1.0 - rho) / 6.0;
                         for (std::size_t i = 2; i < 10; ++i)
                             exact += g[i][floor_center] * std::pow(rho, static_cast<double>(i + 1));
                         const Estimates found =
                             sharp_probe(scene, place(scene, floor_center), Technique::mis,
                                         {.samples = 1024, .bounces = 2, .rest_probability = 1.0, .seed = seed});
                         figures.sampled("sum of K^i Le, i > 2", found.rest, exact, 1e-6);
                     }});
}

struct Means {
    double wall, floor, ceiling;
    double largest_difference(std::size_t bounce, std::size_t column) const {
        const double* known = g[bounce - 1];
        return std::max(
            {std::abs(wall - known[column]), std::abs(floor - known[column + 1]), std::abs(ceiling - known[column + 2])});
    }
};
Vector bounce(const Cube& cube, int i) {
    Vector x = cube.ceiling();
    for (int k = 0; k < i; ++k) x = cube.factors.F * x;
    return x;
}
double error_of_means(const Cube& cube, int i) {
    const auto everywhere = [](const Vec3&) { return true; };
    const Vector x = bounce(cube, i);
    return Means{cube.mean(x, x0, everywhere), cube.mean(x, cube_floor, everywhere), cube.mean(x, cube_ceiling, everywhere)}
        .largest_difference(static_cast<std::size_t>(i), wall_mean);
}

// Lambert's formula: the form factor from a point with normal n to a patch wholly in front of it.
double point_factor(const Vec3& p, const Vec3& n, const Parallelogram& patch) {
    const Vec3 r[] = {patch.corner - p, patch.corner + patch.u - p, patch.corner + patch.u + patch.v - p,
                      patch.corner + patch.v - p};
    double sum = 0.0;
    for (int k = 0; k < 4; ++k) {
        const Vec3 &a = r[k], &b = r[(k + 1) % 4];
        const Vec3 axis = glm::cross(a, b);
        const double sine = glm::length(axis);
        if (sine > 0.0) sum += std::atan2(sine, glm::dot(a, b)) * glm::dot(n, axis) / sine;
    }
    return std::abs(sum) / (2.0 * pi);
}
// The mean of g that arrives at the middle of a face, which sees no patch of its own face.
double gathered(const Cube& cube, const Vector& x, const Parallelogram& face) {
    double sum = 0.0;
    for (Eigen::Index u = 0; u < cube.size(); ++u) {
        const Parallelogram& patch = cube.patches[static_cast<std::size_t>(u)];
        if (std::abs(glm::dot(patch.centre() - face.corner, face.normal())) > 1e-9)
            sum += point_factor(face.centre(), face.normal(), patch) * x[u];
    }
    return sum;
}

// Piecewise constant radiance on n × n patches a face has known errors, of order h² ln h from the corners.
void add_patches(Cases& cases) {
    struct Row {
        int n;
        double g2, g5, centre_g2;
    };
    for (const Row& row : {Row{4, 6.83e-3, 2.15e-4, 2.18e-3}, Row{8, 2.02e-3, 1.16e-4, 6.01e-4}, Row{16, 5.80e-4, 4.96e-5, 1.54e-4},
                           Row{32, 1.63e-4, 1.78e-5, 0.0}})
        cases.push_back({fmt::format("cube/patches/{0}x{0}", row.n), "errors of Galerkin's method, 3 digits",
                         [row](Figures& figures, std::uint64_t) {
                             const Cube cube = symmetric_cube(row.n);
                             figures.near("error of the means of g_1", error_of_means(cube, 1), 0.0, 1e-13);
                             figures.near("error of the means of g_2", error_of_means(cube, 2), row.g2, 5e-3 * row.g2);
                             figures.near("error of the means of g_5", error_of_means(cube, 5), row.g5, 5e-3 * row.g5);
                             if (row.n > 16) return;
                             const Cube whole = patched_cube(row.n);
                             const Vector x = bounce(whole, 1);
                             const auto& faces = cube_faces();
                             const Means centres{gathered(whole, x, faces[x0]), gathered(whole, x, faces[cube_floor]),
                                                 gathered(whole, x, faces[cube_ceiling])};
                             figures.near("error of the centres of g_2", centres.largest_difference(2, wall_center), row.centre_g2,
                                          5e-3 * row.centre_g2);
                         }});
    // ⟨We, K^i Le⟩ = ⟨K*^i We, Le⟩ with We the mean over 4 × 4 patches in a corner of the floor.
    cases.push_back({"cube/importance", "Galerkin's method, 1e-10", [](Figures& figures, std::uint64_t) {
                         const Cube cube = patched_cube(16);
                         const DenseChannel K = cube.channel(cube.on_faces({.2, .5, .8, .9, .95, .7}));
                         Vector importance = Vector::Zero(cube.size()), light = cube.ceiling(), next(cube.size());
                         for (Eigen::Index u = 0; u < cube.size(); ++u) {
                             const Vec3 c = cube.patches[static_cast<std::size_t>(u)].centre();
                             if (cube.face[static_cast<std::size_t>(u)] == cube_floor && c.x < 0.25 && c.y < 0.25)
                                 importance[u] = 1.0 / 16.0 / cube.factors.area[u];
                         }
                         const Vector We = importance, Le = light;
                         const auto dot = [&](const Vector& f, const Vector& h) { return f.cwiseProduct(K.measure()).dot(h); };
                         int i = 0;
                         for (const double value : {.1648496371, .0543762062, .0623122982, .0341017346, .0253026188, .0159764181}) {
                             K.apply(light, next);
                             light = next;
                             K.apply_adjoint(importance, next);
                             importance = next;
                             figures.near(fmt::format("<We, K^{} Le>", ++i), dot(We, light), value, 1e-10);
                             figures.near(fmt::format("<K*^{} We, Le> - <We, K^{} Le>", i, i), dot(importance, Le) - dot(We, light),
                                          0.0, 1e-15);
                         }
                     }});
}

}  // namespace

Cases cube_cases() {
    Cases cases;
    add_walks(cases);
    add_patches(cases);
    return cases;
}

}  // namespace neumann::known
