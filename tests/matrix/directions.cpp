// Surfaces that are not diffuse: R between cells of directions.
#include "core/material/fresnel.h"
#include "core/sampling/sampler.h"
#include "operators/algebra/neumann_series.h"
#include "operators/experiments/known/enclosures.h"
#include "operators/fields/matrix/inner_product.h"
#include "operators/fields/matrix/light_vector.h"
#include "operators/fields/matrix/sides.h"
#include "operators/fields/matrix/transport_matrix.h"
#include "tests/matrix/one_matrix.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace neumann::directions_test {

using namespace known;
constexpr double epsilon = std::numeric_limits<double>::epsilon();

Bsdf rough(double alpha) { return RoughConductor<Ggx>(Ggx(alpha)); }

// ∫∫ g dω⊥i dω⊥o between two cells times k²/π, by the midpoint rule with fs as it is.
double integral(const Bsdf& bsdf, DirectionCells cells, std::uint32_t i, std::uint32_t j, int n) {
    double sum = 0.0;
    for (int a = 0; a < n; ++a)
        for (int b = 0; b < n; ++b)
            for (int c = 0; c < n; ++c)
                for (int d = 0; d < n; ++d)
                    sum += eval(bsdf, {}, cells.direction(i, {(a + 0.5) / n, (b + 0.5) / n}),
                                cells.direction(j, {(c + 0.5) / n, (d + 0.5) / n}))
                               .g;
    return sum / std::pow(n, 4) * pi / cells.size();
}

TEST(ReflectionBlock, IsTheMeanOfFsBetweenCells) {
    const DirectionCells cells{4};
    const Bsdf bsdf = rough(0.5);
    const ReflectionBlock block(bsdf, cells);
    const ReflectionBlock::Matrix& B = block.matrix(0);
    // Each entry is the mean of two rows' 4096 samples, whose standard error is at most 0.0011 (64 seeds), and the midpoint rule is
    // right to 0.0004. 4.5 standard errors of 136 different entries: a false alarm in a thousand seeds.
    for (std::uint32_t i = 0; i < cells.size(); ++i)
        for (std::uint32_t j = 0; j < cells.size(); ++j)
            EXPECT_NEAR(B.coeff(i, j), integral(bsdf, cells, i, j, 10), 4.5 * 0.0011 + 0.0004) << i << " " << j;
}

// The albedo of 4096 samples has a standard error that depends on α (the largest of 24 seeds is given here); a row of B has the
// mean of two such, and the albedo of 16384 Sobol points beside it a third of that error. 208 comparisons at 4.2 standard errors: a
// false alarm in 180 seeds.
TEST(ReflectionBlock, IsSymmetricAndItsRowsSumToTheAlbedo) {
    for (const auto& [alpha, of_albedo] :
         {std::pair(0.05, 6e-4), std::pair(0.2, 5.5e-4), std::pair(0.5, 3e-4), std::pair(1.0, 7e-5)})
        for (const std::uint32_t k : {2u, 4u, 8u, 16u}) {
            const DirectionCells cells{k};
            const ReflectionBlock block(rough(alpha), cells);
            const ReflectionBlock::Matrix& B = block.matrix(0);
            EXPECT_LE((Eigen::MatrixXd(B) - Eigen::MatrixXd(B).transpose()).cwiseAbs().maxCoeff(), epsilon);
            const SobolPoints points(16384);
            const double standard_error = of_albedo * std::sqrt(1.0 / 2.0 + 1.0 / 9.0);
            for (std::uint32_t i = 0; i < cells.size(); i += std::max(1u, cells.size() / 16)) {
                double albedo = 0.0;  // by other samples
                Sampler sampler(points, 7, i);
                for (std::uint32_t n = 0; n < points.size(); ++n) {
                    sampler.start(n);
                    const Vec3 wo = cells.direction(i, sampler.next2());
                    albedo += sample(rough(alpha), {}, wo, sampler.next2()).weight.g / points.size();
                }
                EXPECT_NEAR(B.row(i).sum(), albedo, 4.2 * standard_error) << alpha << " " << k << " " << i;
                EXPECT_LE(B.row(i).sum(), 1.0 + 8.0 * epsilon);
            }
        }
}

