#include "core/geometry/geometry.h"

#include "core/base/error.h"
#include "core/geometry/giants.h"
#include "core/geometry/neighbours.h"
#include "core/geometry/round_surface.h"
#include "core/geometry/rounding.h"

#include <oneapi/tbb/parallel_for.h>
#include <algorithm>
#include <cmath>

namespace neumann {

namespace {

void validate_round(const Shape& shape) {
    if (const auto* sphere = std::get_if<Sphere>(&shape)) {
        if (!is_finite(sphere->center) || !std::isfinite(sphere->radius)) throw InputError("sphere is not finite");
    } else if (const auto* disk = std::get_if<Disk>(&shape)) {
        if (!is_finite(disk->center) || !is_finite(disk->u) || !is_finite(disk->v)) throw InputError("disk is not finite");
    } else if (const auto* cylinder = std::get_if<Cylinder>(&shape)) {
        if (!is_finite(cylinder->base) || !is_finite(cylinder->axis) || !is_finite({cylinder->length, cylinder->radius, 0.0}))
            throw InputError("cylinder is not finite");
    }
}

}  // namespace

Geometry::Geometry(Geometry&&) noexcept = default;
Geometry::~Geometry() = default;

Geometry::Geometry(std::vector<Shape> shapes) {
    Bounds bounds;
    for (Shape& shape : shapes) {
        if (auto* mesh = std::get_if<TriangleMesh>(&shape)) {
            expect_valid(*mesh);
            degenerate_count_ += erase_degenerate_triangles(*mesh);
        } else if (const auto* instance = std::get_if<MeshInstance>(&shape)) {
            degenerate_count_ += instance->shared()->degenerate_count();
        } else {
            validate_round(shape);
            degenerate_count_ += !has_extent(shape);
        }
        if (has_extent(shape)) bounds.add(bounds_of(shape));
    }
    if (!bounds.is_empty()) {
        center_ = bounds.center();
        radius_ = bounds.radius();
    }
    shapes_ = std::make_shared<const std::vector<Shape>>(std::move(shapes));
    const Giants giants = find_giants(*shapes_);
    giants_ = giants.faces;

    // Embree's coordinates are scaled to about unit size.
    const Bounds& seen = giants.rest.is_empty() ? bounds : giants.rest;
    const double scale = seen.is_empty() ? 1.0 : scale_to_one(seen);
    caster_ = std::make_unique<RayCaster>(*shapes_, giants_, seen.is_empty() ? Vec3(0.0) : seen.center(), scale);
    triangles_.resize(shapes_->size());
    error_.resize(shapes_->size());
    // Far from the origin, doubles may be coarser than the floats of a small scene relative to its centre.
    const double least_error = seen.is_empty() ? 0.0 : 4.0 * double_rounding(seen.low, largest_component(seen.high));
    const auto error = [&](const Face& face, double size) {
        const bool is_giant = std::binary_search(giants_.begin(), giants_.end(), face);
        return std::max(float_rounding(is_giant ? 0.0 : size * scale) / scale, least_error);
    };
    oneapi::tbb::parallel_for(std::uint32_t{0}, static_cast<std::uint32_t>(shapes_->size()), [&](std::uint32_t shape) {
        if (const auto* mesh = std::get_if<TriangleMesh>(&(*shapes_)[shape])) {
            triangles_[shape].reserve(mesh->triangles.size());
            for (std::uint32_t i = 0; i < mesh->triangles.size(); ++i) {
                const TriangleCorners corners = corners_of(*mesh, i);
                const auto& [a, b, c] = corners.at;
                triangles_[shape].emplace_back(a, b, c, error({shape, i}, corners.longest_edge()));
            }
        } else if (const auto* instance = std::get_if<MeshInstance>(&(*shapes_)[shape])) {
            // Embree moves the ray into the coordinates of the mesh, in floats.
            error_[shape] = error({shape, 0}, instance->longest_edge()) * (1.0 + instance->distortion());
        } else if (const auto* sphere = std::get_if<Sphere>(&(*shapes_)[shape])) {
            error_[shape] = error({shape, 0}, sphere->radius);
        } else if (const auto* disk = std::get_if<Disk>(&(*shapes_)[shape])) {
            error_[shape] = error({shape, 0}, glm::length(disk->u) + glm::length(disk->v));
        } else if (const auto* cylinder = std::get_if<Cylinder>(&(*shapes_)[shape])) {
            error_[shape] = error({shape, 0}, cylinder->radius + cylinder->length);
        }
    });
    neighbours_ = std::make_unique<Neighbours>(DoubleFaces(*shapes_, triangles_, error_), giants, *caster_);
}

SurfacePoint Geometry::round_point(const Face& face, const RoundPoint& p) const {
    return {p.position, p.normal, error_[face.shape], face.shape, face.primitive};
}

bool Geometry::put_near_edge(const Vec3& origin, const Vec3& direction, const RayCaster::Hit& hit, SurfacePoint& p) const {
    const TriangleOfFace t = neighbours_->faces().triangle({hit.shape, hit.primitive});
    const Triangle::Meeting m = t->meet(origin, direction);
    Vec3 position = m.position;
    if (!t->is_hit(m)) {
        const auto* instance = std::get_if<MeshInstance>(&(*shapes_)[hit.shape]);
        const bool exchanged = instance && instance->mirrors();
        position = t->near(m, exchanged ? hit.v : hit.u, exchanged ? hit.u : hit.v, edges(hit.shape, hit.primitive));
    }
    p = {position, t->normal(), t->error(), hit.shape, hit.primitive};
    return !t->is_missed(m);
}

bool Geometry::put_among_others(const RayStart& start, const Vec3& direction, const RayCaster::Hit& hit, SurfacePoint& p) const {
    SurfacePoint found;
    const bool sure = put_alone(start.position, direction, hit, found);
    if (neighbours_->may_hide(found, glm::dot(direction, found.normal))) {
        const StartedRay ray{start, direction};
        look_around(found, &ray);
        if (!settle(start, direction, found)) return false;
    } else if (!sure) {
        move_beside(start, direction, found);
    }
    p = found;
    return true;
}

SurfacePoint Geometry::hit_among_others(const RayStart& start, const Vec3& direction, const RayCaster::Hit& hit) const {
    SurfacePoint p;
    const bool sure = put_alone(start.position, direction, hit, p);
    const StartedRay ray{start, direction};
    look_around(p, &ray);
    if (!sure && !p.close) move_beside(start, direction, p);
    return p;
}

bool Geometry::put_alone(const Vec3& origin, const Vec3& direction, const RayCaster::Hit& hit, SurfacePoint& p) const {
    const Face face{hit.shape, hit.primitive};
    if (neighbours_->faces().is_triangle(face)) return put_near_edge(origin, direction, hit, p);
    p = round_point(face, hit_round((*shapes_)[face.shape], origin, direction, hit.distance, error_[face.shape]));
    return true;
}

void Geometry::look_around(SurfacePoint& p, const StartedRay* ray) const {
    p.close = neighbours_->is_close(p);
    if (p.close) neighbours_->part(p, ray);
}

bool Geometry::settle(const RayStart& start, const Vec3& direction, SurfacePoint& p) const {
    const Face own{p.shape, p.primitive};
    double distances[2];
    if (neighbours_->faces().meet(own, start, direction, distances) == 0) return false;
    const auto first = neighbours_->first(neighbours_->around(p), start, direction);
    if (first && first->face != own && first->distance <= distances[0])
        p = point_on(first->face, {start, direction}, first->distance);
    return true;
}

void Geometry::move_beside(const RayStart& start, const Vec3& direction, SurfacePoint& p) const {
    const auto first = neighbours_->first(neighbours_->around(p), start, direction);
    if (!first) return;
    p = point_on(first->face, {start, direction}, first->distance);
    if (p.close) settle(start, direction, p);
}

SurfacePoint Geometry::bare_point_on(const Face& face, const Vec3& position) const {
    if (const TriangleOfFace t = neighbours_->faces().triangle(face)) return on_triangle(*t, face.shape, face.primitive, position);
    return round_point(face, put_on_round((*shapes_)[face.shape], position, error_[face.shape]));
}

SurfacePoint Geometry::point_on(const Face& face, const StartedRay& ray, double distance) const {
    SurfacePoint p = bare_point_on(face, ray.start.position + ray.direction * distance);
    look_around(p, &ray);
    return p;
}

SurfacePoint Geometry::point_on_instance(const Face& face, const Vec3& position) const {
    SurfacePoint p = bare_point_on(face, position);
    look_around(p);
    return p;
}

namespace {

// Traces with Embree the part of the ray that is near the faces that it holds.
bool cast_near_rest(const Giants& giants, const RayCaster& caster, const Vec3& origin, const Vec3& direction, double distance,
                    std::span<const Face> without, RayCaster::Hit& hit) {
    const auto part = giants.near_rest(origin, direction, distance);
    if (!part || !caster.intersect(origin + direction * part->begin, direction, part->end - part->begin, without, hit))
        return false;
    hit.distance += part->begin;
    return true;
}

}  // namespace

bool Geometry::meet_giants(const RayStart& start, const Vec3& direction, double distance, bool found, SurfacePoint& p) const {
    if (giants_.empty()) return found;
    const auto first = neighbours_->first(giants_, start, direction);
    if (!first || first->distance >= (found ? glm::dot(p.position - start.position, direction) : distance)) return found;
    p = point_on(first->face, {start, direction}, first->distance);
    if (p.close) settle(start, direction, p);
    return true;
}

// Recomputes each close hit of Embree in double, with all faces close to it, until the next hit of Embree is not close, or lies
// behind a hit found in double.
bool Geometry::first_hit_past(const RayStart& start, const Vec3& embree_start, const Vec3& direction, double distance,
                              std::vector<Face> faces, SurfacePoint& hit) const {
    const Vec3 origin = start.position;
    for (;;) {
        const auto first = neighbours_->first(faces, start, direction);
        RayCaster::Hit found;
        SurfacePoint p;
        const bool any = cast_near_rest(neighbours_->giants(), *caster_, embree_start, direction, distance, faces, found);
        if (any) p = hit_among_others(start, direction, found);
        if (first && first->distance <= distance && !(any && glm::dot(p.position - origin, direction) < first->distance)) {
            hit = point_on(first->face, {start, direction}, first->distance);
            return true;
        }
        if (!any || !p.close) {
            if (any) hit = p;
            return any;
        }
        const std::vector<Face> around = neighbours_->around(p);
        faces.insert(faces.end(), around.begin(), around.end());
        std::sort(faces.begin(), faces.end());
        faces.erase(std::unique(faces.begin(), faces.end()), faces.end());
    }
}

bool Geometry::first_hit(const Vec3& origin, const Vec3& direction, double distance, SurfacePoint& p) const {
    RayCaster::Hit hit;
    bool found = cast_near_rest(neighbours_->giants(), *caster_, origin, direction, distance, {}, hit);
    if (found && !put_on_surface(origin, direction, hit, p)) found = first_hit_past(origin, origin, direction, distance, {}, p);
    return meet_giants(origin, direction, distance, found, p);
}

bool Geometry::first_hit(const SurfacePoint& from, const Vec3& direction, SurfacePoint& hit) const {
    if (from.close) return first_hit_in_double(from, direction, hit);
    constexpr double infinity = std::numeric_limits<double>::infinity();
    const RayStart start = from;  // which `hit` may be
    const Vec3 embree_start = leave(from, glm::dot(from.normal, direction));
    RayCaster::Hit found;
    bool is_found = cast_near_rest(neighbours_->giants(), *caster_, embree_start, direction, infinity, {}, found);
    if (is_found && !put_on_surface(start, direction, found, hit))
        is_found = first_hit_past(start, embree_start, direction, infinity, {}, hit);
    return meet_giants(start, direction, infinity, is_found, hit);
}

bool Geometry::first_hit_in_double(const SurfacePoint& from, const Vec3& direction, SurfacePoint& hit) const {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    const RayStart start = from;  // which `hit` may be
    const Vec3 origin = from.position;
    const std::vector<Face> faces = neighbours_->around(from);
    const auto first = neighbours_->first(faces, start, direction);
    RayCaster::Hit found;
    SurfacePoint beyond;
    bool any_beyond = cast_near_rest(neighbours_->giants(), *caster_, origin, direction, infinity, faces, found);
    if (any_beyond && !put_on_surface(start, direction, found, beyond))
        any_beyond = first_hit_past(start, origin, direction, infinity, faces, beyond);
    if (first && !(any_beyond && glm::dot(beyond.position - origin, direction) < first->distance)) {
        hit = point_on(first->face, {start, direction}, first->distance);
        if (hit.close) settle(start, direction, hit);
    } else if (any_beyond) {
        hit = beyond;
    }
    return meet_giants(start, direction, infinity, first || any_beyond, hit);
}

bool Geometry::visible(const SurfacePoint& x, const SurfacePoint& y) const {
    if (x.close || y.close || !giants_.empty()) return visible_in_double(x, y);
    const Vec3 d = y.position - x.position;
    return !caster_->occluded(leave(x, glm::dot(x.normal, d)), leave(y, -glm::dot(y.normal, d)));
}

bool Geometry::visible_in_double(const SurfacePoint& x, const SurfacePoint& y) const {
    const Vec3 d = y.position - x.position;
    std::vector<Face> faces = giants_;
    // If one end is close, a displaced other end would tilt the ray past what is close to the first.
    const bool exact = x.close || y.close;
    if (exact)
        for (const SurfacePoint* end : {&x, &y}) {
            const std::vector<Face> around = neighbours_->around(*end);
            faces.insert(faces.end(), around.begin(), around.end());
        }
    std::sort(faces.begin(), faces.end());
    faces.erase(std::unique(faces.begin(), faces.end()), faces.end());
    if (neighbours_->any_between(faces, x, y)) return false;
    const Vec3 begin = exact ? x.position : leave(x, glm::dot(x.normal, d)),
               end = exact ? y.position : leave(y, -glm::dot(y.normal, d));
    const double length = glm::length(end - begin);
    const Vec3 direction = (end - begin) / length;
    const auto part = neighbours_->giants().near_rest(begin, direction, length);
    if (!part) return true;
    return !caster_->occluded(part->begin > 0.0 ? begin + direction * part->begin : begin,
                              part->end < length ? begin + direction * part->end : end, faces);
}

std::uint32_t Geometry::primitive_count(std::uint32_t shape) const {
    const TriangleMesh* mesh = mesh_of((*shapes_)[shape]);
    return mesh ? static_cast<std::uint32_t>(mesh->triangles.size()) : 1;
}

double Geometry::area(std::uint32_t shape, std::uint32_t primitive) const {
    if (mesh_of((*shapes_)[shape])) {
        const TriangleCorners corners = corners_of((*shapes_)[shape], primitive);
        return Triangle::area(corners.at[0], corners.at[1], corners.at[2]);
    }
    return round_area((*shapes_)[shape]);
}

double Geometry::area(std::uint32_t shape) const {
    double sum = 0.0;
    for (std::uint32_t i = 0; i < primitive_count(shape); ++i) sum += area(shape, i);
    return sum;
}

SurfacePoint Geometry::bare_point(const PrimitiveRef& ref, const Vec2& uv) const {
    const auto [shape, primitive, triangle, edges] = ref;
    if (const TriangleOfFace t = neighbours_->faces().triangle({shape, primitive})) {
        const Vec2 weights = uniform_triangle(uv);
        return {t->at(weights.x, weights.y, triangle ? edges : this->edges(shape, primitive)), t->normal(), t->error(), shape,
                primitive};
    }
    return round_point({shape, 0}, sample_round((*shapes_)[shape], uv, error_[shape]));
}

SurfacePoint Geometry::point_off_meshes(std::uint32_t shape, std::uint32_t primitive, const Vec2& uv) const {
    SurfacePoint p = bare_point({shape, primitive, nullptr, {}}, uv);
    look_around(p);
    return p;
}

SurfacePoint Geometry::seen_in_place_of(const SurfacePoint& p, double errors) const {
    constexpr std::size_t compared = 16;
    const Face own{p.shape, p.primitive};
    const double near = errors * p.error, length = 2.0 * near;
    const Vec3 from = p.position + p.normal * near;
    std::vector<Face> faces;
    if (neighbours_->giants().near_rest(from, -p.normal, length))
        caster_->append_between(from, from - p.normal * length, {&own, 1}, compared, faces);
    for (const Face& giant : giants_)
        if (giant != own && neighbours_->faces().is_near(giant, p.position, near)) faces.push_back(giant);
    if (faces.empty()) return p;
    faces.push_back(own);
    std::sort(faces.begin(), faces.end());
    const auto first = neighbours_->first(faces, from, -p.normal);
    return first && first->distance < length ? bare_point_on(first->face, from - p.normal * first->distance) : p;
}

Vec2 Geometry::round_coordinates(std::uint32_t shape, const Vec3& position) const {
    return neumann::round_coordinates((*shapes_)[shape], position);
}

}  // namespace neumann
