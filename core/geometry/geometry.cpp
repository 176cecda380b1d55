#include "core/geometry/geometry.h"

#include "core/base/error.h"
#include "core/base/frame.h"
#include "core/sampling/warp.h"

#include <algorithm>
#include <cmath>
#include <string>

#include <oneapi/tbb/parallel_for.h>

namespace neumann {

namespace {

// Half the spacing of floats at 1: what rounding a coordinate of unit size to float can move it by.
constexpr double float_epsilon = 0x1p-24;

// The distance that clears rounding, in a scene of about unit size: of the ends and the direction of a ray, which may come from
// anywhere in the scene, and of Embree's distance along the normal of a triangle, which is computed from its vertices relative to
// the origin.
double hit_error(double size) { return float_epsilon * 8.0 * (1.0 + size); }

double largest_component(const Vec3& v) { return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)}); }

struct Bounds {
    Vec3 low{std::numeric_limits<double>::infinity()}, high{-std::numeric_limits<double>::infinity()};
    void add(const Vec3& p) {
        low = glm::min(low, p);
        high = glm::max(high, p);
    }
};

double twice_area(const Vec3& a, const Vec3& b, const Vec3& c) { return glm::length(glm::cross(b - a, c - a)); }

std::size_t erase_degenerate_triangles(TriangleMesh& mesh) {
    const std::size_t count = mesh.triangles.size();
    std::size_t kept = 0;
    for (std::size_t i = 0; i < count; ++i) {
        const auto t = mesh.triangles[i];
        if (!(twice_area(mesh.vertices[t[0]], mesh.vertices[t[1]], mesh.vertices[t[2]]) > 0.0)) continue;
        mesh.triangles[kept] = t;
        for (MeshAttribute& a : mesh.attributes)
            if (a.of_triangles) a.values[kept] = a.values[i];
        ++kept;
    }
    mesh.triangles.resize(kept);
    for (MeshAttribute& a : mesh.attributes)
        if (a.of_triangles) a.values.resize(kept);
    return count - kept;
}

void validate(const TriangleMesh& mesh) {
    for (const Vec3& v : mesh.vertices)
        if (!is_finite(v)) throw InputError("mesh vertex is not finite");
    for (const auto& t : mesh.triangles)
        for (const std::uint32_t index : t)
            if (index >= mesh.vertices.size())
                throw InputError("mesh vertex index " + std::to_string(index) + " is out of range, the mesh has " +
                                 std::to_string(mesh.vertices.size()) + " vertices");
}

}  // namespace

Geometry::Geometry(Geometry&&) noexcept = default;
Geometry::~Geometry() = default;

