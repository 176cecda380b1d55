#include "operators/experiments/blame/picture_mistakes.h"

#include "core/base/vec.h"
#include "core/sampling/warp.h"
#include "operators/experiments/blame/joined_pixels.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <numeric>

namespace neumann {

namespace {

const Rgb& at_edge(const Image& image, int x, int y) {
    return image.at(std::clamp(x, 0, image.width - 1), std::clamp(y, 0, image.height - 1));
}

template <class F>
Image made(const Image& like, const F& pixel) {
    Image result(like.width, like.height);
    for (int y = 0; y < like.height; ++y)
        for (int x = 0; x < like.width; ++x) result.at(x, y) = pixel(x, y);
    return result;
}

Image flipped(const Image& image, bool across, bool down) {
    return made(image, [&](int x, int y) { return image.at(across ? image.width - 1 - x : x, down ? image.height - 1 - y : y); });
}

// A weighted sum of pixels acts on means with the weights, and on variances with their squares.
enum class Quantity { means, variances };
double weight(double w, Quantity quantity) { return quantity == Quantity::means ? w : w * w; }

// Content moves by (dx, dy) pixels; bilinear between pixels.
Image shifted(const Image& image, double dx, double dy, Quantity quantity) {
    return made(image, [&](int x, int y) {
        const double u = x - dx, v = y - dy, i = std::floor(u), j = std::floor(v);
        const double right = weight(u - i, quantity), left = weight(1.0 - (u - i), quantity), low = weight(v - j, quantity),
                     top = weight(1.0 - (v - j), quantity);
        const int l = static_cast<int>(i), t = static_cast<int>(j);
        return (at_edge(image, l, t) * left + at_edge(image, l + 1, t) * right) * top +
               (at_edge(image, l, t + 1) * left + at_edge(image, l + 1, t + 1) * right) * low;
    });
}

// A Gaussian of this standard deviation, in pixels.
Image blurred(const Image& image, double sigma, Quantity quantity) {
    const int reach = static_cast<int>(std::ceil(3.0 * sigma));
    std::vector<double> weights;
    double sum = 0.0;
    for (int i = -reach; i <= reach; ++i) weights.push_back(std::exp(-0.5 * i * i / (sigma * sigma)));
    for (const double w : weights) sum += w;
    for (double& w : weights) w = weight(w / sum, quantity);
    const auto pass = [&](const Image& from, int across, int down) {
        return made(from, [&](int x, int y) {
            Rgb mean(0.0);
            for (int i = -reach; i <= reach; ++i)
                mean += at_edge(from, x + i * across, y + i * down) * weights[static_cast<std::size_t>(i + reach)];
            return mean;
        });
    };
    return pass(pass(image, 1, 0), 0, 1);
}

double to_srgb(double v) { return v <= 0.0031308 ? 12.92 * v : 1.055 * std::pow(v, 1.0 / 2.4) - 0.055; }
double from_srgb(double v) { return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4); }

// Applies a function of pictures to the terms: to sums, whose differences are taken, or to the terms themselves.
class Terms {
public:
    Terms(const std::vector<ComparedTerm>& terms, bool are_sums, int factor)
        : terms_(terms), are_sums_(are_sums), factor_(factor) {}

