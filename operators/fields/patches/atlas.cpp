#include "operators/fields/patches/atlas.h"

#include <algorithm>
#include <array>
#include <bit>
#include <map>
#include <numeric>

namespace neumann {

namespace {

Vec3 across(const std::array<Vec3, 3>& corners) { return glm::cross(corners[1] - corners[0], corners[2] - corners[0]); }

bool before(const Vec3& x, const Vec3& y) { return std::array{x.x, x.y, x.z} < std::array{y.x, y.y, y.z}; }

// An edge, identified by the positions of its ends, because files often repeat vertices.
using EdgeEnds = std::array<double, 6>;
EdgeEnds edge_between(Vec3 x, Vec3 y) {
    if (before(y, x)) std::swap(x, y);
    return {x.x, x.y, x.z, y.x, y.y, y.z};
}

// Tolerance for plane quadrilaterals, relative to their size: coordinates in files have few digits.
constexpr double plane_tolerance = 1e-6;

// Whether all corners of a b c d turn left about the normal, and none is collinear with its neighbours.
bool is_plane_and_convex(const std::array<Vec3, 4>& p, const Vec3& normal) {
    for (int i = 0; i < 4; ++i) {
        const Vec3 in = p[i] - p[(i + 3) % 4], out = p[(i + 1) % 4] - p[i];
        if (glm::dot(glm::cross(in, out), normal) < 1e-3 * glm::length(in) * glm::length(out)) return false;
        if (std::abs(glm::dot(out, normal)) > plane_tolerance * glm::length(out)) return false;
    }
    return true;
}

// If a shape has no more faces than this, none are joined: the sides of a small box are patches each.
constexpr std::size_t few_faces = 16;
// If all instances together have more faces than this, each is joined as a whole, even if some of its faces are large:
// a table of the faces of each might not fit in memory.
constexpr std::size_t most_faces_of_instances = 10'000'000;

bool is_small(double face, double patch_area) { return face <= 0.5 * patch_area; }

// The faces of each mesh that are joined because patches are larger.
class SmallFaces {
public:
    SmallFaces(const Geometry& geometry, const std::vector<ShapeArea>& areas, double patch_area, std::size_t patches)
        : geometry_(geometry), areas_(areas), patch_area_(patch_area) {
        std::size_t kept = 0;
        for (std::uint32_t shape = 0; shape < areas.size(); ++shape) {
            const std::size_t faces = geometry.primitive_count(shape);
            if (std::holds_alternative<MeshInstance>(geometry.shapes()[shape])) of_instances_ += faces;
            if (faces > 1 && faces <= few_faces) kept += listed(shape).size();
        }
        keeps_few_ = 2 * kept <= patches;
    }
    bool are_all(std::uint32_t shape) const {
        const std::size_t faces = geometry_.primitive_count(shape);
        const bool is_instance = std::holds_alternative<MeshInstance>(geometry_.shapes()[shape]);
        return faces > (keeps_few_ ? few_faces : 1) &&
               (is_small(areas_[shape].largest_face, patch_area_) || (is_instance && of_instances_ > most_faces_of_instances));
    }
    std::vector<std::uint32_t> of(std::uint32_t shape) const {
        std::vector<std::uint32_t> faces = listed(shape);
        if (faces.size() <= (keeps_few_ ? few_faces : 1)) faces.clear();
        return faces;
    }

private:
    std::vector<std::uint32_t> listed(std::uint32_t shape) const {
        std::vector<std::uint32_t> faces;
        for (std::uint32_t face = 0; face < geometry_.primitive_count(shape); ++face)
            if (is_small(geometry_.area(shape, face), patch_area_)) faces.push_back(face);
        return faces;
    }