Geometry::Geometry(std::vector<Shape> shapes) {
    Bounds bounds;
    for (Shape& shape : shapes) {
        if (auto* mesh = std::get_if<TriangleMesh>(&shape)) {
            validate(*mesh);
            degenerate_count_ += erase_degenerate_triangles(*mesh);
            for (const auto& t : mesh->triangles)
                for (const std::uint32_t index : t) bounds.add(mesh->vertices[index]);
        } else if (const auto* sphere = std::get_if<Sphere>(&shape)) {
            if (!is_finite(sphere->center) || !std::isfinite(sphere->radius)) throw InputError("sphere is not finite");
            if (!(sphere->radius > 0.0)) {
                ++degenerate_count_;
                continue;
            }
            bounds.add(sphere->center - sphere->radius);
            bounds.add(sphere->center + sphere->radius);
        } else if (const auto* disk = std::get_if<Disk>(&shape)) {
            if (!is_finite(disk->center) || !is_finite(disk->u) || !is_finite(disk->v)) throw InputError("disk is not finite");
            if (!(glm::length(glm::cross(disk->u, disk->v)) > 0.0)) {
                ++degenerate_count_;
                continue;
            }
            const Vec3 extent(std::hypot(disk->u.x, disk->v.x), std::hypot(disk->u.y, disk->v.y), std::hypot(disk->u.z, disk->v.z));
            bounds.add(disk->center - extent);
            bounds.add(disk->center + extent);
        } else if (const auto* cylinder = std::get_if<Cylinder>(&shape)) {
            if (!is_finite(cylinder->base) || !is_finite(cylinder->axis) || !is_finite({cylinder->length, cylinder->radius, 0.0}))
                throw InputError("cylinder is not finite");
            if (!cylinder->has_extent()) {
                ++degenerate_count_;
                continue;
            }
            bounds.add(cylinder->center() - cylinder->extent());
            bounds.add(cylinder->center() + cylinder->extent());
        }
    }
    double scale = 1.0;
    if (bounds.low.x <= bounds.high.x) {
        center_ = 0.5 * (bounds.low + bounds.high);
        radius_ = 0.5 * glm::length(bounds.high - bounds.low);
        int exponent = 0;
        std::frexp(0.5 * largest_component(bounds.high - bounds.low), &exponent);
        scale = std::ldexp(1.0, -exponent);
    }

    shapes_ = std::make_shared<const std::vector<Shape>>(std::move(shapes));
    caster_ = std::make_unique<RayCaster>(*shapes_, center_, scale);
    triangles_.resize(shapes_->size());
    error_.resize(shapes_->size());
    oneapi::tbb::parallel_for(std::size_t{0}, shapes_->size(), [&](std::size_t i) {
        if (const auto* mesh = std::get_if<TriangleMesh>(&(*shapes_)[i])) {
            triangles_[i].reserve(mesh->triangles.size());
            for (const auto& t : mesh->triangles) {
                const Vec3 a = mesh->vertices[t[0]], b = mesh->vertices[t[1]], c = mesh->vertices[t[2]];
                const double longest = std::max({glm::length(b - a), glm::length(c - a), glm::length(c - b)});
                triangles_[i].emplace_back(a, Triangle::Edges{b - a, c - a}, hit_error(longest * scale) / scale);
            }
        } else if (const auto* sphere = std::get_if<Sphere>(&(*shapes_)[i])) {
            error_[i] = hit_error(sphere->radius * scale) / scale;
        } else if (const auto* disk = std::get_if<Disk>(&(*shapes_)[i])) {
            const double size = (glm::length(disk->u) + glm::length(disk->v)) * scale;
            error_[i] = hit_error(size) / scale;
        } else if (const auto* cylinder = std::get_if<Cylinder>(&(*shapes_)[i])) {
            error_[i] = hit_error((cylinder->radius + cylinder->length) * scale) / scale;
        }
    });
}