TEST(ReflectionBlock, OfAMirrorTurnsByHalfACircle) {
    const DirectionCells cells{8};
    const Conductor gold(ConductorFresnel(Rgb(0.143, 0.375, 1.442), Rgb(3.983, 2.386, 1.603)));
    const ReflectionBlock block(gold, cells);
    for (int c = 0; c < 3; ++c) {
        const Eigen::MatrixXd B = block.matrix(c);
        for (std::uint32_t i = 0; i < cells.size(); ++i)
            for (std::uint32_t j = 0; j < cells.size(); ++j) EXPECT_EQ(B(i, j) > 0.0, j == cells.mirrored(i)) << i << " " << j;
        // At normal incidence ((n − 1)² + k²) / ((n + 1)² + k²). The cell reaches from there to a sine of 1/4, and its mean is
        // between the values at both ends.
        const double n[3] = {0.143, 0.375, 1.442}, k[3] = {3.983, 2.386, 1.603};
        const double normal = (std::pow(n[c] - 1.0, 2) + k[c] * k[c]) / (std::pow(n[c] + 1.0, 2) + k[c] * k[c]);
        const double change = std::abs(conductor_fresnel(std::sqrt(15.0 / 16.0), n[c], k[c]) - normal);
        EXPECT_NEAR(B(3 * 8 + 3, 4 * 8 + 4), normal, change) << c;
    }
}

TEST(SymmetricScaling, GivesTheRowSums) {
    Eigen::MatrixXd dense(3, 3);
    dense << 1, 2, 0, 2, 1, 3, 0, 3, 0.5;
    ReflectionBlock::Matrix A = dense.sparseView();
    const Eigen::Vector3d sums(0.9, 0.8, 0.7);
    scale_symmetrically(A, sums);
    EXPECT_LE((A * Eigen::Vector3d::Ones() - sums).cwiseAbs().maxCoeff(), 8.0 * epsilon);
    EXPECT_LE((Eigen::MatrixXd(A) - Eigen::MatrixXd(A).transpose()).cwiseAbs().maxCoeff(), epsilon);
}

// |K^i Le − ρ^i| in every cell, whatever the mesh: a mirror is as good a furnace as a matte wall.
TEST(Directions, FurnaceOfMirrorsIsExact) {
    const Rgb rho(0.25, 0.7, 0.999);
    for (const ClosedScene& e : enclosures(made_of(Conductor({}, rho), AreaLight(Rgb(1.0))))) {
        const Scene scene = e.maker.make();
        const PatchSpace space(scene.geometry, {40, 0.6}, side_directions(scene));
        const RayTable table(space, 64, 1);
        const ReflectionMatrix<4> R(scene.materials, space);
        NeumannSeries series(R * TransportMatrix<4>(table), emitted_light<4>(scene, space));
        EXPECT_EQ(space.size(), 256u * space.facets().size());
        for (int i = 0; i <= 10; ++i, series.advance())
            for (std::uint32_t u = 0; u < space.size(); ++u)
                for (int c = 0; c < 3; ++c)
                    ASSERT_NEAR(series.term()(c, u), std::pow(rho[c], i), 16.0 * std::max(i, 1) * epsilon) << e.name << " " << i;
    }
}

Scene metals(double lamp_size = 1.0) {
    SceneMaker maker;
    const auto walls = room({-1, -1, -1}, {1, 1, 1});
    for (const std::size_t face : {left, right, front, ceiling}) maker.add(walls[face], {Rgb(0.7, 0.4, 0.2), std::nullopt, false});
    maker.add(walls[back], made_of(Conductor({}, Rgb(0.9))));
    maker.add(walls[floor], made_of(RoughConductor<Ggx>(Ggx(0.4), {}, Rgb(0.8, 0.9, 0.7))));
    maker.add(parallelogram({-lamp_size / 2, -lamp_size / 2, 0.9}, {0, lamp_size, 0}, {lamp_size, 0, 0}), glowing(0.3, 2.0));
    return maker.make();
}

