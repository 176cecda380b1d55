// All methods say the same of open scenes, lit by what surrounds them and by lights without extent: the mean of each bounce's
// picture.
#include "core/reader/read_scene.h"
#include "operators/render/from_fields/field_rendering.h"
#include "operators/render/from_paths/rendered_series.h"
#include "operators/render/report/series_report.h"
#include "operators/statistics/picture_statistics.h"
#include "tests/physics/paths_of.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>

namespace neumann::agreement_open_scenes_test {

constexpr int bounces = 3;

constexpr const char* mirror = R"(
        <shape type='rectangle'><transform name='to_world'><rotate y='1' angle='-90'/><scale value='0.8'/>
            <translate x='1.6' y='0.5' z='1'/></transform><bsdf type='twosided'><bsdf type='conductor'>
            <rgb name='specular_reflectance' value='0.9, 0.8, 0.7'/></bsdf></bsdf></shape>)";

// A floor and a block on it, open to all sides.
Scene open_scene(const std::string& lights) {
    const std::filesystem::path path =
        std::filesystem::path(testing::TempDir()) /
        (std::string("open_scene_") + testing::UnitTest::GetInstance()->current_test_info()->name() + ".xml");
    std::ofstream(path) << "<scene version='3.0.0'>" << lights << R"(
        <sensor type='perspective'><float name='fov' value='50'/>
            <transform name='to_world'><lookat origin='1, -6, 4' target='0, 0, 0.5' up='0, 0, 1'/></transform>
            <film type='hdrfilm'><integer name='width' value='24'/><integer name='height' value='24'/><rfilter type='box'/></film>
        </sensor>
        <bsdf type='twosided' id='matte'><bsdf type='diffuse'><rgb name='reflectance' value='0.8, 0.6, 0.4'/></bsdf></bsdf>
        <shape type='rectangle'><transform name='to_world'><scale value='3'/></transform><ref id='matte'/></shape>
        <shape type='cube'><transform name='to_world'><scale value='0.6'/><rotate z='1' angle='30'/><translate x='-0.8' z='0.7'/>
            </transform><ref id='matte'/></shape>
    </scene>)";
    Scene scene = read_scene(path.string());
    std::filesystem::remove(path);
    return scene;
}

RenderedSeries sample(const Scene& scene, const std::shared_ptr<const PathMethod>& method, DirectLight direct, std::uint64_t seed,
                      std::uint64_t samples) {
    PictureSampler::Settings settings;
    settings.method = method;
    settings.walk = {.bounces = bounces, .direct = {direct}, .rest_probability = 0.0};
    settings.seed = seed;
    settings.replicate_size = 16;
    return render_series(scene, settings, {samples, {}, {}});
}

using Means = std::vector<MeanWithError>;

Means means(const RenderedSeries& series) {
    const auto result = series.moments.result();
    Means all;
    for (std::size_t i = 0; i <= bounces; ++i) all.push_back(picture_mean(result.term(i)));
    return all;
}

// z of the difference at most 4.5. The errors together are at most 0.5% of the mean in bounces 0 and 1, and `power` later, where
// little light is left. `discretised`: the part of the mean by which bounces from 2 on may be off beside noise.
void expect_alike(const Means& a, const Means& b, const std::string& what, double power = 0.02, double discretised = 0.0) {
    for (std::size_t i = 0; i <= bounces; ++i) {
        const double error = std::hypot(a[i].standard_error, b[i].standard_error);
        EXPECT_LE(std::abs(a[i].mean - b[i].mean), 4.5 * error + (i < 2 ? 1e-6 : discretised) * b[i].mean)
            << what << ", bounce " << i << ": " << a[i].mean << " and " << b[i].mean << " ± " << error;
        EXPECT_LE(error, (i < 2 ? 0.005 : power) * b[i].mean) << what << ", bounce " << i;
    }
}

void expect_agreement(const std::string& lights, bool found_by_chance) {
    const Scene scene = open_scene(lights);
    const Means walked = means(sample(scene, plain_walks(), DirectLight::mis, 1, 2048));
    expect_alike(means(sample(scene, plain_walks(), DirectLight::light, 2, 2048)), walked, "walk by lights alone");
    if (found_by_chance) {
        expect_alike(means(sample(scene, plain_walks(), DirectLight::bsdf, 3, 2048)), walked, "walk by chance alone");
        expect_alike(means(sample(scene, physics::paths_of(method::Pointwise{}), DirectLight::mis, 4, 1024)), walked, "pointwise");
    }
    for (const FieldReading method : {FieldReading::matrix, FieldReading::gather}) {
        FieldSettings settings;
        settings.reading = method;
        settings.bounces = bounces;
        settings.rest = false;
        settings.patching.patches = 3000;
        settings.rays = settings.light_samples = 16;
        settings.samples = 8;
        settings.replicates = 32;
        settings.seed = 5;
        const FieldPictures pictures = *render_fields(scene, settings);
        Means found;
        for (std::size_t i = 0; i <= bounces; ++i) found.push_back(pictures.mean_of_term(i));
        expect_alike(found, walked, method == FieldReading::matrix ? "matrix" : "gather", 0.04, 0.01);
    }
}

constexpr const char* sky = "<emitter type='constant'><rgb name='radiance' value='1, 2, 3'/></emitter>";
constexpr const char* point =
    "<emitter type='point'><point name='position' value='0.5, -1, 2.5'/><rgb name='intensity' value='9, 6, 3'/></emitter>";
constexpr const char* sun =
    "<emitter type='directional'><vector name='direction' value='1, 1, -2'/><rgb name='irradiance' value='3, 2, 1'/></emitter>";

// 5 comparisons of 4 bounces.
TEST(OpenScenesSlow, UnderTheSky) { expect_agreement(std::string(sky) + mirror, true); }
// 3 comparisons each. Without the mirror: the walk does not find what comes from a light without extent by way of one.
TEST(OpenScenesSlow, WithAPointLight) { expect_agreement(point, false); }
TEST(OpenScenesSlow, WithAllOfThem) { expect_agreement(std::string(sky) + point + sun, false); }

}  // namespace neumann::agreement_open_scenes_test
