#include "operators/fields/patches/face_clusters.h"

#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/parallel_invoke.h>
#include <algorithm>
#include <array>
#include <cmath>

namespace neumann {

namespace {

// With this weight, normals that differ by a right angle count as much as places that are 1.5 √2 widths of a cluster apart.
constexpr double weight_of_normals = 1.5;
constexpr std::size_t faces_in_parallel = 8192, ordered_to = 4;
// Clusters are not smaller than this share of a mesh, so that their ends differ as doubles.
constexpr double least_share = 1e-9;

struct Item {
    std::array<float, 6> at;  // position in widths of a cluster, and weighted normal
    float area;
    std::uint32_t face;
};

struct Split {
    std::size_t below;  // number of items
    double share;       // their share of the area
};

// Moves the items whose widest coordinate is below its mean to the front.
Split split(std::span<Item> items) {
    std::array<double, 6> sum{}, squares{};
    double area = 0.0;
    for (const Item& item : items) {
        const double a = item.area;
        area += a;
        for (std::size_t i = 0; i < 6; ++i) {
            const double x = item.at[i];
            sum[i] += a * x;
            squares[i] += a * x * x;
        }
    }
    std::size_t widest = 0;
    double most = -1.0;
    for (std::size_t i = 0; i < 6; ++i) {
        const double spread = squares[i] - sum[i] * sum[i] / area;
        if (spread > most) {
            most = spread;
            widest = i;
        }
    }
    const double mean = sum[widest] / area;
    const auto middle = std::partition(items.begin(), items.end(), [&](const Item& item) { return item.at[widest] < mean; });
    auto below = static_cast<std::size_t>(middle - items.begin());
    if (below == 0 || below == items.size()) below = items.size() / 2;  // they are all in one place
    double before = 0.0;
    for (const Item& item : items.first(below)) before += item.area;
    return {below, before / area};
}

// The number of the n clusters that are made of the first s.below of `all` items. Groups that coarser patches join stay together.
std::size_t clusters_below(std::size_t n, const Split& s, std::size_t all) {
    constexpr std::size_t group = FaceClusters::joined;
    const std::size_t unit = n >= 2 * group ? group : 1;
    const auto wanted = static_cast<std::size_t>(std::lround(s.share * static_cast<double>(n) / static_cast<double>(unit))) * unit;
    const std::size_t least = std::max(n > all - s.below ? n - (all - s.below) : 0, unit), most = std::min(s.below, n - unit);
    return least > most ? std::min(std::max(wanted, least), s.below) : std::clamp(wanted, least, most);
}

// The inverse of uniform_triangle().
Vec2 square_of_triangle(const Vec2& weights) {
    const double sum = weights.x + weights.y;
    return weights.y > weights.x ? Vec2(2.0 * weights.x, sum) : Vec2(sum, 2.0 * weights.y);
}

// The numbers of the first item and of the first cluster.
struct Offsets {
    std::size_t item, cluster;
};
// Orders the items, and sets `begin` to the first item of each of n clusters.
void order(std::span<Item> items, std::size_t n, Offsets first, std::vector<std::size_t>& begin) {
    if (n == 1) begin[first.cluster] = first.item;
    if (n <= 1 && items.size() <= ordered_to) return;
    const Split at = split(items);
    const std::size_t below = n > 1 ? clusters_below(n, at, items.size()) : 0;
    const auto lower = [&] { order(items.first(at.below), below, first, begin); };
    const auto upper = [&] {
        order(items.subspan(at.below), n > 1 ? n - below : 0, {first.item + at.below, first.cluster + below}, begin);
    };
    if (items.size() > faces_in_parallel) {
        oneapi::tbb::parallel_invoke(lower, upper);
    } else {
        lower();
        upper();
    }
}

}  // namespace

FaceClusters::FaceClusters(const Geometry& geometry, std::uint32_t shape, std::vector<std::uint32_t> faces, std::size_t clusters)
    : faces_(std::move(faces)) {
    const Shape& mesh = geometry.shapes()[shape];
    std::vector<double> area_of(geometry.primitive_count(shape));
    const auto for_faces = [&](const auto& f) { oneapi::tbb::parallel_for(std::size_t{0}, faces_.size(), f); };
    for_faces([&](std::size_t i) { area_of[faces_[i]] = geometry.area(shape, faces_[i]); });
    double area = 0.0;
    for (const std::uint32_t face : faces_) area += area_of[face];
    const std::size_t n = std::clamp<std::size_t>(clusters, 1, faces_.size());
    const double width = std::sqrt(area / static_cast<double>(n));

    std::vector<Item> items(faces_.size());
    for_faces([&](std::size_t i) {
        const std::uint32_t face = faces_[i];
        const auto [a, b, c] = corners_of(mesh, face).at;
        const Vec3 across = glm::cross(b - a, c - a), middle = ((a + b + c) / 3.0 - geometry.center()) / width,
                   normal = across * (weight_of_normals / std::max(glm::length(across), 1e-300));
        const auto f = [](double x) { return static_cast<float>(x); };
        items[i] = {{f(middle.x), f(middle.y), f(middle.z), f(normal.x), f(normal.y), f(normal.z)},
                    std::max(f(area_of[face] / area), 1e-30f),
                    face};
    });
    std::vector<std::size_t> begin(n);
    order(items, n, {0, 0}, begin);

    rank_.resize(area_of.size());
    place_.reserve(items.size() + 1);
    double before = 0.0;
    for (std::size_t i = 0; i < items.size(); ++i) {
        faces_[i] = items[i].face;
        rank_[items[i].face] = static_cast<std::uint32_t>(i);
        place_.push_back(before / area);
        before += area_of[items[i].face];
    }
    place_.push_back(1.0);
    ends_.push_back(0.0);
    for (const std::size_t i : begin)
        if (place_[i] > ends_.back() + least_share && place_[i] < 1.0 - least_share) ends_.push_back(place_[i]);
    ends_.push_back(1.0);
}

Vec2 FaceClusters::coordinates(const Geometry& geometry, const SurfacePoint& p) const {
    const TriangleCorners corners = corners_of(geometry.shapes()[p.shape], p.primitive);
    const Vec3 e = corners.at[1] - corners.at[0], f = corners.at[2] - corners.at[0], d = p.position - corners.at[0];
    const double ee = glm::dot(e, e), ef = glm::dot(e, f), ff = glm::dot(f, f), gram = ee * ff - ef * ef;
    const double de = glm::dot(d, e), df = glm::dot(d, f);
    const Vec2 inside = square_of_triangle(Vec2(ff * de - ef * df, ee * df - ef * de) / gram);
    static constexpr double below_1 = 1.0 - 0x1p-30;
    const auto within = [](double x) { return x >= 0.0 ? std::min(x, below_1) : 0.0; };
    const std::uint32_t rank = rank_[p.primitive];
    return {place_[rank] + (place_[rank + 1] - place_[rank]) * within(inside.x), within(inside.y)};
}

SurfacePoint FaceClusters::bare_point(const Geometry& geometry, std::uint32_t shape, const Vec2& st) const {
    const auto after = std::upper_bound(place_.begin(), place_.end() - 1, st.x);
    const auto i = static_cast<std::size_t>(after - place_.begin()) - 1;
    const double s = (st.x - place_[i]) / (place_[i + 1] - place_[i]);
    return geometry.bare_point(geometry.primitive_ref(shape, faces_[i]), {std::clamp(s, 0.0, 1.0), st.y});
}

std::span<const std::uint32_t> FaceClusters::faces(double from, double to) const {
    const auto at = [&](double s) {
        return static_cast<std::size_t>(std::lower_bound(place_.begin(), place_.end() - 1, s) - place_.begin());
    };
    return std::span(faces_).subspan(at(from), at(to) - at(from));
}

}  // namespace neumann
