#include "apps/output/files/packed_pictures.h"

#include "apps/output/files/packed_bytes.h"
#include "operators/statistics/reduced_picture.h"
#include "operators/statistics/student_t.h"

#include <Imath/half.h>
#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <memory>
#include <stdexcept>

namespace neumann {

namespace {

constexpr double finest_step = 1.0 / 6.0;
constexpr int largest_code = 254, unknown = 255;
constexpr std::size_t discretisation_block = 4;

template <typename Function>
void for_pixels(std::size_t pixels, const Function& what) {
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, pixels, 4096), [&](const auto& range) {
        for (std::size_t i = range.begin(); i < range.end(); ++i) what(i);
    });
}

// The exponent of the power of two that scales the largest value into the range of half floats, which ends at 2¹⁶.
int exponent_of(const Image& mean) {
    double largest = 0.0;
    for (const Rgb& p : mean.pixels)
        for (int c = 0; c < 3; ++c)
            if (std::isfinite(p[c])) largest = std::max(largest, std::abs(p[c]));
    return largest > 0.0 ? std::ilogb(largest) - 14 : 0;
}

// ⌊log2 x⌋ of a normal number.
int exponent_bits(double x) { return static_cast<int>(std::bit_cast<std::uint64_t>(x) >> 52 & 2047) - 1023; }

// A half, times 2^exponent, rounded to a multiple of the largest power of two that is at most 1/8 of its error, or of
// its own first bit if that is less.
std::uint16_t without_noise(std::uint16_t half, int exponent, double error) {
    constexpr int kept_of_error = 3, fraction_bits = 10, largest_exponent = 31;
    const int own = half >> fraction_bits & largest_exponent;
    if (!(error > 0.0) || !std::isfinite(error) || own == largest_exponent) return half;
    const int last_bit = std::max(own, 1) - 25 + exponent;
    const int drop = std::clamp(exponent_bits(error) - kept_of_error - last_bit, 0, fraction_bits);
    if (drop == 0) return half;
    const auto rounded = static_cast<std::uint16_t>(((half + (1 << (drop - 1))) >> drop) << drop);
    return (rounded & 0x7fff) != 0 ? rounded : half;
}

// The errors of pixels: their noise and their discretisation.
Image errors_of_means(const Image& noise, const Image& discretisation) {
    if (discretisation.pixels.empty()) return noise;
    Image errors = discretisation;
    for_pixels(noise.pixels.size(), [&](std::size_t i) {
        for (int c = 0; c < 3; ++c) errors.pixels[i][c] = std::hypot(noise.pixels[i][c], errors.pixels[i][c]);
    });
    return errors;
}

// `errors` may be empty.
void add_halves(const Image& mean, const Image& errors, int exponent, std::string& bytes) {
    const std::size_t n = mean.pixels.size(), start = bytes.size();
    bytes.resize(start + 6 * n);
    // The scale is applied in two steps, because a single power of two may be beyond the range of double.
    const double half_scale = std::ldexp(1.0, -exponent / 2), scale = std::ldexp(1.0, -exponent - -exponent / 2);
    for_pixels(n, [&](std::size_t i) {
        std::uint16_t red = 0;
        for (int c = 0; c < 3; ++c) {
            std::uint16_t half = Imath::half(static_cast<float>(mean.pixels[i][c] * half_scale * scale)).bits();
            if (!errors.pixels.empty()) half = without_noise(half, exponent, errors.pixels[i][c]);
            const auto kept = static_cast<std::uint16_t>(half - red);
            if (c == 0) red = half;
            const std::size_t at = start + static_cast<std::size_t>(c) * n + i;
            bytes[at] = static_cast<char>(kept >> 8);
            bytes[at + 3 * n] = static_cast<char>(kept & 0xff);
        }
    });
}

float log2_of(double x) {
    int exponent = 0;
    const auto part = static_cast<float>(std::frexp(x, &exponent));
    return std::log2(part) + static_cast<float>(exponent);
}

// The logarithms, channel by channel: −∞ for no error, ∞ for an unknown one.
std::vector<float> logarithms(const Image& errors) {
    const std::size_t n = errors.pixels.size();
    std::vector<float> logs(3 * n);
    for_pixels(n, [&](std::size_t i) {
        for (int c = 0; c < 3; ++c) {
            const double e = errors.pixels[i][c];
            constexpr float infinity = std::numeric_limits<float>::infinity();
            logs[static_cast<std::size_t>(c) * n + i] = e == 0.0 ? -infinity : std::isfinite(e) ? log2_of(e) : infinity;
        }
    });
    return logs;
}

// The worst pixel and channel of each block.
std::vector<float> largest_of_blocks(const std::vector<float>& logs, std::size_t width, std::size_t height) {
    constexpr std::size_t side = discretisation_block;
    const std::size_t across = (width + side - 1) / side, down = (height + side - 1) / side;
    std::vector<float> largest(across * down, -std::numeric_limits<float>::infinity());
    for (std::size_t k = 0; k < logs.size(); ++k) {
        const std::size_t x = k % width, y = k / width % height;
        float& of_block = largest[y / side * across + x / side];
        of_block = std::max(of_block, logs[k]);
    }
    return largest;
}

