#include "apps/pages/packed_pictures.h"

#include "operators/statistics/reduced_picture.h"
#include "operators/statistics/student_t.h"

#include <Imath/half.h>
#include <fmt/format.h>
#include <tbb/parallel_for.h>
#include <zlib.h>

#include <algorithm>
#include <cmath>
#include <limits>
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
    for_values(mean, [&](std::size_t i, int c) {
        const std::uint16_t half = Imath::half(static_cast<float>(std::ldexp(mean.pixels[i][c], -exponent))).bits();
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

// zlib format (RFC 1950). Most bits are noise. Run-length matching finds the rest (black, unknown); it is four times as fast as a
// search for repeated strings, and compresses better.
std::string deflated(const std::string& bytes) {
    z_stream stream{};
    if (deflateInit2(&stream, 6, Z_DEFLATED, 15, 9, Z_RLE) != Z_OK) throw std::bad_alloc();
    std::string out(deflateBound(&stream, bytes.size()), '\0');
    stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data()));
    stream.avail_in = static_cast<uInt>(bytes.size());
    stream.next_out = reinterpret_cast<Bytef*>(out.data());
    stream.avail_out = static_cast<uInt>(out.size());
    const int verdict = deflate(&stream, Z_FINISH);
    out.resize(stream.total_out);
    deflateEnd(&stream);
    if (verdict != Z_STREAM_END) throw std::logic_error("deflated: zlib did not finish");
    return out;
}

// Base 64 (RFC 4648). Boost's encoders are an implementation detail of Beast, or iterators of Serialization that do not pad.
std::string base64(const std::string& bytes) {
    constexpr char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string out;
    out.reserve((bytes.size() + 2) / 3 * 4);
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        const auto byte = [&](std::size_t k) { return i + k < bytes.size() ? static_cast<std::uint8_t>(bytes[i + k]) : 0u; };
        const std::uint32_t three = byte(0) << 16 | byte(1) << 8 | byte(2);
        for (const int shift : {18, 12, 6, 0}) out += digits[(three >> shift) & 63u];
    }
    for (std::size_t k = 0; k < (3 - bytes.size() % 3) % 3; ++k) out[out.size() - 1 - k] = '=';
    return out;
}

}  // namespace

PackedSeries::PackedSeries(int width, int height, std::size_t pictures) : full_width_(width), full_height_(height) {
    const auto pixels = [&] {
        return static_cast<std::size_t>(this->width()) * static_cast<std::size_t>(this->height()) * pictures;
    };
    while (pixels() > page_pixels && factor_ < std::max(width, height)) ++factor_;
}

void PackedSeries::add(const PixelEstimate& term, const PixelEstimate* sum) {
    const auto small = [&](const PixelEstimate& e) { return reduced(e, factor_); };
    const PixelEstimate small_term = small(term);
    PackedPicture& picture = pictures_.emplace_back();
    const int exponent = exponent_of(small_term.mean);
    picture.head = {{"exponent", exponent}, {"errors", nlohmann::ordered_json::array()}};
    add_halves(small_term.mean, exponent, picture.bytes);
    add_errors("term", small_term.pixel_errors(), picture);
    add_errors("term_discretisation", small_term.discretisation, picture);
    if (sum != nullptr) {
        const PixelEstimate small_sum = small(*sum);
        add_errors("sum", small_sum.pixel_errors(), picture);
        add_errors("sum_discretisation", small_sum.discretisation, picture);
    }
    degrees_of_freedom_ = term.degrees_of_freedom;
    independent_ = term.pixels_are_independent;
}

void PackedSeries::pack() {
    tbb::parallel_for(std::size_t{0}, pictures_.size(),
                      [&](std::size_t i) { pictures_[i].bytes = base64(deflated(pictures_[i].bytes)); });
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
        "to open (above about 100 MB)",
        factor_, width(), height(), full_width_, full_height_);
}

}  // namespace neumann
