#include "core/reader/formats/pbrt/octahedral.h"

#include "core/image/display.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace neumann::reader::pbrt {

using std::numbers::pi;

// In the octant of positive numbers r = √(1 − z) is the distance from the middle, added up over both axes. Its part
// along y is the angle around z as a fraction of 90°.
Vec2 square_of_direction(const Vec3& w) {
    const Vec3 a = glm::abs(w);
    const double r = std::sqrt(std::max(1.0 - a.z, 0.0)), turn = std::atan2(a.y, a.x) * (2.0 / pi);
    Vec2 p(r * (1.0 - turn), r * turn);
    if (w.z < 0.0) p = Vec2(1.0 - p.y, 1.0 - p.x);
    return 0.5 + 0.5 * Vec2(std::copysign(p.x, w.x), std::copysign(p.y, w.y));
}

Vec3 direction_of_square(const Vec2& p) {
    const Vec2 q = 2.0 * p - 1.0, a = glm::abs(q);
    const double above = 1.0 - a.x - a.y, r = 1.0 - std::abs(above);
    const double turn = (r > 0.0 ? (a.y - a.x) / r + 1.0 : 1.0) * (pi / 4.0);
    const double out = r * std::sqrt(2.0 - r * r);
    return {std::copysign(std::cos(turn) * out, q.x), std::copysign(std::sin(turn) * out, q.y), std::copysign(1.0 - r * r, above)};
}

Mat4 from_envmap() {
    Mat4 m(0.0);
    m[0] = {1.0, 0.0, 0.0, 0.0};
    m[1] = {0.0, 0.0, 1.0, 0.0};
    m[2] = {0.0, -1.0, 0.0, 0.0};
    m[3][3] = 1.0;
    return m;
}

std::shared_ptr<const Texels> to_latitude_longitude(const Picture& square, Importer& importer) {
    std::vector<Rgb> from;
    for_each_texel(square, importer, [&](const Rgb& c) { from.push_back(c); });
    const auto size = static_cast<int>(std::lround(std::sqrt(static_cast<double>(from.size()))));
    auto result = std::make_shared<Texels>();
    result->width = std::max(2 * size, 4);
    result->height = std::max(size, 2) + 1;  // both poles have a row
    result->channels = 3;
    const auto at = [&](double phi, double theta) {
        const Vec3 local(std::sin(theta) * std::sin(phi), std::cos(theta), -std::sin(theta) * std::cos(phi));
        const Vec2 p = square_of_direction(Vec3(from_envmap() * glm::dvec4(local, 0.0))) * static_cast<double>(size);
        const auto x = static_cast<std::size_t>(std::clamp(static_cast<int>(p.x), 0, size - 1)),
                   y = static_cast<std::size_t>(std::clamp(static_cast<int>(p.y), 0, size - 1));
        return from[y * static_cast<std::size_t>(size) + x];
    };
    // A pixel is the mean over its place.
    constexpr int parts = 4;
    for (int row = 0; row < result->height; ++row)
        for (int column = 0; column < result->width; ++column) {
            Rgb sum(0.0);
            double weight = 0.0;
            for (int i = 0; i < parts; ++i) {
                const double theta = (row + (i + 0.5) / parts - 0.5) * pi / (result->height - 1);
                if (theta < 0.0 || theta > pi) continue;
                for (int j = 0; j < parts; ++j) {
                    sum += std::sin(theta) * at((column + (j + 0.5) / parts) * 2.0 * pi / result->width, theta);
                    weight += std::sin(theta);
                }
            }
            for (int c = 0; c < 3; ++c) result->values.push_back(static_cast<float>(sum[c] / weight));
        }
    return result;
}

double illuminance_of(const Picture& square, Importer& importer) {
    std::vector<double> luminances;
    for_each_texel(square, importer, [&](const Rgb& c) { luminances.push_back(luminance(c)); });
    const auto size = static_cast<std::size_t>(std::lround(std::sqrt(static_cast<double>(luminances.size()))));
    double sum = 0.0;
    for (std::size_t i = 0; i < size * size; ++i) {
        const Vec2 p = (Vec2(static_cast<double>(i % size), static_cast<double>(i / size)) + 0.5) / static_cast<double>(size);
        sum += luminances[i] * std::max(direction_of_square(p).z, 0.0);
    }
    return sum * 2.0 * pi / static_cast<double>(size * size);
}

}  // namespace neumann::reader::pbrt
