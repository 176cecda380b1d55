// Where paths from the light begin and where they end: emission, the camera as seen from a point, filters, and R*.
#include "core/emitter/emission_sampler.h"
#include "core/reader/read_scene.h"
#include "core/sampling/sampler.h"
#include "operators/pointwise/adjoint_reflection.h"
#include "tests/physics/scene_maker.h"
#include "tests/physics/seed.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace neumann::physics::light_departure_test {

Scene scene_with(const char* light, const char* camera, const char* things) {
    return read_scene(TEST_DATA "/generators/room.xml", {{"light", std::string(light) + ".xml"},
                                                         {"camera", std::string(camera) + ".xml"},
                                                         {"things", std::string(things) + ".xml"}});
}

// see() undoes ray(), and counts pixels as the rays of neighbouring places tell.
TEST(Cameras, SeePointsWhereTheirRaysPass) {
    for (const char* name : {"pinhole", "lens", "parallel"}) {
        const Scene scene = scene_with("area", name, "rough");
        Sampler sampler(fixed_seed, 0);
        for (int i = 0; i < 200; ++i) {
            sampler.start(static_cast<std::uint64_t>(i));
            const Vec2 at = sampler.next2() * Vec2(scene.film.width, scene.film.height), lens = sampler.next2();
            const CameraRay ray = scene.camera.ray(at, lens);
            const double distance = ray.length * (0.02 + 0.9 * sampler.next());
            const Vec3 p = ray.origin + ray.direction * distance;
            const auto seen = scene.camera.see(p, lens);
            ASSERT_TRUE(seen) << name;
            EXPECT_NEAR(seen->position.x, at.x, 1e-9);
            EXPECT_NEAR(seen->position.y, at.y, 1e-9);
            EXPECT_NEAR(glm::distance(seen->start.position, ray.origin), 0.0, 1e-9);
            EXPECT_NEAR(glm::distance(seen->w, -ray.direction), 0.0, 1e-12);
            // The area between three neighbouring rays, across the middle one: it is flat to h².
            constexpr double h = 1e-4;
            const auto across = [&](const Vec2& step) {
                const CameraRay a = scene.camera.ray(at - step, lens), b = scene.camera.ray(at + step, lens);
                const auto meet = [&](const CameraRay& r) {
                    return r.origin + r.direction * (glm::dot(p - r.origin, ray.direction) / glm::dot(r.direction, ray.direction));
                };
                return (meet(b) - meet(a)) / (2.0 * h);
            };
            const double area = glm::length(glm::cross(across({h, 0.0}), across({0.0, h})));
            EXPECT_NEAR(seen->pixels_per_area * area, 1.0, 1e-6) << name;
            EXPECT_NEAR(scene.camera.pixels_per_area(ray, p) / seen->pixels_per_area, 1.0, 1e-9) << name;
        }
    }
}

// ∫ weight dx = 1 over the film, at its edge too; Simpson's rule, which the edges of a filter cost some digits.
TEST(Filters, WeightPlacesOnTheFilmAsTheyDrawThem) {
    const PixelFilter filters[] = {BoxFilter(), TentFilter(1.5), GaussianFilter(), SignedFilter::mitchell(),
                                   SignedFilter::lanczos()};
    for (const PixelFilter& filter : filters)
        for (const int pixel : {0, 1, 5})
            for (const FilmExtent& film : {FilmExtent{0.0, 6.0}, FilmExtent{-INFINITY, INFINITY}}) {
                const double low = std::max(pixel + 0.5 - radius(filter), film.from),
                             high = std::min(pixel + 0.5 + radius(filter), film.to);
                constexpr int n = 20000;
                double all = 0.0, first = 0.0, drawn = 0.0;
                for (int i = 0; i < n; ++i) {
                    const double u = (i + 0.5) / n, x = low + u * (high - low),
                                 w = weight(filter, x, pixel, film) * (high - low) / n;
                    all += w;
                    first += w * x;
                    const FilterSample s = std::visit([&](const auto& f) { return f.sample(u, pixel, film); }, filter);
                    drawn += s.position * s.weight / n;
                }
                EXPECT_NEAR(all, 1.0, 2e-4) << filter.index() << " " << pixel;
                EXPECT_NEAR(first, drawn, 2e-3) << filter.index() << " " << pixel;
            }
}

