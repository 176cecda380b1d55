// The unit cube whose ceiling emits Le = 1, albedo ρ everywhere: K^i Le = ρ^i g_i, and g_i depends on the shape only. g_1 is
// Lambert's formula, g_2 is exact to 1e-13 by quadrature of closed forms, the others come from a Galerkin method with exact form
// factors, extrapolated from 16² … 256² patches a face; error at most 2.4e-8. The ceiling touches the walls, so light sampling
// alone has infinite variance and is left out (see variance.cpp).
#include "tests/physics/probe.h"
#include "tests/physics/scene_maker.h"

#include <gtest/gtest.h>
#include <glm/gtc/matrix_transform.hpp>

namespace neumann::physics {
namespace {

// g_1 … g_10: means over a wall, the floor and the ceiling, and their centres.
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
enum Column : std::size_t { wall_mean, floor_mean, ceiling_mean, wall_center, floor_center, ceiling_center };
constexpr const char* column_names[] = {"mean of a wall",   "mean of the floor",   "mean of the ceiling",
                                        "centre of a wall", "centre of the floor", "centre of the ceiling"};

// K^1 Le … K^10 Le.
std::vector<double> terms(Column column, double rho) {
    std::vector<double> values;
    for (const auto& row : g) values.push_back(row[column] * std::pow(rho, static_cast<double>(values.size() + 1)));
    return values;
}

Scene cube(const Rgb& rho, const Mat4& to_world = Mat4(1.0)) {
    SceneMaker maker;
    const auto faces = room({0, 0, 0}, {1, 1, 1});
    for (std::size_t i = 0; i < 6; ++i) {
        Surface surface{rho, std::nullopt};
        if (i == ceiling) surface.emission = grey(1.0);
        maker.add(transformed(faces[i], to_world), surface);
    }
    return maker.make();
}

StartPicker place(const Scene& scene, Column column, const Mat4& to_world = Mat4(1.0)) {
    const auto point = [&](const Vec3& p, const Vec3& n) {
        const double size = glm::length(Vec3(to_world[0]));
        return at(scene, Vec3(to_world * glm::dvec4(p, 1.0)), Vec3(to_world * glm::dvec4(n, 0.0)) / size, 1e-3 * size);
    };
    switch (column) {
        case wall_mean:
            return anywhere_on(scene, left);
        case floor_mean:
            return anywhere_on(scene, floor);
        case ceiling_mean:
            return anywhere_on(scene, ceiling);
        case wall_center:
            return point({0, 0.5, 0.5}, {1, 0, 0});
        case floor_center:
            return point({0.5, 0.5, 0}, {0, 0, 1});
        case ceiling_center:
            return point({0.5, 0.5, 1}, {0, 0, -1});
    }
    return {};
}

constexpr Column all_columns[] = {wall_mean, floor_mean, ceiling_mean, wall_center, floor_center, ceiling_center};

// The faces together reflect what is emitted: 4 walls + floor + ceiling = 1.
TEST(Cube, TheFiguresKeepTheFlux) {
    for (const auto& row : g) EXPECT_NEAR(4.0 * row[wall_mean] + row[floor_mean] + row[ceiling_mean], 1.0, 1e-8);
}

// 6 places × 2 ways × 10 bounces, of which 4 are exactly 0: 120 comparisons, MIS to 0.3%, BSDF sampling to 0.6%.
TEST(CubeSlow, TenBouncesAtTheCentresAndOnAverage) {
    const double rho = 0.8;
    const Scene scene = cube(grey(rho));
    for (const Column column : all_columns)
        for (const Way way : {Way::mis, Way::bsdf}) {
            SCOPED_TRACE(std::string(column_names[column]) + ", " + name(way));
            expect_matches(probe(scene, place(scene, column), way, {.samples = 8192, .bounces = 10}), terms(column, rho), 1,
                           way == Way::mis ? 0.003 : 0.006);
        }
}

// 37 times as large, turned about a skew axis, moved by coordinates that no float holds. 4 places × 10 bounces: 40 comparisons.
TEST(CubeSlow, TheSameLargerTurnedAndElsewhere) {
    const double rho = 0.8;
    const Mat4 to_world = glm::scale(
        glm::rotate(glm::translate(Mat4(1.0), Vec3(1234.1, -987.7, 456.3)), 1.1, glm::normalize(Vec3(1, 2, 3))), Vec3(37.0));
    const Scene scene = cube(grey(rho), to_world);
    for (const Column column : {wall_mean, ceiling_mean, floor_center, ceiling_center}) {
        SCOPED_TRACE(column_names[column]);
        const Estimates found = probe(scene, place(scene, column, to_world), Way::mis, {.samples = 8192, .bounces = 10});
        std::vector<double> exact = terms(column, rho);
        if (exact[0] == 0.0) {
            // A plane in a skew position is flat up to the rounding of its corners only: two cosines of the order of 1e-14 are left
            // of the light that the ceiling throws on itself.
            EXPECT_LE(found.terms[1].mean.r, 1e-25);
            exact.erase(exact.begin());
            expect_matches(found, exact, 2, 0.003);
        } else {
            expect_matches(found, exact, 1, 0.003);
        }
    }
}

// Operators start anew for each bounce. 6 places × 3 bounces, to 0.5%: 18 comparisons.
TEST(Cube, TheOperatorsSayTheSame) {
    const double rho = 0.8;
    const Scene scene = cube(grey(rho));
    for (const Column column : all_columns) {
        SCOPED_TRACE(column_names[column]);
        std::vector<double> exact = terms(column, rho);
        exact.resize(3);
        expect_matches(probe(scene, place(scene, column), Way::pointwise, {.samples = 8192, .bounces = 3}), exact, 1, 0.005);
    }
}

// By superposition: with one wall instead of the ceiling, g_i at the floor's centre is (1 − g_floor − g_ceiling)/4. 10 comparisons.
TEST(Cube, LitByAWallInstead) {
    const double rho = 0.8;
    SceneMaker maker;
    const auto faces = room({0, 0, 0}, {1, 1, 1});
    for (std::size_t i = 0; i < 6; ++i) maker.add(faces[i], i == right ? glowing(rho, 1.0) : matte(rho));
    const Scene scene = maker.make();
    std::vector<double> exact;
    for (const auto& row : g)
        exact.push_back(std::pow(rho, static_cast<double>(exact.size() + 1)) * 0.25 *
                        (1.0 - row[floor_center] - row[ceiling_center]));
    expect_matches(probe(scene, place(scene, floor_center), Way::mis, {.samples = 8192, .bounces = 10}), exact, 1);
}

// Channels do not know of each other: the same walks, ρ_c^i for each.
TEST(Cube, EveryChannelHasItsOwnPowers) {
    const Rgb rho(0.9, 0.5, 0.25);
    const Scene scene = cube(rho);
    const Estimates found = probe(scene, place(scene, wall_center), Way::mis, {.samples = 64, .bounces = 10});
    for (int i = 1; i <= 10; ++i) {
        const Rgb& mean = found.terms[static_cast<std::size_t>(i)].mean;
        for (int c = 0; c < 3; ++c)
            EXPECT_NEAR(mean[c] / power_of(rho, i)[c], mean.r / power_of(rho, i).r, 1e-14 * i) << "K^" << i << " Le";
    }
}

// Σ_{i>N} K^i Le with ρ = 1/2: the table's g_3 … g_10, then g_i = 1/6 to 1e-6. 3 comparisons.
TEST(CubeSlow, TheRestIsWhatTheFurtherBouncesAddUpTo) {
    const double rho = 0.5;
    double exact = std::pow(rho, 11) / (1.0 - rho) / 6.0;
    for (std::size_t i = 2; i < 10; ++i) exact += g[i][floor_center] * std::pow(rho, static_cast<double>(i + 1));
    const Scene scene = cube(grey(rho));
    for (const double go_on : {1.0, 0.7})
        expect_matches(
            probe(scene, place(scene, floor_center), Way::mis, {.samples = 16384, .bounces = 2, .rest_probability = go_on}).rest,
            exact, "rest");
    expect_matches(
        probe(scene, place(scene, floor_center), Way::bsdf, {.samples = 65536, .bounces = 2, .rest_probability = 1.0}).rest, exact,
        "rest");
}

}  // namespace
}  // namespace neumann::physics
