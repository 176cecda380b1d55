#include "operators/statistics/flip.h"

#include "core/base/error.h"
#include "core/image/display.h"

#include <fmt/format.h>
#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>

namespace neumann {

namespace {

using Plane = std::vector<float>;
using Planes = std::array<Plane, 3>;
using Kernel = std::vector<float>;  // has an odd number of weights

// These constants are in Andersson et al. 2020, table 1 and sections 4 and 5.
constexpr double qc = 0.7, pc = 0.4, pt = 0.95, feature_width = 0.082;
// The D65 white of the sRGB matrix.
const Rgb white(0.950428545, 1.0, 1.088900371);

Rgb xyz_of(const Rgb& c) {
    return {(10135552 * c.r + 8788810 * c.g + 4435075 * c.b) / 24577794, (2613072 * c.r + 8788810 * c.g + 887015 * c.b) / 12288897,
            (1425312 * c.r + 8788810 * c.g + 70074185 * c.b) / 73733382};
}

Rgb rgb_of(const Rgb& xyz) {
    return {3.241003275 * xyz.x - 1.537398934 * xyz.y - 0.498615861 * xyz.z,
            -0.969224334 * xyz.x + 1.875930071 * xyz.y + 0.041554224 * xyz.z,
            0.055639423 * xyz.x - 0.204011202 * xyz.y + 1.057148933 * xyz.z};
}

// The opponent colours Y, Cx, Cz, which are linear.
Rgb opponent_of(const Rgb& rgb) {
    const Rgb r = xyz_of(rgb) / white;
    return {116.0 * r.y - 16.0, 500.0 * (r.x - r.y), 200.0 * (r.y - r.z)};
}

Rgb rgb_of_opponent(const Rgb& c) {
    const double y = (c.x + 16.0) / 116.0;
    return rgb_of(Rgb(y + c.y / 500.0, y, y - c.z / 200.0) * white);
}

// L*a*b*, whose colours count less where it is dark (the Hunt effect).
Rgb hunt_lab(const Rgb& rgb) {
    const Rgb r = xyz_of(rgb) / white;
    const auto f = [](double t) {
        constexpr double delta = 6.0 / 29.0;
        return t > delta * delta * delta ? std::cbrt(t) : t / (3.0 * delta * delta) + 4.0 / 29.0;
    };
    const double l = 116.0 * f(r.y) - 16.0, hunt = 0.01 * l;
    return {l, hunt * 500.0 * (f(r.x) - f(r.y)), hunt * 200.0 * (f(r.y) - f(r.z))};
}

double hyab(const Rgb& a, const Rgb& b) { return std::abs(a.x - b.x) + std::hypot(a.y - b.y, a.z - b.z); }

Kernel scaled(Kernel kernel, double factor) {
    for (float& w : kernel) w = static_cast<float>(w * factor);
    return kernel;
}

// exp(−x² / (2 σ²)) at −radius … radius.
Kernel gaussian(int radius, double sigma) {
    Kernel kernel;
    for (int x = -radius; x <= radius; ++x) kernel.push_back(static_cast<float>(std::exp(-x * x / (2.0 * sigma * sigma))));
    return kernel;
}

double sum_of(const Kernel& kernel) { return std::accumulate(kernel.begin(), kernel.end(), 0.0); }

// Separated convolution, with the nearest pixel beyond the edges.
class Filter {
public:
    Filter(int width, int height) : width_(static_cast<std::size_t>(width)), height_(static_cast<std::size_t>(height)) {}

    Plane rows(const Plane& in, const Kernel& kernel) const {
        const std::size_t radius = kernel.size() / 2;
        Plane out(in.size());
        oneapi::tbb::parallel_for(std::size_t{0}, height_, [&](std::size_t y) {
            Plane line(width_ + 2 * radius);
            const float* row = in.data() + y * width_;
            for (std::size_t k = 0; k < line.size(); ++k) line[k] = row[std::min(k < radius ? 0 : k - radius, width_ - 1)];
            for (std::size_t k = 0; k < kernel.size(); ++k) add(out.data() + y * width_, line.data() + k, kernel[k]);
        });
        return out;
    }
    Plane columns(const Plane& in, const Kernel& kernel) const {
        const std::size_t radius = kernel.size() / 2;
        Plane out(in.size());
        oneapi::tbb::parallel_for(std::size_t{0}, height_, [&](std::size_t y) {
            for (std::size_t k = 0; k < kernel.size(); ++k) {
                const std::size_t from = std::min(y + k < radius ? 0 : y + k - radius, height_ - 1);
                add(out.data() + y * width_, in.data() + from * width_, kernel[k]);
            }
        });
        return out;
    }

private:
    void add(float* to, const float* from, float weight) const {
        for (std::size_t x = 0; x < width_; ++x) to[x] += weight * from[x];
    }