// What sets out is what the lights give off: π A Le of surfaces, 4π I of a point, and of lights infinitely far away what crosses
// the disc around the scene; |z| ≤ 4.5, and the rounding of the sum. 6 comparisons.
TEST(EmissionSlow, CarriesThePowerOfTheLights) {
    for (const char* light : {"area", "sky"}) {
        const Scene scene = scene_with(light, "pinhole", "rough");
        const double radius = scene.geometry.radius();
        Rgb power(0.0);
        if (std::string(light) == "area")
            power = Rgb(10, 9, 8) * (pi * 0.64);
        else
            power = Rgb(0.3, 0.4, 0.5) * (4.0 * pi * pi * radius * radius) + Rgb(6, 5, 4) * (pi * 4.0 * pi * 0.04);
        const EmissionSampler emission(scene.geometry, scene.emitters);
        constexpr int n = 200000;
        Rgb sum(0.0), square(0.0);
        Sampler sampler(fixed_seed, 0);
        for (int i = 0; i < n; ++i) {
            sampler.start(static_cast<std::uint64_t>(i));
            const Vec2 place = sampler.next2();
            const Rgb w = emission.sample(place, sampler.next2()).weight;
            sum += w;
            square += w * w;
        }
        for (int c = 0; c < 3; ++c) {
            const double mean = sum[c] / n, error = std::sqrt(std::max(square[c] / n - mean * mean, 0.0) / n);
            EXPECT_LE(std::abs(mean - power[c]), 4.5 * error + 1e-10 * power[c]) << light;
        }
    }
}

// R* draws with the density it tells, and its weights are those of R: E[w g(ωo)] = ∫ fs(ωi → ωo) |ωi·ns/ωi·ng| |ωo·ng| g dωo with
// g = (1 + ωo.x + 2 ωo.z²)/4, by uniform directions. All things of two scenes, from both sides; |z| ≤ 4.5, about 90 comparisons.
// Where only few directions are counted, Poisson's law lets them be 5 more or less.
TEST(AdjointReflectionSlow, ReflectsAsTheMaterialsSay) {
    for (const char* things : {"rough", "shaded"}) {
        const Scene scene = scene_with("area", "pinhole", things);
        Sampler sampler(fixed_seed, 1);
        for (std::uint32_t shape = 0; shape < scene.geometry.shapes().size(); ++shape)
            for (int side_number = 0; side_number < 6; ++side_number) {
                sampler.start(shape * 64 + static_cast<std::uint64_t>(side_number));
                const auto primitive = static_cast<std::uint32_t>(sampler.next() * scene.geometry.primitive_count(shape));
                const SurfacePoint x = scene.geometry.point(shape, primitive, sampler.next2());
                const Vec3 wi = uniform_sphere(sampler.next2());
                const SurfaceSide side = scene.materials.side(x, wi);
                if (!side.bsdf || lobe(*side.bsdf).kind == Lobe::Kind::specular || std::abs(glm::dot(wi, x.normal)) < 0.2) continue;
                const auto g = [](const Vec3& w) { return 0.25 * (1.0 + w.x + 2.0 * w.z * w.z); };
                constexpr int n = 60000;
                double drawn = 0.0, drawn2 = 0.0, uniform = 0.0, uniform2 = 0.0, share = 0.0, share2 = 0.0;
                Sampler random(fixed_seed, 2 + shape * 64 + static_cast<std::uint32_t>(side_number));
                for (int i = 0; i < n; ++i) {
                    random.start(static_cast<std::uint64_t>(i));
                    const AdjointReflection::Sample s = AdjointReflection::sample(scene.materials, side, wi, random.next2());
                    const double a = s.pdf > 0.0 ? s.weight.g * g(s.wo) : 0.0;
                    drawn += a;
                    drawn2 += a * a;
                    // Of the directions with wo.x > 0, by counting and by their density.
                    const Vec3 wo = uniform_sphere(random.next2());
                    const SurfaceSide there = scene.materials.side(x, wo);
                    const double b =
                        there.bsdf ? geometric_bsdf(there, wo, wi).g * std::abs(glm::dot(x.normal, wo)) * g(wo) * 4.0 * pi : 0.0;
                    uniform += b;
                    uniform2 += b * b;
                    const double c = (s.pdf > 0.0 && s.wo.x > 0.0 ? 1.0 : 0.0) -
                                     (wo.x > 0.0 && there.bsdf ? AdjointReflection::pdf(side, wi, wo) * 4.0 * pi : 0.0);
                    share += c;
                    share2 += c * c;
                }
                const double error = std::sqrt((drawn2 - drawn * drawn / n) + (uniform2 - uniform * uniform / n));
                EXPECT_LE(std::abs(drawn - uniform), 4.5 * error + 1e-9 * n) << things << ", shape " << shape;
                EXPECT_LE(std::abs(share), 4.5 * std::sqrt(share2 - share * share / n) + 5.0) << things << ", shape " << shape;
            }
    }
}