// The scale of the codes 1 to 254.
class LogScale {
public:
    explicit LogScale(const std::vector<float>& logs) {
        float least = std::numeric_limits<float>::infinity(), most = -least;
        for (const float v : logs) {
            if (!std::isfinite(v)) continue;
            least = std::min(least, v);
            most = std::max(most, v);
        }
        if (least > most) return;
        step_ = std::max(finest_step, (static_cast<double>(most) - least) / (largest_code - 2));
        low_ = std::floor(least / step_) * step_;  // so that pictures of one step have the same grid, and their codes differ little
    }
    double low() const { return low_; }
    double step() const { return step_; }
    std::vector<std::uint8_t> codes(const std::vector<float>& logs) const {
        std::vector<std::uint8_t> result(logs.size());
        const auto first = static_cast<float>(low_), per_step = static_cast<float>(1.0 / step_);
        for_pixels(logs.size(), [&](std::size_t k) {
            const float v = logs[k];
            const int code = std::isfinite(v) ? 1 + static_cast<int>((v - first) * per_step + 0.5f) : v < 0.0f ? 0 : unknown;
            result[k] = static_cast<std::uint8_t>(code);
        });
        return result;
    }

private:
    double low_ = 0.0, step_ = finest_step;
};

// `before`: the codes that are subtracted, or null.
void add_codes(const std::vector<std::uint8_t>& codes, const std::vector<std::uint8_t>* before, std::size_t n, std::string& bytes) {
    const std::size_t start = bytes.size();
    bytes.resize(start + codes.size());
    for_pixels(n, [&](std::size_t i) {
        const auto kept = [&](std::size_t at) { return codes[at] - (before ? (*before)[at] : 0); };
        for (std::size_t at = i; at < codes.size(); at += n)
            bytes[start + at] = static_cast<char>(at == i ? kept(i) : kept(at) - kept(i));
    });
}

}  // namespace

PackedSeries::PackedSeries(int width, int height, std::size_t pictures, std::size_t on_page)
    : full_width_(width), full_height_(height), pictures_(pictures), codes_(pictures) {
    const auto pixels = [&] {
        return static_cast<std::size_t>(this->width()) * static_cast<std::size_t>(this->height()) * on_page;
    };
    while (pixels() > page_pixels && factor_ < std::max(width, height)) ++factor_;
}

void PackedSeries::add_errors(std::size_t i, const char* kind, const Image& errors) {
    if (errors.pixels.empty()) return;
    const bool is_discretisation = std::string_view(kind).ends_with("discretisation");
    std::vector<float> logs = logarithms(errors);
    if (is_discretisation) logs = largest_of_blocks(logs, static_cast<std::size_t>(width()), static_cast<std::size_t>(height()));
    const LogScale scale(logs);
    pictures_[i].head["errors"].push_back({{"kind", kind},
                                           {"channels", is_discretisation ? 1 : 3},
                                           {"block", is_discretisation ? discretisation_block : 1},
                                           {"codes", logs.size()},
                                           {"low", scale.low()},
                                           {"step", scale.step()}});
    codes_[i][kind] = scale.codes(logs);
}

void PackedSeries::add_term(std::size_t i, const PixelEstimate& term) {
    PackedPicture& picture = pictures_.at(i);
    const auto add = [&](const PixelEstimate& e) {
        const int exponent = exponent_of(e.mean);
        const Image errors = e.pixel_errors();
        picture.head = {{"exponent", exponent}, {"errors", nlohmann::ordered_json::array()}};
        add_halves(e.mean, errors_of_means(errors, e.discretisation), exponent, picture.bytes);
        add_errors(i, "term", errors);
        add_errors(i, "term_discretisation", e.discretisation);
    };
    factor_ == 1 ? add(term) : add(reduced(term, factor_));
    if (i != 0) return;
    degrees_of_freedom_ = term.degrees_of_freedom;
    independent_ = term.pixels_are_independent;
}

void PackedSeries::add_sum(std::size_t i, const PixelEstimate& sum) {
    const auto add = [&](const PixelEstimate& e) {
        add_errors(i, "sum", e.pixel_errors());
        add_errors(i, "sum_discretisation", e.discretisation);
    };
    factor_ == 1 ? add(sum) : add(reduced(sum, factor_));
}

void PackedSeries::pack() {
    tbb::parallel_for(std::size_t{0}, pictures_.size(), [&](std::size_t i) {
        PackedPicture& picture = pictures_[i];
        for (const auto& scale : picture.head["errors"]) {
            const auto kind = scale.at("kind").get<std::string>();
            const Codes* const before = i > 0 && codes_[i - 1].contains(kind) ? &codes_[i - 1].at(kind) : nullptr;
            const Codes& codes = codes_[i].at(kind);
            add_codes(codes, before, codes.size() / scale.at("channels").get<std::size_t>(), picture.bytes);
        }
        picture.bytes = packed_bytes(picture.bytes);
    });
    codes_.clear();
}

nlohmann::ordered_json PackedSeries::head() const {
    const double t = student_t_quantile(0.95, degrees_of_freedom_);
    return {{"width", width()},
            {"height", height()},
            {"factor", factor_},
            {"full_width", full_width_},
            {"full_height", full_height_},
            {"interval_factor", std::isfinite(t) ? nlohmann::ordered_json(t) : nlohmann::ordered_json(nullptr)},
            {"independent", independent_}};
}

std::string PackedSeries::reduction() const {
    return fmt::format(
        "index.html shows the pictures at 1/{} of their size, {}×{} in place of {}×{}: whole ones would make it too large "
        "to open (above about 75 MB)",
        factor_, width(), height(), full_width_, full_height_);
}

}  // namespace neumann