    std::size_t width_, height_;
};

// The contrast sensitivity is a sum of terms a √(π/b) exp(−π² x²/b), x in degrees, each of which is a separable Gaussian.
struct Sensitivity {
    double a, b;
};
constexpr double widest_b = 0.04;

Plane seen(const Plane& in, const Filter& filter, std::initializer_list<Sensitivity> parts) {
    constexpr double pi = std::numbers::pi;
    const int radius = static_cast<int>(std::ceil(3.0 * std::sqrt(widest_b / (2.0 * pi * pi)) * flip_pixels_per_degree));
    double whole = 0.0;
    Plane out(in.size());
    for (const auto& [a, b] : parts) {
        const Kernel kernel = gaussian(radius, flip_pixels_per_degree * std::sqrt(b / 2.0) / pi);
        const double sum = sum_of(kernel), weight = a * std::sqrt(pi / b);
        whole += weight * sum * sum;
        const Plane part = filter.columns(filter.rows(in, scaled(kernel, weight)), kernel);
        for (std::size_t i = 0; i < out.size(); ++i) out[i] += part[i];
    }
    for (float& v : out) v = static_cast<float>(v / whole);
    return out;
}

// The strength of edges and of points in a picture's luminance.
struct Features {
    Plane edges, points;
};

Features features_of(const Plane& luminance, const Filter& filter) {
    const double sigma = 0.5 * feature_width * flip_pixels_per_degree;
    const int radius = static_cast<int>(std::ceil(3.0 * sigma));
    const Kernel plain = gaussian(radius, sigma), smooth = scaled(plain, 1.0 / sum_of(plain));
    // The positive weights add up to 1, and the negative ones to −1.
    const auto detector = [&](const auto& shape) {
        Kernel kernel = plain;
        double positive = 0.0, negative = 0.0;
        for (int x = -radius; x <= radius; ++x) {
            float& w = kernel[static_cast<std::size_t>(x + radius)];
            w = static_cast<float>(w * shape(x));
            (w > 0.0f ? positive : negative) += w;
        }
        for (float& w : kernel) w = static_cast<float>(w > 0.0f ? w / positive : -w / negative);
        return kernel;
    };
    const auto strength = [&](const Kernel& kernel) {
        const Plane x = filter.columns(filter.rows(luminance, kernel), smooth),
                    y = filter.columns(filter.rows(luminance, smooth), kernel);
        Plane out(x.size());
        for (std::size_t i = 0; i < out.size(); ++i) out[i] = std::hypot(x[i], y[i]);
        return out;
    };
    return {strength(detector([](int x) { return -x; })), strength(detector([&](int x) { return x * x / (sigma * sigma) - 1.0; }))};
}

struct Seen {
    std::vector<Rgb> colours;  // hunt_lab() of what is left after the eye's filter
    Features features;
};

Seen seen_picture(const Image& picture) {
    const std::size_t n = picture.pixels.size();
    const Filter filter(picture.width, picture.height);
    Planes opponent{Plane(n), Plane(n), Plane(n)};
    Plane luminance(n);
    oneapi::tbb::parallel_for(std::size_t{0}, n, [&](std::size_t i) {
        const Rgb c = opponent_of(picture.pixels[i]);
        for (int k = 0; k < 3; ++k) opponent[static_cast<std::size_t>(k)][i] = static_cast<float>(c[k]);
        luminance[i] = static_cast<float>((c.x + 16.0) / 116.0);
    });
    const Plane y = seen(opponent[0], filter, {{1.0, 0.0047}}), cx = seen(opponent[1], filter, {{1.0, 0.0053}}),
                cz = seen(opponent[2], filter, {{34.1, 0.04}, {13.5, 0.025}});
    Seen result{std::vector<Rgb>(n), features_of(luminance, filter)};
    oneapi::tbb::parallel_for(std::size_t{0}, n, [&](std::size_t i) {
        result.colours[i] = hunt_lab(glm::clamp(rgb_of_opponent({y[i], cx[i], cz[i]}), Rgb(0.0), Rgb(1.0)));
    });
    return result;
}

// Krzysztof Narkowicz's fit of the ACES curve, without its exposure of 0.6.
Rgb aces(const Rgb& x) {
    return glm::clamp(x * (0.6 * 0.6 * 2.51 * x + 0.6 * 0.03) / (x * (0.6 * 0.6 * 2.43 * x + 0.6 * 0.59) + 0.14), Rgb(0.0),
                      Rgb(1.0));
}

void expect_one_size(const Image& test, const Image& reference) {
    if (test.width != reference.width || test.height != reference.height)
        throw InputError(fmt::format("{}×{} pixels against {}×{}", test.width, test.height, reference.width, reference.height));
}

// The exposures, in stops, of HDR-FLIP.
std::vector<double> exposures_for(const Image& reference) {
    std::vector<double> lit;
    for (const Rgb& p : reference.pixels)
        if (const double y = luminance(p); y > 0.0) lit.push_back(y);
    if (lit.empty()) return {0.0};
    std::sort(lit.begin(), lit.end());
    // x is where the curve is t = 0.85.
    constexpr double t = 0.85, k0 = 0.6 * 0.6 * (2.51 - 2.43 * t), k1 = 0.6 * (0.03 - 0.59 * t), k2 = -0.14 * t;
    const double half = 0.5 * k1 / k0, x = -half + std::sqrt(half * half - k2 / k0);
    const double median = 0.5 * (lit[(lit.size() - 1) / 2] + lit[lit.size() / 2]);
    const double first = std::log2(x / lit.back()), last = std::log2(x / median);
    const int count = std::max(2, static_cast<int>(std::ceil(last - first)));
    std::vector<double> exposures;
    for (int i = 0; i < count; ++i) exposures.push_back(first + (last - first) * i / (count - 1));
    return exposures;
}

}  // namespace

std::vector<float> ldr_flip(const Image& test, const Image& reference) {
    expect_one_size(test, reference);
    static const double largest = std::pow(hyab(hunt_lab({0.0, 1.0, 0.0}), hunt_lab({0.0, 0.0, 1.0})), qc);
    const Seen a = seen_picture(test), b = seen_picture(reference);
    std::vector<float> error(reference.pixels.size());
    oneapi::tbb::parallel_for(std::size_t{0}, error.size(), [&](std::size_t i) {
        const double c = std::pow(hyab(a.colours[i], b.colours[i]), qc), knee = pc * largest;
        const double colour = c < knee ? pt / knee * c : pt + (c - knee) / (largest - knee) * (1.0 - pt);
        const double feature =
            std::max(std::abs(a.features.edges[i] - b.features.edges[i]), std::abs(a.features.points[i] - b.features.points[i]));
        error[i] = static_cast<float>(std::pow(colour, 1.0 - std::sqrt(feature / std::numbers::sqrt2)));
    });
    return error;
}

std::vector<float> hdr_flip(const Image& test, const Image& reference) {
    expect_one_size(test, reference);
    const auto shown = [](Image picture) {
        for (Rgb& p : picture.pixels) p = is_finite(p) ? glm::max(p, Rgb(0.0)) : Rgb(0.0);
        return picture;
    };
    const auto exposed = [](Image picture, double stops) {
        for (Rgb& p : picture.pixels) p = aces(std::exp2(stops) * p);
        return picture;
    };
    const Image a = shown(test), b = shown(reference);
    std::vector<float> error(b.pixels.size());
    for (const double stops : exposures_for(b)) {
        const std::vector<float> at = ldr_flip(exposed(a, stops), exposed(b, stops));
        for (std::size_t i = 0; i < error.size(); ++i) error[i] = std::max(error[i], at[i]);
    }
    for (std::size_t i = 0; i < error.size(); ++i) {
        const bool in_test = is_finite(test.pixels[i]), in_reference = is_finite(reference.pixels[i]);
        if (!in_test || !in_reference) error[i] = in_test == in_reference ? 0.0f : 1.0f;
    }
    return error;
}

double mean_hdr_flip(const Image& test, const Image& reference) {
    const std::vector<float> error = hdr_flip(test, reference);
    return std::accumulate(error.begin(), error.end(), 0.0) / static_cast<double>(error.size());
}

}  // namespace neumann