// The same of delta lobes under tilted normals, which mirror at other normals for other ωo: by light from everywhere,
//
//     ∫ h(ωo) E[w g(ωi)] |ωo·n| dωo by R  =  ∫ g(ωi) E[w* h(ωo)] |ωi·n| dωi by R*,
//
// as both are ⟨h, R g⟩. Eight materials by three tilts; |z| ≤ 4.5.
TEST(AdjointReflectionSlow, MirrorsAtTiltedNormalsAsTheMaterialsSay) {
    const auto shared = [](Bsdf bsdf) { return std::make_shared<const Bsdf>(std::move(bsdf)); };
    for (const double tilt : {0.3, 0.8, 1.3})
        for (int number = 0; number < 8; ++number) {
            const Vec3 n(std::sin(tilt) * 0.8, std::sin(tilt) * 0.6, std::cos(tilt));
            const auto tilted = [&](Bsdf nested, bool flips = true, bool from_behind = false) {
                return Bsdf(PerturbedNormal([n](const ShadingPoint&) { return n; }, shared(std::move(nested)),
                                            {flips, number != 1, from_behind}));
            };
            const Bsdf mirror = Conductor({}, Rgb(0.9)), plastic = Plastic(1.5, Rgb(0.6), Rgb(1.0), true);
            std::vector<Bsdf> bsdfs;
            switch (number) {
                case 0:
                case 1:
                    bsdfs = {tilted(mirror)};
                    break;
                case 2:
                    bsdfs = {tilted(mirror, false)};
                    break;
                case 3:
                    bsdfs = {tilted(plastic)};
                    break;
                case 4:
                    bsdfs = {Blend(shared(Diffuse(Rgb(0.5))), shared(tilted(mirror)), Rgb(0.6))};
                    break;
                case 5:
                    bsdfs = {Mask(shared(tilted(plastic)), Rgb(0.7)), Mask(shared(tilted(plastic, true, true)), Rgb(0.7))};
                    break;
                case 6:
                    bsdfs = {Coating(shared(tilted(mirror)), 1.4, Rgb(0.2), Rgb(0.8))};
                    break;
                default:
                    bsdfs = {tilted(Dielectric(1.5)), tilted(Dielectric(1.0 / 1.5), true, true)};
            }
            SceneMaker maker;
            maker.add(parallelogram({-1, -1, 0}, {2, 0, 0}, {0, 2, 0}),
                      bsdfs.size() > 1 ? boundary(bsdfs[0], bsdfs[1]) : made_of(bsdfs[0]));
            const Scene scene = maker.make();
            const SurfacePoint x = scene.geometry.point(0, 0, Vec2(0.4));
            const auto g = [](const Vec3& w) { return 1.0 + 0.8 * w.x + w.z * w.y; };
            const auto h = [](const Vec3& w) { return 1.0 - 0.6 * w.y + 0.9 * w.x * w.z; };
            constexpr int count = 100000;
            double difference = 0.0, squares = 0.0;
            Sampler random(fixed_seed, 3 + static_cast<std::uint32_t>(number));
            for (int i = 0; i < count; ++i) {
                random.start(static_cast<std::uint64_t>(i));
                const Vec3 w = uniform_sphere(random.next2());
                const SurfaceSide side = scene.materials.side(x, w);
                const Vec2 u = random.next2();
                if (!side.bsdf) continue;
                const double cosine = std::abs(glm::dot(x.normal, w)) * 4.0 * pi;
                const BsdfSample by_camera = sample(*side.bsdf, side.p, side.p.frame.to_local(w), u);
                const AdjointReflection::Sample by_light = AdjointReflection::sample(scene.materials, side, w, u);
                double d = 0.0;
                if (by_camera.pdf > 0.0) d += h(w) * by_camera.weight.g * g(side.p.frame.to_world(by_camera.wi)) * cosine;
                if (by_light.pdf > 0.0) d -= g(w) * by_light.weight.g * h(by_light.wo) * cosine;
                difference += d;
                squares += d * d;
            }
            EXPECT_LE(std::abs(difference), 4.5 * std::sqrt(squares)) << "material " << number << ", tilt " << tilt;
        }
}

}  // namespace neumann::physics::light_departure_test