namespace {

void put_on_sphere(const Sphere& s, const Vec3& position, double error, SurfacePoint& p) {
    const Vec3 n = glm::normalize(position - s.center);
    p.position = s.center + n * s.radius;
    p.normal = s.flip_normals ? -n : n;
    p.error = error;
}

// n, or a unit vector beside it, so that w meets a surface with this normal from before (sign −1) or from behind (1). A tangent in
// floats may pass by in double, where n is perpendicular to it but for rounding.
Vec3 met_by(const Vec3& w, double sign, const Vec3& n) {
    constexpr double least = 1e-9;
    const double cosine = sign * glm::dot(n, w);
    return cosine >= least ? n : glm::normalize(n + w * (sign * (least - cosine)));
}

// `distance` is Embree's float answer; the exact root beside it is found again in double.
void hit_sphere(const Sphere& s, const Vec3& origin, const Vec3& direction, double distance, double error, SurfacePoint& p) {
    const Vec3 f = origin - s.center;
    const double middle = -glm::dot(f, direction);
    const Vec3 nearest = f + direction * middle;
    const double half = std::sqrt(std::max(s.radius * s.radius - glm::dot(nearest, nearest), 0.0));
    const double side = distance < middle ? -1.0 : 1.0;
    const Vec3 n = glm::normalize(f + direction * (middle + side * half));
    put_on_sphere(s, s.center + met_by(direction, side, n), error, p);
}

// Points keep clear of rims as hits of triangles do of edges, so that rounding cannot push them past what meets the rim.
void put_on_disk(const Disk& d, const Vec3& position, double error, SurfacePoint& p) {
    const Vec3 from_center = position - d.center;
    const double uu = glm::dot(d.u, d.u), uv = glm::dot(d.u, d.v), vv = glm::dot(d.v, d.v), gram = uu * vv - uv * uv;
    const double a = glm::dot(from_center, (d.u * vv - d.v * uv) / gram), b = glm::dot(from_center, (d.v * uu - d.u * uv) / gram);
    const double radius = std::sqrt(a * a + b * b);  // 1 at the rim
    const double most = 1.0 - std::min(error * std::sqrt(std::max(uu, vv) / gram), 0.5);
    p.position = radius > most ? d.center + from_center * (most / radius) : position;
    p.normal = d.normal;
    p.error = error;
}

void hit_disk(const Disk& d, const Vec3& origin, const Vec3& direction, double error, SurfacePoint& p) {
    put_on_disk(d, origin + direction * (glm::dot(d.normal, d.center - origin) / glm::dot(d.normal, direction)), error, p);
}

// `across`: of any length, perpendicular to the axis.
void put_on_cylinder(const Cylinder& c, double along, const Vec3& across, double error, SurfacePoint& p) {
    const Vec3 n = glm::normalize(across);
    const double margin = std::min(error, 0.5 * c.length);
    p.position = c.base + c.axis * std::clamp(along, margin, c.length - margin) + n * c.radius;
    p.normal = c.flip_normals ? -n : n;
    p.error = error;
}

// As hit_sphere, across the axis.
void hit_cylinder(const Cylinder& c, const Vec3& origin, const Vec3& direction, double distance, double error, SurfacePoint& p) {
    const Vec3 f = origin - c.base;
    const double d_along = glm::dot(direction, c.axis), f_along = glm::dot(f, c.axis);
    const Vec3 d_across = direction - c.axis * d_along, f_across = f - c.axis * f_along;
    const double a = glm::dot(d_across, d_across), middle = -glm::dot(f_across, d_across) / a;
    const Vec3 nearest = f_across + d_across * middle;
    const double half = std::sqrt(std::max(c.radius * c.radius - glm::dot(nearest, nearest), 0.0) / a);
    const double side = distance < middle ? -1.0 : 1.0, t = middle + side * half;
    const Vec3 n = met_by(d_across / std::sqrt(a), side, glm::normalize(f_across + d_across * t));
    put_on_cylinder(c, f_along + d_along * t, n, error, p);
}

}  // namespace

void Geometry::put_on_round_surface(const Vec3& origin, const Vec3& direction, const RayCaster::Hit& hit, SurfacePoint& p) const {
    if (const auto* sphere = std::get_if<Sphere>(&(*shapes_)[hit.shape]))
        hit_sphere(*sphere, origin, direction, hit.distance, error_[hit.shape], p);
    else if (const auto* cylinder = std::get_if<Cylinder>(&(*shapes_)[hit.shape]))
        hit_cylinder(*cylinder, origin, direction, hit.distance, error_[hit.shape], p);
    else
        hit_disk(std::get<Disk>((*shapes_)[hit.shape]), origin, direction, error_[hit.shape], p);
    p.shape = hit.shape;
    p.primitive = hit.primitive;
}

bool Geometry::first_hit(const Vec3& origin, const Vec3& direction, double distance, SurfacePoint& p) const {
    RayCaster::Hit hit;
    if (!caster_->intersect(origin, direction, distance, hit)) return false;
    put_on_surface(origin, direction, hit, p);
    return true;
}