    WrongPictures linear(const std::string& name, const std::string& words,
                         const std::function<Image(const Image&, Quantity)>& f) const {
        WrongPictures wrong{name, words, {}};
        for (const ComparedTerm& t : terms_)
            wrong.terms.push_back(
                joined(PictureNoise{f(t.ours.mean, Quantity::means), f(t.ours.variance, Quantity::variances)}, factor_));
        return wrong;
    }
    WrongPictures smoothed(const std::string& name, const std::string& words,
                           const std::function<Image(const Image&, Quantity)>& f) const {
        WrongPictures wrong = linear(name, words, f);
        wrong.is_smoothed = true;
        return wrong;
    }
    WrongPictures encoded(const std::string& name, const std::string& words, const std::function<double(double)>& f) const {
        const auto all = [&](const Image& image) {
            return made(image, [&](int x, int y) {
                const Rgb& c = image.at(x, y);
                return Rgb(f(c.r), f(c.g), f(c.b));
            });
        };
        WrongPictures wrong{name, words, {}};
        for (const ComparedTerm& t : terms_) {
            const Image &base = are_sums_ ? t.our_sum : t.ours.mean, before = all(t.our_sum_before);
            Image mean = all(base);
            if (are_sums_)
                for (std::size_t i = 0; i < mean.pixels.size(); ++i) mean.pixels[i] -= before.pixels[i];
            // The variance is propagated by the slope of f.
            Image variance = made(base, [&](int x, int y) {
                Rgb v(0.0);
                for (int c = 0; c < 3; ++c) {
                    const double value = base.at(x, y)[c], step = 1e-3 * std::max(value, 1e-3),
                                 slope = (f(value + step) - f(value)) / step;
                    v[c] = t.ours.variance.at(x, y)[c] * slope * slope;
                }
                return v;
            });
            wrong.terms.push_back(joined(PictureNoise{std::move(mean), std::move(variance)}, factor_));
        }
        return wrong;
    }

private:
    const std::vector<ComparedTerm>& terms_;
    bool are_sums_;
    int factor_;
};

// Weighted least squares in which outliers weigh less, from the ratio of the sums on. `pixels`: those that count.
double fitted_factor(const PictureNoise& theirs, const PictureNoise& ours, const std::vector<std::size_t>& pixels) {
    double sum_theirs = 0.0, sum_ours = 0.0;
    for (const std::size_t i : pixels) {
        sum_theirs += mean_component(theirs.mean.pixels[i]);
        sum_ours += mean_component(ours.mean.pixels[i]);
    }
    double factor = sum_theirs > 0.0 && sum_ours > 0.0 ? sum_theirs / sum_ours : 1.0;
    for (int step = 0; step < 10; ++step) {
        double top = 0.0, bottom = 0.0;
        for (const std::size_t i : pixels)
            for (int c = 0; c < 3; ++c) {
                const double a = theirs.mean.pixels[i][c], b = ours.mean.pixels[i][c],
                             v = theirs.variance.pixels[i][c] + factor * factor * ours.variance.pixels[i][c] + 1e-8 * b * b +
                                 1e-300,
                             d = a - factor * b, weight = 1.0 / (v * (1.0 + d * d / (4.0 * v)));
                top += weight * a * b;
                bottom += weight * b * b;
            }
        if (bottom > 0.0) factor = 0.5 * (factor + top / bottom);
    }
    return factor;
}

std::vector<std::size_t> all_pixels(const Image& image) {
    std::vector<std::size_t> pixels(image.pixels.size());
    std::iota(pixels.begin(), pixels.end(), std::size_t{0});
    return pixels;
}

PictureNoise scaled(const PictureNoise& p, const std::function<double(std::size_t)>& factor) {
    PictureNoise result = p;
    for (std::size_t i = 0; i < result.mean.pixels.size(); ++i) {
        result.mean.pixels[i] *= factor(i);
        result.variance.pixels[i] *= factor(i) * factor(i);
    }
    return result;
}

PictureNoise scaled_evenly(const PictureNoise& p, double factor) {
    return scaled(p, [=](std::size_t) { return factor; });
}

// "2", "π", "1/2": a factor that people forget or add.
std::string factor_text(double factor) {
    struct Known {
        double value;
        const char* text;
    };
    constexpr Known known[] = {{pi, "π"},        {inv_pi, "1/π"},
                               {2.0, "2"},       {0.5, "1/2"},
                               {4.0, "4"},       {0.25, "1/4"},
                               {2.0 * pi, "2π"}, {0.5 * inv_pi, "1/(2π)"},
                               {4.0 * pi, "4π"}, {0.25 * inv_pi, "1/(4π)"},
                               {pi * pi, "π²"}};
    for (const Known& k : known)
        if (std::abs(factor / k.value - 1.0) < 0.02) return fmt::format("{:.4g}, which is {}", factor, k.text);
    return fmt::format("{:.4g}", factor);
}

void add_factors(std::vector<WrongPictures>& all, const std::vector<ComparedTerm>& terms,
                 const std::vector<std::uint32_t>& shapes) {
    std::map<std::uint32_t, std::vector<std::size_t>> by_shape;
    for (std::size_t i = 0; i < shapes.size(); ++i) by_shape[shapes[i]].push_back(i);
    WrongPictures everywhere{"factor", "", {}}, different{"factor_by_shape", "a factor that differs from shape to shape", {}};
    different.is_a_cause = false;
    for (const ComparedTerm& t : terms) {
        constexpr double more_than_luck = 0.2;
        const double factor = fitted_factor(t.theirs, t.ours, all_pixels(t.ours.mean));
        if (everywhere.terms.empty()) everywhere.is_a_cause = std::abs(factor - 1.0) > more_than_luck;
        everywhere.words += fmt::format("{}{} is multiplied by {}", everywhere.words.empty() ? "" : ", ", to_string(t.bounces),
                                        factor_text(factor));
        everywhere.terms.push_back(scaled_evenly(t.ours, factor));
        ++everywhere.parameters;
        std::vector<double> factors(shapes.size(), 1.0);
        for (const auto& [shape, its] : by_shape) {
            const double f = fitted_factor(t.theirs, t.ours, its);
            for (const std::size_t i : its) factors[i] = f;
            ++different.parameters;
        }
        different.terms.push_back(scaled(t.ours, [&](std::size_t i) { return factors[i]; }));
    }
    all.push_back(std::move(everywhere));
    all.push_back(std::move(different));
}

// The same light too much or too little in every pixel: the median over the pixels.
void add_offset(std::vector<WrongPictures>& all, const std::vector<ComparedTerm>& terms) {
    WrongPictures wrong{"offset", "", {}};
    wrong.is_a_cause = false;
    for (const ComparedTerm& t : terms) {
        Rgb offset(0.0);
        for (int c = 0; c < 3; ++c) {
            std::vector<double> differences;
            for (std::size_t i = 0; i < t.ours.mean.pixels.size(); ++i)
                differences.push_back(t.theirs.mean.pixels[i][c] - t.ours.mean.pixels[i][c]);
            std::nth_element(differences.begin(), differences.begin() + static_cast<std::ptrdiff_t>(differences.size() / 2),
                             differences.end());
            offset[c] = differences[differences.size() / 2];
        }
        PictureNoise moved = t.ours;
        for (Rgb& c : moved.mean.pixels) c += offset;
        wrong.terms.push_back(std::move(moved));
        wrong.words += fmt::format("{}{} has {:.3g}, {:.3g}, {:.3g} more in every pixel", wrong.words.empty() ? "" : ", ",
                                   to_string(t.bounces), offset.r, offset.g, offset.b);
        wrong.parameters += 3;
    }
    all.push_back(std::move(wrong));
}

}  // namespace

