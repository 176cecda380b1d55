#include "operators/fields/patches/parts.h"

#include <algorithm>

namespace neumann {

namespace {

constexpr std::uint32_t squares_along = 16, squares_along_with_bands = 32;

Vec2 in_squares(const Part& part, const Vec2& u) {
    const double place = u.x * static_cast<double>(part.squares.size());
    const std::size_t i = std::min(static_cast<std::size_t>(place), part.squares.size() - 1);
    return Vec2(part.squares[i] % part.along + (place - static_cast<double>(i)), part.squares[i] / part.along + u.y) /
           static_cast<double>(part.along);
}

}  // namespace

SurfacePoint Part::point(const Geometry& geometry, const Chart& chart, const Footprints& footprints, const Cell& cell,
                         Region region, Vec2 u) const {
    // A square may contain other parts, too. If the point is in another part, the next point of Roberts' R2 sequence is tried.
    constexpr int tries = 256;
    SurfacePoint p;
    for (int i = 0; i < tries; ++i) {
        const Vec2 st = chart.uniform(cell, in_squares(*this, u));
        p = chart.point(geometry, st);
        if (footprints.region(st, p.position) == region) break;
        u = glm::fract(u + Vec2(0.7548776662466927, 0.5698402909980532));
    }
    return p;
}

Parts find_parts(const Geometry& geometry, const Chart& chart, const Footprints& footprints, const Cell& cell) {
    const auto corner = [&](double s, double t) { return chart.point(geometry, {s, t}).position; };
    const Vec3 middle = corner(0.5 * (cell.s0 + cell.s1), 0.5 * (cell.t0 + cell.t1));
    const double radius =
        std::max({glm::distance(middle, corner(cell.s0, cell.t0)), glm::distance(middle, corner(cell.s1, cell.t0)),
                  glm::distance(middle, corner(cell.s0, cell.t1)), glm::distance(middle, corner(cell.s1, cell.t1))});
    const bool bands = footprints.has_bands(middle, radius);
    if (!bands && !footprints.divides(cell))
        return {{footprints.region({0.5 * (cell.s0 + cell.s1), 0.5 * (cell.t0 + cell.t1)}, middle), Part()}};
    const std::uint32_t along = bands ? squares_along_with_bands : squares_along;
    struct GridPoint {
        Vec2 st;
        Vec3 position;
        Region region;
    };
    std::vector<GridPoint> corners;
    for (std::uint32_t y = 0; y <= along; ++y)
        for (std::uint32_t x = 0; x <= along; ++x) {
            const Vec2 st = chart.uniform(cell, Vec2(x, y) / double(along));
            const Vec3 position = chart.point(geometry, st).position;
            corners.push_back({st, position, footprints.region(st, position)});
        }

    Parts parts;
    for (std::uint32_t y = 0; y < along; ++y)
        for (std::uint32_t x = 0; x < along; ++x) {
            const GridPoint *low = &corners[y * (along + 1) + x], *high = low + along + 1;
            const auto region = [&](double u, double v) {
                const double w[4] = {(1.0 - u) * (1.0 - v), u * (1.0 - v), (1.0 - u) * v, u * v};
                return footprints.region(
                    w[0] * low[0].st + w[1] * low[1].st + w[2] * high[0].st + w[3] * high[1].st,
                    w[0] * low[0].position + w[1] * low[1].position + w[2] * high[0].position + w[3] * high[1].position);
            };
            constexpr std::uint32_t points = 4;
            std::vector<std::pair<Region, std::uint32_t>> counts;
            const Region centre = region(0.5, 0.5);
            if (low[0].region == centre && low[1].region == centre && high[0].region == centre && high[1].region == centre) {
                counts.emplace_back(centre, points * points);
            } else {
                for (std::uint32_t i = 0; i < points * points; ++i) {
                    const Region found = region((i % points + 0.5) / points, (i / points + 0.5) / points);
                    const auto known = std::find_if(counts.begin(), counts.end(), [&](const auto& c) { return c.first == found; });
                    if (known == counts.end())
                        counts.emplace_back(found, 1);
                    else
                        ++known->second;
                }
            }
            for (const auto& [found, count] : counts) {
                Part& part = parts[found];
                part.along = along;
                part.share += static_cast<double>(count) / (points * points * along * along);
                part.squares.push_back(static_cast<std::uint16_t>(y * along + x));
            }
        }
    return parts;
}

}  // namespace neumann
