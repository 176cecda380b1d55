#include "apps/pages/packed_pictures.h"

#include "operators/statistics/reduced_picture.h"
#include "operators/statistics/student_t.h"

#include <Imath/half.h>
#include <fmt/format.h>
#include <libdeflate.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <stdexcept>

namespace neumann {

namespace {

constexpr double finest_step = 1.0 / 12.0;
constexpr int largest_code = 254, unknown = 255;

// Calls what(i, c) for every pixel and channel.
template <typename Function>
void for_values(const Image& image, const Function& what) {
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, image.pixels.size(), 4096), [&](const auto& range) {
        for (std::size_t i = range.begin(); i < range.end(); ++i)
            for (int c = 0; c < 3; ++c) what(i, c);
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

void add_halves(const Image& mean, int exponent, std::string& bytes) {
    const std::size_t n = mean.pixels.size(), start = bytes.size();
    bytes.resize(start + 6 * n);
    // In two steps, since a single power of two may be beyond the range of double.
    const double half_scale = std::ldexp(1.0, -exponent / 2), scale = std::ldexp(1.0, -exponent - -exponent / 2);
    for_values(mean, [&](std::size_t i, int c) {
        const std::uint16_t half = Imath::half(static_cast<float>(mean.pixels[i][c] * half_scale * scale)).bits();
        const std::size_t at = start + static_cast<std::size_t>(c) * n + i;
        bytes[at] = static_cast<char>(half >> 8);
        bytes[at + 3 * n] = static_cast<char>(half & 0xff);
    });
}

void add_errors(const char* kind, const Image& errors, PackedPicture& picture) {
    if (errors.pixels.empty()) return;
    double least = std::numeric_limits<double>::infinity(), most = 0.0;
    for (const Rgb& p : errors.pixels)
        for (int c = 0; c < 3; ++c) {
            if (!(p[c] > 0.0) || !std::isfinite(p[c])) continue;
            least = std::min(least, p[c]);
            most = std::max(most, p[c]);
        }
    if (most == 0.0) least = most = 1.0;
    const double low = std::log2(least), step = std::max(finest_step, (std::log2(most) - low) / (largest_code - 1));
    picture.head["errors"].push_back({{"kind", kind}, {"low", low}, {"step", step}});

    const std::size_t n = errors.pixels.size(), start = picture.bytes.size();
    picture.bytes.resize(start + 3 * n);
    for_values(errors, [&](std::size_t i, int c) {
        const double error = errors.pixels[i][c];
        const int code = error == 0.0            ? 0
                         : !std::isfinite(error) ? unknown
                                                 : 1 + static_cast<int>(std::lround((std::log2(error) - low) / step));
        picture.bytes[start + static_cast<std::size_t>(c) * n + i] = static_cast<char>(code);
    });
}

// zlib format (RFC 1950). Most bits are noise, in which there is little to find: the first level makes 0.54 of them, the sixth 0.52
// in nearly twice the time, and zlib 0.53 in four times the time.
std::string deflated(const std::string& bytes) {
    constexpr int level = 1;
    const std::unique_ptr<libdeflate_compressor, decltype(&libdeflate_free_compressor)> compressor(
        libdeflate_alloc_compressor(level), libdeflate_free_compressor);
    if (!compressor) throw std::bad_alloc();
    std::string out(libdeflate_zlib_compress_bound(compressor.get(), bytes.size()), '\0');
    out.resize(libdeflate_zlib_compress(compressor.get(), bytes.data(), bytes.size(), out.data(), out.size()));
    if (out.empty()) throw std::logic_error("deflated: libdeflate did not finish");
    return out;
}

// Base 64 (RFC 4648). Boost's encoders are an implementation detail of Beast, or iterators of Serialization that do not pad.
std::string base64(const std::string& bytes) {
    constexpr char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string out((bytes.size() + 2) / 3 * 4, '=');
    char* to = out.data();
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        const auto byte = [&](std::size_t k) { return i + k < bytes.size() ? static_cast<std::uint8_t>(bytes[i + k]) : 0u; };
        const std::uint32_t three = byte(0) << 16 | byte(1) << 8 | byte(2);
        for (const unsigned shift : {18u, 12u, 6u, 0u}) *to++ = digits[(three >> shift) & 63u];
    }
    std::fill_n(out.rbegin(), (3 - bytes.size() % 3) % 3, '=');
    return out;
}

}  // namespace

PackedSeries::PackedSeries(int width, int height, std::size_t pictures, std::size_t on_page)
    : full_width_(width), full_height_(height), pictures_(pictures) {
    const auto pixels = [&] {
        return static_cast<std::size_t>(this->width()) * static_cast<std::size_t>(this->height()) * on_page;
    };
    while (pixels() > page_pixels && factor_ < std::max(width, height)) ++factor_;
}

void PackedSeries::add_term(std::size_t i, const PixelEstimate& term) {
    PackedPicture& picture = pictures_.at(i);
    const auto add = [&](const PixelEstimate& e) {
        const int exponent = exponent_of(e.mean);
        picture.head = {{"exponent", exponent}, {"errors", nlohmann::ordered_json::array()}};
        add_halves(e.mean, exponent, picture.bytes);
        add_errors("term", e.pixel_errors(), picture);
        add_errors("term_discretisation", e.discretisation, picture);
    };
    factor_ == 1 ? add(term) : add(reduced(term, factor_));
    if (i != 0) return;
    degrees_of_freedom_ = term.degrees_of_freedom;
    independent_ = term.pixels_are_independent;
}

void PackedSeries::add_sum(std::size_t i, const PixelEstimate& sum) {
    const auto add = [&](const PixelEstimate& e) {
        add_errors("sum", e.pixel_errors(), pictures_.at(i));
        add_errors("sum_discretisation", e.discretisation, pictures_.at(i));
    };
    factor_ == 1 ? add(sum) : add(reduced(sum, factor_));
}

void PackedSeries::pack(std::size_t i) { pictures_.at(i).bytes = base64(deflated(pictures_.at(i).bytes)); }

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
        "to open (above about 100 MB)",
        factor_, width(), height(), full_width_, full_height_);
}

}  // namespace neumann