double fitted_factor(const PictureNoise& theirs, const PictureNoise& ours) {
    return fitted_factor(theirs, ours, all_pixels(ours.mean));
}

PictureNoise scaled(const PictureNoise& picture, double factor) { return scaled_evenly(picture, factor); }

std::vector<WrongPictures> moved_pictures(const std::vector<ComparedTerm>& terms, bool are_sums, int factor) {
    const Terms mistakes(terms, are_sums, factor);
    std::vector<WrongPictures> all;
    all.push_back(mistakes.linear("flipped_x", "the picture is mirrored left to right",
                                  [](const Image& p, Quantity) { return flipped(p, true, false); }));
    all.push_back(mistakes.linear("flipped_y", "the picture stands on its head",
                                  [](const Image& p, Quantity) { return flipped(p, false, true); }));
    all.push_back(mistakes.linear("turned", "the picture is turned by 180°",
                                  [](const Image& p, Quantity) { return flipped(p, true, true); }));
    for (const double dx : {-1.0, -0.5, 0.0, 0.5, 1.0})
        for (const double dy : {-1.0, -0.5, 0.0, 0.5, 1.0})
            if (dx != 0.0 || dy != 0.0)
                all.push_back(mistakes.smoothed(
                    "shifted", fmt::format("the picture is shifted by {:g} pixels to the right and {:g} down", dx, dy),
                    [=](const Image& p, Quantity what) { return shifted(p, dx, dy, what); }));
    for (const double sigma : {0.35, 0.5, 0.7, 1.0})
        all.push_back(mistakes.smoothed("blurred",
                                        fmt::format("the pixel filter is wider, by a Gaussian of about {:g} pixels", sigma),
                                        [=](const Image& p, Quantity what) { return blurred(p, sigma, what); }));
    all.push_back(mistakes.encoded("encoded", "the pictures are encoded as sRGB, not linear", to_srgb));
    all.push_back(mistakes.encoded("encoded", "the pictures are encoded by a gamma of 2.2, not linear",
                                   [](double v) { return std::pow(std::max(v, 0.0), 1.0 / 2.2); }));
    all.push_back(mistakes.encoded("encoded", "the pictures are decoded from sRGB although they were linear", from_srgb));
    all.push_back(mistakes.encoded("cut_off", "values above 1 are cut off", [](double v) { return std::min(v, 1.0); }));
    return all;
}

std::vector<WrongPictures> scaled_pictures(const std::vector<ComparedTerm>& terms, const std::vector<std::uint32_t>& shapes) {
    std::vector<WrongPictures> all;
    WrongPictures black{"missing", "there is no light at all", {}};
    for (const ComparedTerm& t : terms)
        black.terms.push_back({Image(t.ours.mean.width, t.ours.mean.height), Image(t.ours.mean.width, t.ours.mean.height)});
    all.push_back(std::move(black));
    add_factors(all, terms, shapes);
    add_offset(all, terms);
    return all;
}

}  // namespace neumann
