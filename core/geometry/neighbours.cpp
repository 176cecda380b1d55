#include "core/geometry/neighbours.h"

#include "core/geometry/close_regions.h"
#include "core/geometry/rounding.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <bit>
#include <cmath>
#include <limits>
#include <utility>

namespace neumann {

namespace {

namespace index = boost::geometry::index;

constexpr std::size_t largest_asked_one_by_one = 16;
// Regions that reach at most this far from the edges (as a barycentric weight) are not stored individually. A fine mesh
// that ends at a wall is close to few points of such a strip.
constexpr double along_edges = 1.0 / 64.0, along_edges_of_small = 1.0 / 4096.0, small = 1.0 / 16.0;
constexpr double reach_in_errors = 64.0;
// With more faces around it than this, a face is in a crowd. In a mesh of even triangles there are about thirty.
constexpr std::size_t crowd = 256;

// A wall of a room is about this many times larger than the faces of a fine mesh in the room.
constexpr double large_among_crowd = 16.0;
constexpr int cells_among_crowd = 128;
constexpr std::size_t asked_at_once = 64;

// The number of cells along an edge: few enough that they need no more memory than the boxes, but at least 64.
int cells_for(std::size_t boxes) {
    int count = 64;
    while (count < 1024 && static_cast<std::size_t>(count) * static_cast<std::size_t>(count) < 128 * boxes) count *= 2;
    return count;
}

bool holds(const Bounds& box, const Vec3& p) {
    return glm::all(glm::lessThanEqual(box.low, p)) && glm::all(glm::lessThanEqual(p, box.high));
}

bool share_corner(const DoubleFaces& faces, const Face& a, const Face& b) {
    if (!faces.is_triangle(a) || !faces.is_triangle(b)) return false;
    const auto of_a = faces.vertices(a), of_b = faces.vertices(b);
    return std::find_first_of(of_a.begin(), of_a.end(), of_b.begin(), of_b.end()) != of_a.end();
}

// For two triangles that share a corner: whether b continues a beyond one of its edges without a sharp bend. Then a displaced ray
// that starts beside a, or ends on either of them, is still on the right side of both.
bool continues(const DoubleFaces& faces, const Face& a, const Face& b) {
    constexpr double bend = 0.5, rounding = 1e-12;
    const TriangleOfFace of_a = faces.triangle(a), of_b = faces.triangle(b);
    const Triangle &t = *of_a, &other = *of_b;
    if (std::abs(glm::dot(t.normal(), other.normal())) < bend) return false;
    Vec3 largest(-std::numeric_limits<double>::infinity());  // of b's corners, the weights in a
    for (const Vec3& corner : faces.vertices(b)) {
        const Vec2 w = t.weights(corner);
        largest = glm::max(largest, Vec3(w.x, w.y, 1.0 - w.x - w.y));
    }
    return std::min({largest.x, largest.y, largest.z}) <= rounding;
}

// Picks one point in four, by its bits. Examining a face takes as long as some eight searches around a point, and most
// faces of a fine mesh are hit a few times, so a face is examined when such a point is first looked up on it.
bool is_picked(const Vec3& p) {
    std::uint64_t bits = 0;
    for (int axis = 0; axis < 3; ++axis) bits = (bits ^ std::bit_cast<std::uint64_t>(p[axis])) * 0x9e3779b97f4a7c15ull;
    return bits >> 62 == 0;
}

}  // namespace

Neighbours::Neighbours(const DoubleFaces& faces, const Giants& giants, const RayCaster& caster)
    : faces_(faces), giants_(giants), caster_(&caster), round_(faces.shapes().size(), State::unknown) {
    std::vector<Face> large = faces_.all();
    for (const Face& f : large) largest_error_ = std::max(largest_error_, faces_.error(f));
    for (std::uint32_t shape = 0; shape < faces_.shapes().size(); ++shape)
        if (faces_.is_of_instance({shape, 0})) error_of_rest_ = std::max(error_of_rest_, faces_.error({shape, 0}));
    largest_error_ = std::max(largest_error_, error_of_rest_);
    if (large.size() > largest_asked_one_by_one) {
        const auto rest = large.begin() + largest_asked_one_by_one;
        std::nth_element(large.begin(), rest, large.end(), [&](const Face& a, const Face& b) {
            return std::pair(-faces_.error(a), a) < std::pair(-faces_.error(b), b);
        });
        error_of_rest_ = std::max(error_of_rest_, faces_.error(*rest));
        large.erase(rest, large.end());
        large.insert(large.end(), giants.faces.begin(), giants.faces.end());
    }
    for (const Face& f : large) large_.push_back({f, faces_.bounds(f), faces_.error(f)});
}

// In a fine mesh, the reach extends at most to the next triangle but one.
double Neighbours::reach(double errors, double smaller) {
    return std::max(errors, std::min(reach_in_errors * errors, 0.125 * smaller));
}
double Neighbours::reach(const Face& a, const Face& b) const {
    return reach(faces_.error(a) + faces_.error(b), std::min(faces_.size(a), faces_.size(b)));
}

// Appends all faces closer to p than `distance`, or within their reach of a face whose error is at most distance / reach_in_errors.
void Neighbours::append_near(const Vec3& p, double distance, std::vector<Face>& found) const {
    for (const Large& large : large_) found.push_back(large.face);
    if (error_of_rest_ > 0.0)
        caster_->any_near(p, distance + reach_in_errors * error_of_rest_, [&](const Face& f) {
            found.push_back(f);
            return false;
        });
    std::sort(found.begin(), found.end());
    found.erase(std::unique(found.begin(), found.end()), found.end());
}

std::vector<Face> Neighbours::around(const SurfacePoint& p) const {
    const Face own{p.shape, p.primitive};
    std::vector<Face> found;
    append_near(p.position, reach_in_errors * p.error, found);
    std::erase_if(found, [&](const Face& f) {
        // First a test that ignores the faces' sizes.
        const double most = reach_in_errors * (p.error + faces_.error(f));
        // A light without extent lies on no face.
        return f != own &&
               !(faces_.is_near(f, p.position, most) && (p.is_infinite() || faces_.is_near(f, p.position, reach(own, f))));
    });
    return found;
}

void Neighbours::part(SurfacePoint& p, const StartedRay* ray) const {
    const Face own{p.shape, p.primitive};
    for (const Face& f : around(p)) {
        if (f == own) continue;
        const DoubleFaces::Height height = faces_.height(f, p.position);
        const Vec3 along = height.normal - p.normal * glm::dot(height.normal, p.normal);
        constexpr double nearly_parallel = 1e-4;  // square of a sine
        const double slope = glm::dot(along, along);
        if (!height.is_zero() || slope < nearly_parallel || !faces_.is_near(f, p.position, 4.0 * height.rounding)) continue;
        double side = height.distance;
        if (ray) {
            const DoubleFaces::Height of_start = faces_.height(f, ray->start.position);
            const bool starts_there = ray->start.face == f || of_start.is_zero();
            side = starts_there ? glm::dot(ray->direction, of_start.normal) : -glm::dot(ray->direction, height.normal);
        }
        p.position += along * ((std::copysign(4.0 * height.rounding, side) - height.distance) / slope);
    }
}

bool Neighbours::is_in_boxes(const SurfacePoint& p, double aside) const {
    const Surroundings& around = surroundings_.find({p.shape, p.primitive})->second;
    if (around.crowded) return true;
    const Boxes& boxes = around.boxes;
    const auto held = boxes.qbegin(index::intersects(BoxPoint(p.position.x, p.position.y, p.position.z)));
    return std::any_of(held, boxes.qend(),
                       [&](const auto& entry) { return faces_.is_near(entry.second.face, p.position, entry.second.near + aside); });
}

Neighbours::State Neighbours::state_of_round(const Face& f) const {
    const std::atomic_ref state(round_[f.shape]);
    if (state.load(std::memory_order_acquire) == State::unknown) examine(f);
    return state.load(std::memory_order_acquire);
}

Neighbours::Reach Neighbours::reach_of_close_points(const Face& f, const Face& other) const {
    const double errors = faces_.error(f) + faces_.error(other);
    const bool joined = share_corner(faces_, f, other);
    if (joined && continues(faces_, f, other)) return {0.0, true};
    const Bounds bounds = faces_.bounds(f);
    const bool touch = joined || close_region(faces_, f, other, double_rounding(bounds.low, largest_component(bounds.high)));
    return {touch ? errors : reach(f, other), touch};
}

bool Neighbours::is_near_other(const SurfacePoint& p, double aside) const {
    const Face f{p.shape, p.primitive};
    const double size = faces_.size_at_most(f);
    const auto is_near = [&](const Face& other) {
        // The first test ignores the other's corners: most faces are not that near.
        if (other == f || !faces_.is_near(other, p.position, reach(faces_.error(f) + faces_.error(other), size) + aside))
            return false;
        const double near = reach_of_close_points(f, other).distance;
        return near > 0.0 && holds(faces_.bounds(other).grown(near + aside), p.position) &&
               faces_.is_near(other, p.position, near + aside);
    };
    const auto may_be_near = [&](const Large& large) {
        return holds(large.bounds.grown(reach_in_errors * (faces_.error(f) + large.error) + aside), p.position) &&
               is_near(large.face);
    };
    if (std::any_of(large_.begin(), large_.end(), may_be_near)) return true;
    if (error_of_rest_ == 0.0) return false;
    std::array<Face, 16> found;
    std::size_t count = 0;
    const auto is_one_near = [&] { return std::any_of(found.begin(), found.begin() + std::exchange(count, 0), is_near); };
    return caster_->any_near(p.position, reach(faces_.error(f) + error_of_rest_, size) + aside, [&](const Face& other) {
        faces_.prefetch(other);
        found[count++] = other;
        return count == found.size() && is_one_near();
    }) || is_one_near();
}

bool Neighbours::is_close(const SurfacePoint& p) const {
    const Face f{p.shape, p.primitive};
    if (faces_.is_of_instance(f)) return is_near_other(p, 0.0);
    if (const TriangleOfFace t = faces_.triangle(f)) {
        if (!t->is_examined() && is_picked(p.position)) examine(f);
        if (t->is_examined() && !t->is_crowded()) {
            const Vec2 w = t->weights(p.position);
            if (t->is_clear(w)) return false;
            if (!t->is_near_edge(w) && !is_in_boxes(p, 0.0)) return false;
        }
    } else if (const State state = state_of_round(f);
               state == State::clear || (state == State::not_clear && !is_in_boxes(p, 0.0))) {
        return false;
    }
    return is_near_other(p, 0.0);
}

bool Neighbours::may_hide(const SurfacePoint& p, double cosine) const {
    const Face f{p.shape, p.primitive};
    const bool grazes = std::abs(cosine) < Triangle::grazing;
    const double aside = largest_error_ / std::abs(cosine);
    if (faces_.is_of_instance(f)) return grazes || is_near_other(p, aside);
    if (const TriangleOfFace t = faces_.triangle(f)) {
        if (!t->is_examined() && (grazes || is_picked(p.position))) examine(f);
        if (t->is_examined() && !t->is_crowded()) {
            const Vec2 w = t->weights(p.position);
            if (t->is_clear(w, cosine)) return false;
            if (!grazes && !t->is_near_edge(w, cosine) && !is_in_boxes(p, aside)) return false;
        }
    } else if (const State state = state_of_round(f);
               state == State::clear || (state == State::not_clear && !grazes && !is_in_boxes(p, aside))) {
        return false;
    }
    return grazes || is_near_other(p, aside);
}

Neighbours::Others Neighbours::others_around(const Face& f) const {
    const Bounds bounds = faces_.bounds(f);
    const Vec3 center = bounds.center();
    const double distance =
        bounds.radius() + reach_in_errors * (faces_.error(f) + error_of_rest_) + largest_error_ / Triangle::grazing;
    std::vector<Face> others;
    for (const Large& large : large_) others.push_back(large.face);
    if (error_of_rest_ > 0.0 && caster_->any_near(center, distance, [&](const Face& other) {
            faces_.prefetch(other);
            others.push_back(other);
            return others.size() - large_.size() > crowd;
        }))
        return {{others.begin() + static_cast<std::ptrdiff_t>(large_.size()), others.end()}, true};
    for (const Face& other : others) faces_.prefetch_corners(other);
    std::sort(others.begin(), others.end());
    others.erase(std::unique(others.begin(), others.end()), others.end());
    return {std::move(others)};
}

void Neighbours::mark_near_others(const Face& f, int column, int row, int squares, WeightCells& cells) const {
    if (column + row >= squares) return;  // beyond the third edge
    const auto corners = faces_.vertices(f);
    const double width = 1.0 / squares, u = column * width, v = row * width;
    const std::array<Vec2, 4> square{Vec2(u, v), Vec2(u + width, v), Vec2(u + width, v + width), Vec2(u, v + width)};
    Bounds bounds;
    for (const Vec2& w : square) bounds.add(corners[0] + (corners[1] - corners[0]) * w.x + (corners[2] - corners[0]) * w.y);
    const double error = faces_.error(f), aside = largest_error_ / Triangle::grazing;
    const auto may_be_near = [&](const Face& other, double error_of_other, const Bounds& of_other) {
        const double most = reach_in_errors * (error + error_of_other) + aside;
        return !(other == f) && !intersection(bounds.grown(most), of_other).is_empty() &&
               reach_of_close_points(f, other).distance > 0.0;
    };
    std::size_t asked = 0;
    const bool near =
        std::any_of(large_.begin(), large_.end(),
                    [&](const Large& other) { return may_be_near(other.face, other.error, other.bounds); }) ||
        (error_of_rest_ > 0.0 &&
         caster_->any_near(bounds.center(), bounds.radius() + reach_in_errors * (error + error_of_rest_) + aside,
                           [&](const Face& other) {
                               return ++asked > asked_at_once || may_be_near(other, faces_.error(other), faces_.bounds(other));
                           }));
    if (!near) return;
    if (squares == cells_among_crowd) {
        cells.mark(square);
        return;
    }
    for (const int down : {0, 1})
        for (const int right : {0, 1}) mark_near_others(f, 2 * column + right, 2 * row + down, 2 * squares, cells);
}

void Neighbours::examine_among_crowd(const Face& f, const std::vector<Face>& some) const {
    const TriangleOfFace t = faces_.triangle(f);
    if (!t) {
        std::atomic_ref(round_[f.shape]).store(State::crowded, std::memory_order_release);
        return;
    }
    std::vector<double> sizes;
    for (const Face& other : some) sizes.push_back(faces_.size(other));
    const auto middle = sizes.begin() + static_cast<std::ptrdiff_t>(sizes.size() / 2);
    std::nth_element(sizes.begin(), middle, sizes.end());
    if (faces_.size(f) < large_among_crowd * *middle) {
        t->set_crowded();
        return;
    }
    WeightCells cells(cells_among_crowd);
    mark_near_others(f, 0, 0, 1, cells);
    const auto kept = surroundings_.emplace(f, Surroundings{std::move(cells), Boxes(), true}).first;
    const float on_edge = std::numeric_limits<float>::min();
    t->set_close(on_edge, on_edge, &kept->second.cells);
}

void Neighbours::examine(const Face& f) const {
    const Others others = others_around(f);
    if (others.crowd) return examine_among_crowd(f, others.faces);
    const Bounds bounds = faces_.bounds(f);
    const double error = faces_.error(f), aside = largest_error_ / Triangle::grazing;
    const auto is_small = [&](const Face& other) { return faces_.size(other) < small * faces_.size(f); };
    double strip = 0.0, corner = 0.0;
    std::vector<std::pair<Box, Other>> boxes;
    std::vector<std::vector<Vec2>> polygons;
    for (const Face& other : others.faces) {
        if (other == f) continue;
        const double errors = error + faces_.error(other);
        if (intersection(bounds.grown(reach_in_errors * errors + aside), faces_.bounds(other)).is_empty()) continue;
        const auto [near, touches] = reach_of_close_points(f, other);
        if (near == 0.0) continue;
        // Where faces touch, the region of oblique rays is at most 1/cosine times as wide: the largest weight is a concave function
        // of the distance, and not below 0 at the distance 0.
        const auto steep = touches ? close_region(faces_, f, other, near + largest_error_) : std::nullopt;
        if (steep && steep->from_corner <= along_edges) {
            corner = std::max(corner, steep->from_corner);
        } else if (steep && steep->from_edge <= (is_small(other) ? along_edges_of_small : along_edges)) {
            strip = std::max(strip, steep->from_edge);
        } else if (const auto region = close_region(faces_, f, other, near + aside)) {
            const Vec3 &low = region->bounds.low, &high = region->bounds.high;
            boxes.push_back({{{low.x, low.y, low.z}, {high.x, high.y, high.z}}, {other, near}});
            polygons.push_back(region->weights);
        }
    }
    const WeightCells* kept = nullptr;
    if (!boxes.empty()) {
        WeightCells cells(cells_for(boxes.size()));
        for (const auto& polygon : polygons) cells.mark(polygon);
        kept = &surroundings_.emplace(f, Surroundings{std::move(cells), Boxes(boxes)}).first->second.cells;
    }
    // Weights are rounded up by more than their rounding, and above 0, so that points on an edge are never clear.
    const auto rounded_up = [](double weight) { return std::nextafter(static_cast<float>(1.001 * weight), 1.0f); };
    if (const TriangleOfFace t = faces_.triangle(f))
        t->set_close(rounded_up(strip), rounded_up(corner), kept);
    else
        std::atomic_ref(round_[f.shape]).store(kept ? State::not_clear : State::clear, std::memory_order_release);
}

bool Neighbours::is_behind(const Face& f, const Face& own_face, const Vec3& direction) const {
    const TriangleOfFace own = faces_.triangle(own_face);
    if (!own || !faces_.is_triangle(f)) return false;
    const Vec3 n = glm::dot(own->normal(), direction) < 0.0 ? -own->normal() : own->normal();
    const auto corners = faces_.vertices(f);
    return std::all_of(corners.begin(), corners.end(), [&](const Vec3& corner) {
        return glm::dot(corner - own->vertex(), n) <= double_rounding(corner, largest_component(own->vertex()));
    });
}

std::optional<Neighbours::Met> Neighbours::nearest(std::span<const Face> faces, const RayStart& start,
                                                   const Vec3& direction) const {
    std::optional<Met> met;
    for (const Face& f : faces) {
        if (start.face && is_behind(f, *start.face, direction)) continue;
        double distances[2];
        if (faces_.meet(f, start, direction, distances) > 0 && !(met && met->distance <= distances[0])) met = {f, distances[0]};
    }
    return met;
}

// Where a ray passes an edge of a body within rounding, it may miss the front and hit the back, or find the back first.
// A ray beside it, clear of the edge, shows which of the faces that both hit is in front.
std::optional<Neighbours::Met> Neighbours::first(std::span<const Face> faces, const RayStart& start, const Vec3& direction) const {
    const auto met = nearest(faces, start, direction);
    if (!met) return met;
    const auto off_edge = faces_.off_edge(met->face, start.position, direction, met->distance);
    if (!off_edge) return met;
    std::vector<Face> hit;
    for (const Face& f : faces) {
        double distances[2];
        if (faces_.meet(f, start, direction, distances, 2.0 * DoubleFaces::unsure) > 0) hit.push_back(f);
    }
    // The ray beside starts so far back that it is before all of them.
    const double back = 1024.0 * glm::length(*off_edge);
    RayStart beside = start;
    beside.position += *off_edge - direction * back;
    const auto front = nearest(hit, beside, direction);
    return front ? Met{front->face, met->distance} : met;
}

bool Neighbours::any_between(std::span<const Face> faces, const SurfacePoint& x, const SurfacePoint& y) const {
    const double length = glm::length(y.position - x.position);
    const Vec3 direction = (y.position - x.position) / length;
    const RayStart start = x, end_point = y;
    for (const Face& f : faces) {
        if ((start.face && is_behind(f, *start.face, direction)) || (end_point.face && is_behind(f, *end_point.face, -direction)))
            continue;
        double distances[2];
        const int n = faces_.meet(f, start, direction, distances);
        if (n == 0) continue;
        // If y lies on the face, a hit at the end of the ray does not count.
        const bool ends_there = end_point.face == f || faces_.holds(f, y.position);
        const int end = !ends_there ? -1 : n == 2 && std::abs(distances[1] - length) < std::abs(distances[0] - length);
        for (int i = 0; i < n; ++i)
            if (i != end && distances[i] < length) return true;
    }
    return false;
}

}  // namespace neumann
