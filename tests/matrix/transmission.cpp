// Glass and other things that light goes through: R between both sides of a patch, and basic radiance.
#include "core/material/diffuse_fresnel.h"
#include "operators/fields/matrix/inner_product.h"
#include "operators/fields/matrix/reflection_matrix.h"
#include "operators/fields/matrix/scene_patches.h"
#include "operators/fields/matrix/transport_matrix.h"
#include "tests/matrix/one_matrix.h"
#include "tests/physics/scene_maker.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace neumann::transmission_test {

using namespace physics;

struct Pane {
    std::string name;
    Bsdf front, back;
};

// Air in water is the last one: what is outside of a ball of it lies in water.
std::vector<Pane> panes() {
    const auto white = std::make_shared<const Bsdf>(Diffuse(Rgb(0.7)));
    return {{"glass", Dielectric(1.5), Dielectric(1.0 / 1.5)},
            {"rough_glass", RoughDielectric<Ggx>(Ggx(0.3), 1.5), RoughDielectric<Ggx>(Ggx(0.3), 1.0 / 1.5)},
            {"pane", ThinDielectric(1.5), ThinDielectric(1.5)},
            {"nothing", Null(), Null()},
            {"holes", Mask(white, Rgb(0.3)), Mask(white, Rgb(0.3))},
            {"air_in_water", Dielectric(1.0 / 1.33), Dielectric(1.33)}};
}

class Panes : public testing::TestWithParam<int> {
protected:
    Pane pane = panes()[static_cast<std::size_t>(GetParam())];
};
std::string name_of(const testing::TestParamInfo<int>& test) { return panes()[static_cast<std::size_t>(test.param)].name; }
class TransmissionBlocks : public Panes {};
class TransmissionScenes : public Panes {};
INSTANTIATE_TEST_SUITE_P(, TransmissionBlocks, testing::Range(0, 6), name_of);
INSTANTIATE_TEST_SUITE_P(, TransmissionScenes, testing::Range(0, 5), name_of);

// n² B = (n² B)ᵀ, and rows sum to no more than the largest basic albedo.
TEST_P(TransmissionBlocks, AreReciprocal) {
    const DirectionCells cells{8};
    const ReflectionBlock block(pane.front, cells, pane.back, cells);
    Eigen::MatrixXd B = block.matrix(0);
    ASSERT_EQ(B.rows(), 128);
    const Eigen::VectorXd rows = B.rowwise().sum();
    const double most = largest_basic_albedo(pane.front).r;
    EXPECT_LE(rows.maxCoeff() - most, 1e-13);
    EXPECT_GE(rows.minCoeff(), 0.5 * most);
    const double n = refractive_ratio(pane.front);
    B.bottomRows(64) *= n * n;
    EXPECT_LE((B - B.transpose()).cwiseAbs().maxCoeff(), 1e-14);
    EXPECT_GE(B.minCoeff(), 0.0);
    EXPECT_GT(B.topRightCorner(64, 64).sum(), 1.0) << "light goes through";
}

// Light from all sides alike: F̄ of it is reflected, and what goes through from either side is the same power.
TEST(TransmissionBlock, ReflectsDiffuseFresnel) {
    for (const double n : {1.2, 1.5, 2.4}) {
        const DirectionCells cells{16};
        const ReflectionBlock block(Dielectric(n), cells, Dielectric(1.0 / n), cells);
        const Eigen::MatrixXd B = block.matrix(0);
        // A million points for an average of F.
        EXPECT_NEAR(B.topLeftCorner(256, 256).sum() / 256.0, diffuse_fresnel(n), 1e-3) << n;
        EXPECT_NEAR(B.bottomRightCorner(256, 256).sum() / 256.0, diffuse_fresnel(1.0 / n), 1e-3) << n;
        EXPECT_NEAR((B.rowwise().sum().array() - 1.0).abs().maxCoeff(), 0.0, 1e-13) << "lossless";
    }
}

