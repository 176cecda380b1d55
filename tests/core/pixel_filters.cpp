// Samples drawn from the reconstruction filters, against the filters' formulas.
#include "core/sensor/perspective.h"

#include <gtest/gtest.h>
#include <algorithm>
#include <numbers>

namespace neumann::pixel_filters_test {

constexpr double pi = std::numbers::pi;

struct Known {
    std::string name;
    PixelFilter filter;
    std::function<double(double)> f;
    double radius;
};

double sinc(double x) { return x == 0.0 ? 1.0 : std::sin(pi * x) / (pi * x); }

// Mitchell and Netravali 1988, equation 8.
double cubic(double b, double c, double x) {
    const double t = std::abs(x);
    if (t < 1.0) return ((12 - 9 * b - 6 * c) * t * t * t + (-18 + 12 * b + 6 * c) * t * t + (6 - 2 * b)) / 6;
    return ((-b - 6 * c) * t * t * t + (6 * b + 30 * c) * t * t + (-12 * b - 48 * c) * t + (8 * b + 24 * c)) / 6;
}

std::vector<Known> filters() {
    const auto tent = [](double r) { return [r](double x) { return 1.0 - std::abs(x) / r; }; };
    const auto gaussian = [](double s) { return [s](double x) { return std::exp(-x * x / (2 * s * s)) - std::exp(-8.0); }; };
    const auto mitchell = [](double b, double c) { return [b, c](double x) { return cubic(b, c, x); }; };
    const auto lanczos = [](int n) { return [n](double x) { return sinc(x) * sinc(x / n); }; };
    return {{"box", BoxFilter(), [](double) { return 1.0; }, 0.5},
            {"tent", TentFilter(), tent(1.0), 1.0},
            {"narrow tent", TentFilter(0.3), tent(0.3), 0.3},
            {"wide tent", TentFilter(2.7), tent(2.7), 2.7},
            {"gaussian", GaussianFilter(), gaussian(0.5), 2.0},
            {"wide gaussian", GaussianFilter(1.1), gaussian(1.1), 4.4},
            {"mitchell", SignedFilter::mitchell(), mitchell(1.0 / 3.0, 1.0 / 3.0), 2.0},
            {"mitchell, B-spline", SignedFilter::mitchell(1.0, 0.0), mitchell(1.0, 0.0), 2.0},
            {"mitchell, B = C = 0", SignedFilter::mitchell(0.0, 0.0), mitchell(0.0, 0.0), 2.0},
            {"mitchell, B = C = 1", SignedFilter::mitchell(1.0, 1.0), mitchell(1.0, 1.0), 2.0},
            {"catmullrom", SignedFilter::catmull_rom(), mitchell(0.0, 0.5), 2.0},
            {"lanczos", SignedFilter::lanczos(), lanczos(3), 3.0},
            {"lanczos, 1 lobe", SignedFilter::lanczos(1), lanczos(1), 1.0},
            {"lanczos, 5 lobes", SignedFilter::lanczos(5), lanczos(5), 5.0}};
}

// Midpoint rule; with 4000 points a pixel its error is below 1e-6 even where |f| has an edge.
template <class F>
double integral(const F& f, double from, double to) {
    if (from >= to) return 0.0;
    const int n = static_cast<int>(std::ceil((to - from) * 4000.0));
    double sum = 0.0;
    for (int i = 0; i < n; ++i) sum += f(from + (to - from) * (i + 0.5) / n);
    return sum * (to - from) / n;
}

struct Cut {
    int pixel;
    FilmExtent film;
};
constexpr double infinity = std::numeric_limits<double>::infinity();
const Cut cuts[] = {{7, {0.0, 100.0}}, {0, {0.0, 100.0}}, {1, {0.0, 3.0}},
                    {2, {0.0, 3.0}},   {0, {0.0, 1.0}},   {0, {-infinity, infinity}}};

FilterSample sample(const PixelFilter& filter, double u, const Cut& cut) {
    return std::visit([&](const auto& f) { return f.sample(u, cut.pixel, cut.film); }, filter);
}

// Evenly spaced numbers, so that bins fill as the density says up to one sample at each end.
TEST(PixelFilters, HistogramsAgainstTheFormulas) {
    constexpr int n = 1 << 16, bins_per_pixel = 10;
    for (const Known& known : filters())
        for (const Cut& cut : cuts) {
            SCOPED_TRACE(known.name + ", pixel " + std::to_string(cut.pixel) + " of " + std::to_string(cut.film.to));
            const double center = cut.pixel + 0.5, low = std::max(-known.radius, cut.film.from - center),
                         high = std::min(known.radius, cut.film.to - center);
            const auto size = [&](double x) { return std::abs(known.f(x)); };
            const double all = integral(known.f, low, high), all_sizes = integral(size, low, high);
            const int bins = static_cast<int>(std::ceil((high - low) * bins_per_pixel));
            const double width = (high - low) / bins;
            std::vector<double> found(static_cast<std::size_t>(bins)), count(found);
            double largest = 0.0;
            for (int i = 0; i < n; ++i) {
                const FilterSample s = sample(known.filter, (i + 0.5) / n, cut);
                const double x = s.position - center;
                ASSERT_GE(x, low - 1e-12);
                ASSERT_LE(x, high + 1e-12);
                const auto bin = static_cast<std::size_t>(std::clamp(static_cast<int>((x - low) / width), 0, bins - 1));
                found[bin] += s.weight / n;
                count[bin] += 1.0 / n;
                largest = std::max(largest, std::abs(s.weight));
            }
            for (int k = 0; k < bins; ++k) {
                const auto bin = static_cast<std::size_t>(k);
                const double from = low + k * width, to = from + width;
                EXPECT_NEAR(found[bin], integral(known.f, from, to) / all, 2.0 * largest / n + 1e-5) << "bin " << k;
                EXPECT_NEAR(count[bin], integral(size, from, to) / all_sizes, 2.0 / n + 2e-5) << "bin " << k;
            }
            EXPECT_NEAR(largest, all_sizes / all, 0.02 * largest);
        }
}

// A constant picture stays constant, at the film's edges too: weights are 1 on average. Where there are no negative lobes each is.
TEST(PixelFilters, WeightsAreOneOnAverage) {
    constexpr int n = 1 << 16;
    for (const Known& known : filters())
        for (const Cut& cut : cuts) {
            double sum = 0.0;
            for (int i = 0; i < n; ++i) {
                const double weight = sample(known.filter, (i + 0.5) / n, cut).weight;
                if (!std::holds_alternative<SignedFilter>(known.filter)) {
                    ASSERT_EQ(weight, 1.0) << known.name;
                }
                sum += weight / n;
            }
            EXPECT_NEAR(sum, 1.0, 1e-4) << known.name << ", pixel " << cut.pixel << " of " << cut.film.to;
        }
}

TEST(PixelFilters, EndsOfTheUnitInterval) {
    for (const Known& known : filters())
        for (const Cut& cut : cuts)
            for (const double u : {0.0, 0x1p-53, 0.5, 0x1.fffffffffffffp-1}) {
                const FilterSample s = sample(known.filter, u, cut);
                EXPECT_TRUE(std::isfinite(s.weight)) << known.name;
                EXPECT_NEAR(s.position, cut.pixel + 0.5, known.radius + 1e-12) << known.name;
                EXPECT_GE(s.position, cut.film.from) << known.name;
                EXPECT_LE(s.position, cut.film.to) << known.name;
            }
}

TEST(PixelFilters, WeightsOfBothAxesMultiply) {
    const SignedFilter lanczos = SignedFilter::lanczos();
    const FilmSample both = neumann::sample(PixelFilter(lanczos), {0.02, 0.7}, 4, 1, {0.0, 9.0}, {0.0, 5.0});
    const FilterSample x = lanczos.sample(0.02, 4, {0.0, 9.0}), y = lanczos.sample(0.7, 1, {0.0, 5.0});
    EXPECT_EQ(both.position, Vec2(x.position, y.position));
    EXPECT_EQ(both.weight, x.weight * y.weight);
    EXPECT_LT(x.weight, 0.0);
}

TEST(PixelFilters, BorderOfTheFilm) {
    Film film{.width = 8, .height = 4, .crop_width = 8, .crop_height = 4, .filter = TentFilter(2.0)};
    EXPECT_GE(film.sample({0.0, 0.0}, 0, 0).position.x, 0.0);
    EXPECT_LE(film.sample({0.999, 0.999}, 7, 3).position.y, 4.0);
    film.sample_border = true;
    EXPECT_EQ(film.sample({0.0, 0.5}, 0, 0).position, Vec2(-1.5, 0.5));
    EXPECT_GT(film.sample({0.999, 0.999}, 7, 3).position.y, 4.0);
}

}  // namespace neumann::pixel_filters_test
