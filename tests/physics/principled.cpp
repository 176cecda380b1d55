// The principled materials: Mitsuba's formulas at single directions, sampling, and how far they are from the laws that they do not
// promise.
#include "tests/physics/material_laws.h"

#include <algorithm>

namespace neumann::physics::principled_test {

using Side = Principled::Side;

std::shared_ptr<PrincipledParameters> parameters(const Rgb& color, double roughness) {
    auto v = std::make_shared<PrincipledParameters>();
    v->base_color = color;
    v->roughness = Rgb(roughness);
    return v;
}
const Rgb orange(0.9, 0.5, 0.2);

struct Named {
    std::string name;
    Bsdf bsdf;
};
std::vector<Named> thick() {
    std::vector<Named> all;
    all.push_back({"plain", Principled(parameters(orange, 0.5), Side::outside)});
    auto metal = parameters(orange, 0.4);
    metal->metallic = Rgb(0.8);
    metal->anisotropic = Rgb(0.7);
    metal->spec_tint = Rgb(0.5);
    all.push_back({"metal", Principled(metal, Side::outside)});
    auto cloth = parameters(orange, 0.9);
    cloth->sheen = Rgb(1.0);
    cloth->sheen_tint = Rgb(0.5);
    cloth->flatness = Rgb(0.6);
    all.push_back({"cloth", Principled(cloth, Side::outside)});
    auto car = parameters(orange, 0.6);
    car->clearcoat = Rgb(1.0);
    all.push_back({"car", Principled(car, Side::outside)});
    auto glass = parameters(orange, 0.6);
    glass->spec_trans = Rgb(0.7);
    glass->metallic = Rgb(0.1);
    glass->eta = Rgb(1.33);
    all.push_back({"glass from outside", Principled(glass, Side::outside)});
    all.push_back({"glass from inside", Principled(glass, Side::inside)});
    return all;
}
std::vector<Named> thin() {
    std::vector<Named> all;
    auto paper = parameters(orange, 0.5);
    paper->diff_trans = Rgb(0.8);
    paper->sheen = Rgb(0.3);
    all.push_back({"paper", PrincipledThin(paper)});
    auto film = parameters(orange, 0.6);
    film->spec_trans = Rgb(0.8);
    film->diff_trans = Rgb(1.0);
    film->anisotropic = Rgb(0.5);
    film->spec_tint = Rgb(0.5);
    all.push_back({"film", PrincipledThin(film)});
    return all;
}
std::vector<Named> both() {
    std::vector<Named> all = thick();
    for (Named& n : thin()) all.push_back(std::move(n));
    return all;
}
Vec3 view(double mu, double phi) {
    const double sine = std::sqrt(1.0 - mu * mu);
    return {sine * std::cos(phi), sine * std::sin(phi), mu};
}

// Towards the normal, both ways: Fi = Fo = 0, D = 1/(π αu αv), G = 1, F = ((η − 1)/(η + 1))².
TEST(Principled, HasItsValuesTowardsTheNormal) {
    const Vec3 up(0, 0, 1);
    const auto value = [&](const PrincipledParameters& v) {
        return eval(Bsdf(Principled(std::make_shared<PrincipledParameters>(v), Side::outside)), {}, up, up);
    };
    PrincipledParameters v = *parameters(orange, 0.5);
    // Roughness 0.5: α = 0.25. The diffuse part is the colour over π, for retro-reflection is at grazing angles only.
    const double D = inv_pi / 0.0625, F = 0.04;
    EXPECT_NEAR(value(v).g, 0.5 * inv_pi + F * D / 4.0, 1e-13);
    v.metallic = Rgb(0.25);
    EXPECT_NEAR(value(v).g, 0.75 * 0.5 * inv_pi + (0.75 * F + 0.25 * 0.5) * D / 4.0, 1e-13);
    v.spec_tint = Rgb(0.5);
    const double luminance = 0.9 * 0.212671 + 0.5 * 0.715160 + 0.2 * 0.072169;
    EXPECT_NEAR(value(v).g, 0.75 * 0.5 * inv_pi + (0.75 * (0.5 * F + 0.5 * F * 0.5 / luminance) + 0.25 * 0.5) * D / 4.0, 1e-13);
    v = *parameters(orange, 0.5);
    v.anisotropic = Rgb(1.0);  // α = 0.25/√0.1 and 0.25 √0.1
    EXPECT_NEAR(value(v).g, 0.5 * inv_pi + F * D / 4.0, 1e-13);
    v.anisotropic = Rgb(0.0);
    v.clearcoat = Rgb(0.8);  // α = 0.1: D = (1 − a²)/(−π ln a² a²)
    const double coat = 0.99 * inv_pi / (std::log(100.0) * 0.01);
    EXPECT_NEAR(value(v).g, 0.5 * inv_pi + F * D / 4.0 + 0.25 * 0.8 * 0.04 * coat, 1e-12);
    v.clearcoat = Rgb(0.0);
    v.flatness = Rgb(1.0);  // 1.25 (1/2 − 1/2 + 1/2)
    EXPECT_NEAR(value(v).g, 0.5 * 0.625 * inv_pi + F * D / 4.0, 1e-13);
}

// Burley's diffuse and sheen at one pair of directions, with the angles in numbers: cosθo = 0.8, cosθi = 0.6 opposite, so that
// ωo·ωi = 0.48 − 0.48 = 0 and cos²θd = 1/2. A rough metal's specular part is taken away by η = 1.
TEST(Principled, HasBurleysDiffuseAndSheen) {
    auto v = parameters(orange, 0.5);
    v->eta = Rgb(1.0);
    v->sheen = Rgb(0.7);
    const double o = std::pow(0.2, 5), i = std::pow(0.4, 5), d = std::pow(1.0 - std::sqrt(0.5), 5), R = 2.0 * 0.5 * 0.5;
    const double base = (1.0 - 0.5 * o) * (1.0 - 0.5 * i) + R * (o + i + o * i * (R - 1.0));
    const Vec3 wo(0.6, 0, 0.8), wi(-0.8, 0, 0.6);
    EXPECT_NEAR(eval(Bsdf(Principled(v, Side::outside)), {}, wo, wi).g, 0.5 * inv_pi * base + 0.7 * d, 1e-14);
    // Of the sheet half the base goes through, without what depends on directions.
    v->diff_trans = Rgb(1.0);
    EXPECT_NEAR(eval(Bsdf(PrincipledThin(v)), {}, wo, wi).g, 0.5 * (0.5 * inv_pi * base + 0.7 * d), 1e-14);
    EXPECT_NEAR(eval(Bsdf(PrincipledThin(v)), {}, wo, -wo).g, 0.5 * 0.5 * inv_pi, 1e-14);
}

// Clear glass without absorption: what is reflected and let through is 1 but for facets that hide. With α = 0.04 those are few.
// Radiance that comes out of glass is 1/η² of it, and inside it is η² of that outside.
TEST(Principled, OfGlassAllLightGoesOn) {
    auto v = parameters(Rgb(1.0), 0.2);
    v->spec_trans = Rgb(1.0);
    for (const Side side : {Side::outside, Side::inside}) {
        const Bsdf bsdf = Principled(v, side);
        const double factor = side == Side::outside ? 2.25 : 1.0 / 2.25;
        for (const double mu : {1.0, 0.9}) {
            double sum = 0.0;
            constexpr int n = 200;
            for (int x = 0; x < n; ++x)
                for (int y = 0; y < n; ++y) {
                    const BsdfSample s = sample(bsdf, {}, at_cosine(mu), {(x + 0.5) / n, (y + 0.5) / n});
                    sum += s.weight.g * (s.wi.z < 0.0 ? factor : 1.0);
                }
            EXPECT_NEAR(sum / (n * n), 1.0, 5e-3) << mu;
        }
    }
}

// 8 materials × 3 views: 24 comparisons, each with the false-alarm rate of |z| > 4.5, 6.8e-6.
TEST(Principled, DirectionsAreDrawnWithTheirDensity) {
    std::uint32_t stream = 200;
    for (const auto& [name, bsdf] : both())
        for (const Vec3& wo : {view(1.0, 0.0), view(0.6, 1.0), view(0.2, 3.0)})
            EXPECT_GE(directions_p_value(bsdf, {}, wo, stream++), 6.8e-6) << name << ", z " << wo.z;
}

TEST(Principled, TheWeightTimesTheDensityIsTheScatteringFunction) {
    for (const auto& [name, bsdf] : both()) {
        SCOPED_TRACE(name);
        for (const Vec3& wo : {view(1.0, 0.0), view(0.6, 1.0), view(0.2, 3.0)}) expect_consistent_samples(bsdf, {}, wo, 1e-7);
    }
}

// On one side it is reciprocal, though nobody promises it; through the surface fs / n² is.
TEST(Principled, IsReciprocal) {
    for (const auto& [name, bsdf] : both()) EXPECT_LE(largest_irreciprocity(bsdf, {}), 1e-10) << name;
    auto v = parameters(orange, 0.6);
    v->spec_trans = Rgb(0.7);
    const Bsdf outside = Principled(v, Side::outside), inside = Principled(v, Side::inside);
    Sampler sampler(fixed_seed, 3);
    const auto flipped = [](const Vec3& w) { return Vec3(w.x, w.y, -w.z); };  // to the frame of the other side
    for (std::uint64_t i = 0; i < 1000; ++i) {
        sampler.start(i);
        const Vec3 a = uniform_hemisphere(sampler.next2()), b = flipped(uniform_hemisphere(sampler.next2()));
        const double one = eval(outside, {}, a, b).g, other = eval(inside, {}, flipped(b), flipped(a)).g / 2.25;
        EXPECT_NEAR(one, other, 1e-6 * one);
    }
}

// The thin one is not, where the sheet lets through at grazing angles: light counts from a to b and not from b to a.
TEST(PrincipledThin, IsNotReciprocalThrough) {
    const Bsdf film = thin().back().bsdf;
    Sampler sampler(fixed_seed, 4);
    int differing = 0;
    for (std::uint64_t i = 0; i < 1000; ++i) {
        sampler.start(i);
        const Vec3 a = uniform_hemisphere(sampler.next2()), b = uniform_hemisphere(sampler.next2());
        const Vec3 a_below(a.x, a.y, -a.z), b_below(b.x, b.y, -b.z);
        const double one = eval(film, {}, a, b_below).g, other = eval(film, {}, b, a_below).g;
        differing += std::abs(one - other) > 1e-9 * one;
    }
    RecordProperty("pairs_of_1000_that_differ", differing);
    EXPECT_GT(differing, 0);
}

// The measured bound holds between the angles that were looked at; by quadrature of fs over both hemispheres.
TEST(Principled, ReflectsNoMoreThanWasMeasured) {
    for (const auto& [name, bsdf] : both()) {
        double largest = 0.0;
        for (const double mu : {0.97, 0.65, 0.33, 0.14, 0.03})
            for (const double phi : {0.5, 1.3}) {
                const Vec3 wo = view(mu, phi);
                const double found = albedo_of_both_sides(bsdf, wo, 0);
                largest = std::max(largest, found);
            }
        EXPECT_LE(largest, largest_albedo(bsdf).r) << name;
        EXPECT_GE(largest, 0.7 * largest_albedo(bsdf).r) << name;
        RecordProperty("largest_albedo_of_" + std::string(name.begin(), name.begin() + 4), std::to_string(largest_albedo(bsdf).r));
    }
}

// A texture of weights is bounded as its ends are.
TEST(Principled, VariesOverTheSurface) {
    auto v = parameters(orange, 0.5);
    v->metallic = SurfaceFunction([](const ShadingPoint& p) { return Rgb(texture_coordinates(p).x); }, Rgb(1.0));
    const Bsdf varying = Principled(v, Side::outside);
    EXPECT_FALSE(is_constant(varying));
    EXPECT_TRUE(needs_coordinates(varying));
    const ShadingPoint p = point_with_coordinates({0.3, 0.0});
    auto here = parameters(orange, 0.5);
    Rgb largest(0.0);
    for (const double metallic : {0.0, 1.0, 0.3}) {
        here->metallic = Rgb(metallic);
        const Bsdf fixed = Principled(std::make_shared<PrincipledParameters>(*here), Side::outside);
        if (metallic == 0.3) {
            const Vec3 wo = view(0.6, 1.0), wi = view(0.5, 2.0);
            EXPECT_EQ(eval(varying, p, wo, wi), eval(fixed, {}, wo, wi));
        } else {
            largest = glm::max(largest, largest_albedo(fixed));
        }
    }
    EXPECT_EQ(largest_albedo(varying), largest);
}

}  // namespace neumann::physics::principled_test