// Straight on: into the cell half a turn further, seen from the other side, whatever the normal.
TEST(TransmissionBlock, OfNothingGoesStraightOn) {
    const DirectionCells cells{4};
    const Eigen::MatrixXd B = ReflectionBlock(Null(), cells, Null(), cells).matrix(0);
    for (const Vec3 n : {Vec3(0, 0, 1), Vec3(0, 0, -1), glm::normalize(Vec3(0.3, -0.5, 0.2)), Vec3(1, 0, 0)}) {
        const Frame front(n), back(-n);
        for (std::uint32_t i = 0; i < cells.size(); ++i) {
            // Seen along wo, from in front, is what arrives from behind along −wo.
            const Vec3 wo = front.to_world(cells.direction(i, Vec2(0.5)));
            EXPECT_EQ(B(i, 16 + cells.cell(back.to_local(-wo))), 1.0);
        }
    }
    EXPECT_EQ(B.sum(), 32.0);
}

// A closed room with a ball in it.
Scene ball_in_room(const Pane& pane, double rho = 0.5) {
    SceneMaker maker;
    const auto walls = room({-1, -1, -1}, {1, 1, 1});
    for (const std::size_t face : {left, right, front, back, floor}) maker.add(walls[face], matte(rho));
    maker.add(walls[ceiling], glowing(rho, 1.0));
    maker.add(Sphere{{0.1, -0.2, 0.1}, 0.6, false}, boundary(pane.front, pane.back));
    return maker.make();
}

// Light of one basic radiance everywhere stays it, times what each surface gives back.
TEST_P(TransmissionScenes, FurnaceIsExact) {
    const Scene scene = ball_in_room(pane);
    const PatchSpace space = scene_patches(scene, {60, 0.6});
    const RayTable table(space, 256, 1);
    const ReflectionMatrix<1> R(scene.materials, space);
    const ExitantVector<1> one(Vector(Vector::Ones(space.size())));
    const ExitantVector<1> K1 = R(TransportMatrix<1>(table)(one));
    std::size_t both = 0;
    for (std::uint32_t f = 0; f < space.facets().size(); ++f) {
        const Facet& facet = space.facets()[f];
        const bool wall = facet.cells.k == 1;
        both += !wall;
        double expected = 0.5;
        if (!wall) expected = R.block(f)->row(facet.first - R.first_of_block(f)).sum();
        EXPECT_NEAR(K1(0, facet.first), expected, 1e-13);
        // Each of its microfacets is met once, so rough glass loses some.
        if (!wall && pane.name != "rough_glass") {
            EXPECT_NEAR(expected, largest_basic_albedo(pane.front).r, 1e-4);
        }
    }
    EXPECT_GE(both, 2u);
    EXPECT_EQ(both % 2, 0u);
}

TEST_P(TransmissionScenes, AreOneMatrixWithItsAdjoint) { expect_one_matrix(TracedSystem(ball_in_room(pane), {30, 256, 0}), 0); }

std::string refusal(const Scene& scene, bool of_camera) {
    try {
        const PatchSpace space = scene_patches(scene, {60, 0.6});
        if (of_camera) check_camera(scene);
    } catch (const InputError& e) {
        return e.what();
    }
    return "none";
}

TEST(TransmissionRefusals, OfWhatStandsInGlass) {
    const Pane glass = panes()[0];
    SceneMaker maker;
    maker.add(room({-1, -1, -1}, {1, 1, 1}), matte(0.5));
    maker.add(Sphere{{0, 0, 0}, 0.6, false}, boundary(glass.front, glass.back));
    SceneMaker lamp_inside = maker, lamp_outside = maker;
    lamp_inside.add(Sphere{{0, 0, 0}, 0.2, false}, lamp(1.0));
    lamp_outside.add(Sphere{{0.8, 0.8, 0.8}, 0.1, false}, lamp(1.0));
    EXPECT_EQ(refusal(lamp_inside.make(), false), "a light stands within glass, which patches do not hold, and walk does");
    EXPECT_EQ(refusal(lamp_outside.make(), false), "none");
    lamp_outside.parts.camera.fov = 1.0;
    EXPECT_EQ(refusal(lamp_outside.make(), true), "the camera stands within glass, which patches do not hold, and walk does");
}

}  // namespace neumann::transmission_test