    const Geometry& geometry_;
    const std::vector<ShapeArea>& areas_;
    double patch_area_;
    std::size_t of_instances_ = 0;
    bool keeps_few_ = true;
};

}  // namespace

Atlas::Atlas(const Geometry& geometry, const std::vector<ShapeArea>& areas, std::size_t patches) {
    const double patch_area = sum_of_areas(areas) / static_cast<double>(std::max<std::size_t>(patches, 1));
    const SmallFaces small(geometry, areas, patch_area, patches);
    for (std::uint32_t shape = 0; shape < areas.size(); ++shape) {
        const auto chart = static_cast<std::uint32_t>(charts_.size());
        const bool is_mesh = mesh_of(geometry.shapes()[shape]);
        shapes_.push_back({primitives_.size(), chart});
        keeps_shares_.push_back(areas[shape].keeps_shares);
        if (is_mesh && small.are_all(shape))
            charts_.emplace_back(shape, geometry.primitive_count(shape), areas[shape].area);
        else if (is_mesh)
            add_mesh(geometry, shape, small.of(shape), patch_area);
        else if (areas[shape].area > 0.0)
            charts_.emplace_back(geometry, shape);
    }
}

void Atlas::add_mesh(const Geometry& geometry, std::uint32_t shape, Faces small, double patch_area) {
    const std::size_t faces = geometry.primitive_count(shape);
    shapes_.back().is_one_chart = false;
    primitives_.resize(primitives_.size() + faces);
    std::vector<bool> has_chart(faces);
    if (!small.empty()) {
        const auto chart = static_cast<std::uint32_t>(charts_.size());
        double area = 0.0;
        for (const std::uint32_t face : small) {
            has_chart[face] = true;
            primitives_[shapes_.back().first + face].chart = chart;
            area += geometry.area(shape, face);
        }
        charts_.emplace_back(shape, small.size(), area);
        small_.emplace(chart, std::move(small));
    }
    add_faces(geometry, shape, std::move(has_chart), patch_area);
}

const FaceClusters& Atlas::join(const Geometry& geometry, std::uint32_t number, std::size_t clusters) {
    Chart& chart = charts_[number];
    const auto* const instance = std::get_if<MeshInstance>(&geometry.shapes()[chart.shape()]);
    const auto make = [&](std::size_t n) {
        Faces faces(chart.small_faces());
        if (const auto listed = small_.find(number); listed != small_.end())
            faces = std::move(listed->second);
        else
            std::iota(faces.begin(), faces.end(), 0u);
        return std::make_shared<const FaceClusters>(geometry, chart.shape(), std::move(faces), n);
    };
    if (instance && keeps_shares_[chart.shape()] && !small_.contains(number)) {
        // The number is a power of two, so that instances of different sizes share what they can.
        const std::size_t n = std::bit_floor(clusters);
        auto& shared = shared_[{instance->shared().get(), n}];
        if (!shared) shared = make(n);
        chart.set_clusters(shared);
    } else {
        chart.set_clusters(make(clusters));
    }
    small_.erase(number);
    return *chart.clusters();
}

void Atlas::add_faces(const Geometry& geometry, std::uint32_t shape, std::vector<bool> has_chart, double patch_area) {
    const Shape& mesh = geometry.shapes()[shape];
    add_pairs(shape, mesh, has_chart);
    for (std::size_t i = 0; i < has_chart.size(); ++i) {
        if (has_chart[i]) continue;
        const auto number = static_cast<std::uint32_t>(i);
        const std::array<Vec3, 3> corners = corners_of(mesh, number).at;
        const auto& [a, b, c] = corners;
        const double twice = glm::length(across(corners));
        const Vec3 normal = across(corners) / twice;
        Primitive& primitive = primitives_[shapes_[shape].first + i];
        primitive.chart = static_cast<std::uint32_t>(charts_.size());
        if (0.5 * twice <= patch_area) {
            charts_.emplace_back(shape, std::array{a, b, c, c}, normal, number, number);
            continue;
        }
        const Vec3 middle = (a + b + c) / 3.0, ab = 0.5 * (a + b), bc = 0.5 * (b + c), ca = 0.5 * (c + a);
        charts_.emplace_back(shape, std::array{a, ab, middle, ca}, normal, number, number);
        charts_.emplace_back(shape, std::array{b, bc, middle, ab}, normal, number, number);
        charts_.emplace_back(shape, std::array{c, ca, middle, bc}, normal, number, number);
        cut_.emplace_back(a, b, c, 0.0);
        primitive.cut = static_cast<std::uint32_t>(cut_.size());
    }
}

void Atlas::add_pairs(std::uint32_t shape, const Shape& mesh, std::vector<bool>& has_chart) {
    // The longest shared edges come first: these are the diagonals of rectangles.
    std::map<EdgeEnds, std::vector<std::uint32_t>> at_edge;
    for (std::uint32_t i = 0; i < has_chart.size(); ++i) {
        if (has_chart[i]) continue;
        const auto [a, b, c] = corners_of(mesh, i).at;
        for (const auto& [x, y] : {std::pair(a, b), std::pair(b, c), std::pair(c, a)}) at_edge[edge_between(x, y)].push_back(i);
    }
    struct Shared {
        double length;
        std::uint32_t first, second;
    };
    std::vector<Shared> shared;
    for (const auto& [e, triangles] : at_edge)
        if (triangles.size() == 2)
            shared.push_back({glm::distance(Vec3(e[0], e[1], e[2]), Vec3(e[3], e[4], e[5])), triangles[0], triangles[1]});
    std::stable_sort(shared.begin(), shared.end(), [](const Shared& x, const Shared& y) { return x.length > y.length; });

    for (const Shared& pair : shared) {
        if (has_chart[pair.first] || has_chart[pair.second]) continue;
        // The corners are rotated so that the triangles are a b c and a c d, which share the edge a c.
        const std::array<Vec3, 3> low = corners_of(mesh, pair.first).at, up = corners_of(mesh, pair.second).at;
        for (std::size_t i = 0; i < 3; ++i)
            for (std::size_t j = 0; j < 3; ++j) {
                const Vec3 a = low[i], b = low[(i + 1) % 3], c = low[(i + 2) % 3];
                if (has_chart[pair.first] || up[j] != a || up[(j + 1) % 3] != c) continue;
                const std::array quad{a, b, c, up[(j + 2) % 3]};
                const Vec3 normal = glm::normalize(across(low));
                if (!is_plane_and_convex(quad, normal)) continue;
                for (const std::uint32_t triangle : {pair.first, pair.second}) {
                    has_chart[triangle] = true;
                    primitives_[shapes_[shape].first + triangle].chart = static_cast<std::uint32_t>(charts_.size());
                }
                charts_.emplace_back(shape, quad, normal, pair.first, pair.second);
            }
    }
}

std::uint32_t Atlas::nearest_corner(const Primitive& primitive, const Vec3& position) const {
    const Vec2 w = cut_[primitive.cut - 1].weights(position);
    const double first = 1.0 - w.x - w.y;
    return first >= w.x ? (first >= w.y ? 0 : 2) : (w.x >= w.y ? 1 : 2);
}

}  // namespace neumann