TEST(Directions, DotTestsHold) {
    const Scene scene = metals();
    const PatchSpace space(scene.geometry, {60, 0.6}, side_directions(scene));
    const RayTable table(space, 32, 1);
    const TransportMatrix<4> T(table);
    const ReflectionMatrix<4> R(scene.materials, space);
    const auto R_adjoint = adjoint(R);
    const auto T_adjoint = adjoint(T);
    ExitantVector<4> f = ExitantVector<4>::zero(space.size()), g = f;
    for (std::uint32_t u = 0; u < space.size(); ++u)
        for (int c = 0; c < 3; ++c) {
            f(c, u) = std::sin(1.0 + 3.0 * u + c);
            g(c, u) = std::cos(2.0 + 5.0 * u + c);
        }
    const Channels<4> Kf_g = inner_product(space, R(T(f)), g), f_Kg = inner_product(space, f, T_adjoint(R_adjoint(g)));
    const Channels<4> Tf_Rg = inner_product(space, T(f), R_adjoint(g));
    for (int c = 0; c < 3; ++c) {
        EXPECT_NEAR(Kf_g[c], f_Kg[c], 1e-13);
        EXPECT_NEAR(Kf_g[c], Tf_Rg[c], 1e-13);
        EXPECT_GT(std::abs(Kf_g[c]), 1e-6);
    }
}

TEST(Directions, AChannelIsOneMatrix) {
    const Scene scene = metals();
    const TracedSystem system(scene, {30, 32, 0});
    ASSERT_GT(system.space().size(), system.space().facets().size());
    for (const int c : {0, 2}) {
        EXPECT_EQ(system.channel(c).reflectance().size(), 0) << "K is no diag(ρ) F";
        expect_one_matrix(system, c);
    }
}

// K Le by points on lights and by the rays of T: two estimates of the same vector. A mirror has 256 rays a cell. The mean of the
// difference of a cell is noise; over 12 seeds it is 1.3% ± 0.09%, and the sum of all differences 0 ± 0.07%. Both are allowed 4.5
// of these standard deviations.
TEST(DirectionsSlow, LightSamplingAgreesWithRays) {
    const Scene scene = metals();
    const PatchSpace space(scene.geometry, {30, 0.6}, side_directions(scene));
    const ReflectionMatrix<1> R = ReflectionMatrix<4>(scene.materials, space).channel(1);
    const RayTable table(space, 65536, 3);
    const ExitantVector<1> by_rays = R(TransportMatrix<1>(table)(emitted_light<1>(scene, space)));
    const ExitantVector<1> by_lights = R(arriving_light<1>(scene, R, 65536, 3));
    double difference = 0.0, sum = 0.0, all = 0.0;
    for (const Facet& facet : space.facets())
        for (std::uint32_t u = facet.first; u < facet.first + facet.cells.size(); ++u) {
            difference += std::abs(by_rays(0, u) - by_lights(0, u)) * space.measure(facet);
            sum += (by_rays(0, u) - by_lights(0, u)) * space.measure(facet);
            all += by_rays(0, u) * space.measure(facet);
        }
    EXPECT_GT(all, 1.0);
    EXPECT_LE(difference, (0.013 + 4.5 * 0.0009) * all);
    EXPECT_NEAR(sum, 0.0, 4.5 * 0.0007 * all);
}

// The coarser cells hold the means of the finer ones.
TEST(Directions, CoarserCellsAreAroundTheirParts) {
    for (const std::uint32_t k : {2u, 4u, 16u}) {
        const DirectionCells cells{k}, coarser = cells.coarser();
        for (std::uint32_t cell = 0; cell < cells.size(); ++cell)
            for (const Vec2 u : {Vec2(0.1, 0.1), Vec2(0.9, 0.2), Vec2(0.5, 0.9)})
                EXPECT_EQ(cells.coarser(cell), coarser.cell(cells.direction(cell, u)));
    }
}

}  // namespace neumann::directions_test
