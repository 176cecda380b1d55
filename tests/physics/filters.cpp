// Pictures through reconstruction filters.
#include "operators/render/from_fields/field_rendering.h"
#include "operators/render/methods/render.h"
#include "tests/physics/scene_maker.h"

#include <gtest/gtest.h>
#include <algorithm>
#include <glm/gtc/matrix_transform.hpp>

namespace neumann::physics::filters_test {

constexpr int width = 8, height = 2;
constexpr double edge = 4.05;  // where the lamp begins, pixels

struct Named {
    std::string name;
    PixelFilter filter;
    std::function<double(double)> f;
    double radius;
};

std::vector<Named> filters() {
    const SignedFilter mitchell = SignedFilter::mitchell(), catmull_rom = SignedFilter::catmull_rom(),
                       lanczos = SignedFilter::lanczos();
    return {{"tent", TentFilter(1.5), [](double x) { return 1.0 - std::abs(x) / 1.5; }, 1.5},
            {"gaussian", GaussianFilter(), [](double x) { return std::exp(-2.0 * x * x) - std::exp(-8.0); }, 2.0},
            {"mitchell", mitchell, mitchell, 2.0},
            {"catmullrom", catmull_rom, catmull_rom, 2.0},
            {"lanczos", lanczos, lanczos, 3.0}};
}

// A camera that looks down at a floor, which shines on the right of `edge`.
Scene step(const PixelFilter& filter, bool sample_border) {
    SceneMaker maker;
    const double x = 2.0 * edge / width - 1.0;
    maker.add(parallelogram({x, -100, 0}, {100, 0, 0}, {0, 200, 0}), lamp(1.0));
    maker.parts.film = {.width = width,
                        .height = height,
                        .crop_width = width,
                        .crop_height = height,
                        .filter = filter,
                        .sample_border = sample_border};
    maker.parts.camera.to_world =
        glm::translate(Mat4(1.0), Vec3(0, 0, 1)) * glm::rotate(Mat4(1.0), glm::radians(180.0), Vec3(0, 1, 0));
    maker.parts.camera.fov = glm::radians(90.0);
    return maker.make();
}

// Midpoint rule.
double integral(const std::function<double(double)>& f, double from, double to) {
    if (from >= to) return 0.0;
    constexpr int n = 20000;
    double sum = 0.0;
    for (int i = 0; i < n; ++i) sum += f(from + (to - from) * (i + 0.5) / n);
    return sum * (to - from) / n;
}

double splatted(const Named& filter, int column, bool sample_border) {
    const double center = column + 0.5;
    const double low = sample_border ? -filter.radius : std::max(-filter.radius, -center),
                 high = sample_border ? filter.radius : std::min(filter.radius, width - center);
    return integral(filter.f, std::clamp(edge - center, low, high), high) / integral(filter.f, low, high);
}

// A step, with what rings beside it, against the integral that splatting tends to. 5 filters, 8 columns, with the film's border and
// without: 80 comparisons from 64 replicates at |t| ≤ 5, for where only the end of a filter reaches the lamp few samples find it,
// and their number is skewed. 3200 comparisons with 40 seeds reached 4.53. Standard errors are at most 0.5% of the lamp.
TEST(Filters, StepAgainstSplatting) {
    for (const Named& named : filters())
        for (const bool sample_border : {false, true}) {
            const Goal goal{.bounces = 0, .samples = 64 * 256, .replicates = 64, .seed = 5, .only_pictures = true};
            const Estimate found = render(step(named.filter, sample_border), method::Walk(), goal).term(0);
            for (int column = 0; column < width; ++column) {
                double sum = 0.0, variance = 0.0;
                for (int row = 0; row < height; ++row) {
                    const auto pixel = static_cast<std::size_t>(row * width + column);
                    sum += found.mean.pixels[pixel].g / height;
                    variance += std::pow(found.standard_error.pixels[pixel].g / height, 2.0);
                }
                const double error = std::sqrt(variance), exact = splatted(named, column, sample_border);
                EXPECT_LE(error, 0.005) << named.name;
                EXPECT_LE(std::abs(sum - exact), 5.0 * error + 1e-6) << named.name << ", column " << column;
            }
        }
}

// The same in a picture from fields, of as many samples and replicates as above: 40 comparisons at |t| ≤ 5. 240 of them, with six
// seeds, reached 2.7, and standard errors 0.3% of the lamp.
TEST(Filters, StepFromFields) {
    for (const Named& named : filters()) {
        FieldSettings settings;
        settings.bounces = 0;
        settings.patching.patches = 10;
        settings.samples = 256;
        settings.replicates = 64;
        const Estimate found = render_fields(step(named.filter, false), settings)->term(0);
        for (int column = 0; column < width; ++column) {
            const auto pixel = static_cast<std::size_t>(column);
            const double error = found.standard_error.pixels[pixel].g, exact = splatted(named, column, false);
            EXPECT_LE(error, 0.005) << named.name;
            EXPECT_LE(std::abs(found.mean.pixels[pixel].g - exact), 5.0 * error + 1e-6) << named.name << ", column " << column;
        }
    }
}

// Where everything is the same everywhere, every bounce of a pixel is its mean weight times ρ^i. With two samples a pixel weights
// are far from 1, and each way to read a bounce has to weigh alike, up to rounding; bounce 1 looks for lights and is noisy, unless
// it is read on patches, so it is compared over all. Its standard error is 0.8% over 24 seeds, and 4.5 of these are allowed, a
// false alarm in 7 of a million seeds.
TEST(Filters, EveryBounceWeighsAlike) {
    constexpr double rho = 0.5;
    SceneMaker maker;
    maker.add(room({-1, -1, -1}, {1, 1, 1}), glowing(rho, 1.0));
    maker.parts.film = {.width = 32, .height = 32, .crop_width = 32, .crop_height = 32, .filter = SignedFilter::lanczos()};
    maker.parts.camera.fov = glm::radians(60.0);
    const Scene scene = maker.make();
    for (const FieldReading method : {FieldReading::matrix, FieldReading::gather, FieldReading::patches}) {
        FieldSettings settings;
        settings.reading = method;
        settings.bounces = 4;
        settings.patching.patches = 600;
        settings.rays = 64;
        settings.samples = 2;
        settings.replicates = 1;
        const FieldPictures found = *render_fields(scene, settings);
        const Image weights = found.term_mean(0);
        double smallest = 1.0, largest = 1.0;
        for (const Rgb& w : weights.pixels) {
            smallest = std::min(smallest, w.g);
            largest = std::max(largest, w.g);
        }
        EXPECT_LT(smallest, 0.0);
        EXPECT_GT(largest, 1.5);
        for (int i = 1; i <= settings.bounces; ++i) {
            const Image term = found.term_mean(static_cast<std::size_t>(i));
            double product = 0.0, square = 0.0, worst = 0.0;
            for (std::size_t pixel = 0; pixel < term.pixels.size(); ++pixel) {
                const double w = weights.pixels[pixel].g, ratio = term.pixels[pixel].g / std::pow(rho, i);
                product += w * ratio;
                square += w * w;
                worst = std::max(worst, std::abs(ratio - w));
            }
            if (i == 1 && method != FieldReading::patches) {
                EXPECT_NEAR(product / square, 1.0, 4.5 * 0.008) << "bounce " << i;
            } else {
                EXPECT_LE(worst, 1e-12 * largest) << "bounce " << i;
            }
        }
    }
}

}  // namespace neumann::physics::filters_test