bool Geometry::first_hit(const SurfacePoint& from, const Vec3& direction, SurfacePoint& hit) const {
    RayCaster::Hit found;
    if (!caster_->intersect(leave(from, glm::dot(from.normal, direction)), direction, std::numeric_limits<double>::infinity(),
                            found))
        return false;
    put_on_surface(from.position, direction, found, hit);
    return true;
}

bool Geometry::visible(const SurfacePoint& x, const SurfacePoint& y) const {
    const Vec3 d = y.position - x.position;
    return !caster_->occluded(leave(x, glm::dot(x.normal, d)), leave(y, -glm::dot(y.normal, d)));
}

std::uint32_t Geometry::primitive_count(std::uint32_t shape) const {
    const auto* mesh = std::get_if<TriangleMesh>(&(*shapes_)[shape]);
    return mesh ? static_cast<std::uint32_t>(mesh->triangles.size()) : 1;
}

double Geometry::area(std::uint32_t shape, std::uint32_t primitive) const {
    if (!triangles_[shape].empty()) return triangles_[shape][primitive].area();
    if (const auto* sphere = std::get_if<Sphere>(&(*shapes_)[shape]))
        return sphere->radius > 0.0 ? 4.0 * pi * sphere->radius * sphere->radius : 0.0;
    if (const auto* cylinder = std::get_if<Cylinder>(&(*shapes_)[shape]))
        return cylinder->has_extent() ? 2.0 * pi * cylinder->radius * cylinder->length : 0.0;
    const Disk& disk = std::get<Disk>((*shapes_)[shape]);
    return pi * glm::length(glm::cross(disk.u, disk.v));
}

double Geometry::area(std::uint32_t shape) const {
    double sum = 0.0;
    for (std::uint32_t i = 0; i < primitive_count(shape); ++i) sum += area(shape, i);
    return sum;
}

SurfacePoint Geometry::point_on_round_surface(std::uint32_t shape, const Vec2& uv) const {
    SurfacePoint p;
    if (const auto* sphere = std::get_if<Sphere>(&(*shapes_)[shape])) {
        put_on_sphere(*sphere, sphere->center + uniform_sphere(uv), error_[shape], p);
    } else if (const auto* cylinder = std::get_if<Cylinder>(&(*shapes_)[shape])) {
        const Vec2 turn = direction_on_circle(uv.y);
        put_on_cylinder(*cylinder, uv.x * cylinder->length, Frame(cylinder->axis).to_world({turn, 0.0}), error_[shape], p);
    } else {
        const Disk& disk = std::get<Disk>((*shapes_)[shape]);
        const Vec2 d = uniform_disk(uv);
        put_on_disk(disk, disk.center + disk.u * d.x + disk.v * d.y, error_[shape], p);
    }
    p.shape = shape;
    return p;
}

Vec2 Geometry::round_coordinates(std::uint32_t shape, const Vec3& position) const {
    if (const auto* sphere = std::get_if<Sphere>(&(*shapes_)[shape])) {
        const Vec3 n = (position - sphere->center) / sphere->radius;
        return {std::clamp(0.5 - 0.5 * n.z, 0.0, 1.0), part_of_circle(n.x, n.y)};
    }
    if (const auto* cylinder = std::get_if<Cylinder>(&(*shapes_)[shape])) {
        const Vec3 p = Frame(cylinder->axis).to_local(position - cylinder->base);
        return {std::clamp(p.z / cylinder->length, 0.0, 1.0), part_of_circle(p.x, p.y)};
    }
    const Disk& disk = std::get<Disk>((*shapes_)[shape]);
    const Vec3 x = position - disk.center;
    const double uu = glm::dot(disk.u, disk.u), uv = glm::dot(disk.u, disk.v), vv = glm::dot(disk.v, disk.v);
    const double xu = glm::dot(x, disk.u), xv = glm::dot(x, disk.v), determinant = uu * vv - uv * uv;
    return square_of_disk({(xu * vv - xv * uv) / determinant, (xv * uu - xu * uv) / determinant});
}

}  // namespace neumann
