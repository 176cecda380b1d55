#include "core/geometry/ray_caster.h"

#include "core/base/error.h"

#if __has_include(<embree4/rtcore.h>)
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <span>

namespace neumann {

namespace {

std::atomic<std::uint64_t> built = 0;

constexpr float infinity = std::numeric_limits<float>::infinity();

Vec3 origin(const RTCRay& ray) { return {ray.org_x, ray.org_y, ray.org_z}; }
Vec3 direction(const RTCRay& ray) { return {ray.dir_x, ray.dir_y, ray.dir_z}; }

// The query context, with Embree's part first: the faces to skip, sorted.
#if RTC_VERSION_MAJOR >= 4
using EmbreeContext = RTCRayQueryContext;
void init(EmbreeContext& context) { rtcInitRayQueryContext(&context); }
#else
using EmbreeContext = RTCIntersectContext;
void init(EmbreeContext& context) { rtcInitIntersectContext(&context); }
#endif
struct Query : EmbreeContext {
    std::span<const Face> without;

    explicit Query(std::span<const Face> faces = {}) : without(faces) { init(*this); }
    bool leaves_out(std::uint32_t shape, std::uint32_t primitive) const {
        return !without.empty() && std::binary_search(without.begin(), without.end(), Face{shape, primitive});
    }
};

void filter(const RTCFilterFunctionNArguments* args) {
    const auto* query = static_cast<const Query*>(args->context);
    for (unsigned i = 0; i < args->N; ++i)
        if (args->valid[i] && query->leaves_out(RTCHitN_geomID(args->hit, args->N, i), RTCHitN_primID(args->hit, args->N, i)))
            args->valid[i] = 0;
}

struct SphereData {
    Vec3 center;
    double radius;
    RTCBounds bounds;

    // Smallest root in (tnear, tfar), or NaN. The half chord is computed from the distance of the centre to the line, which stays
    // accurate for rays that start on the sphere.
    double intersect(const RTCRay& ray) const {
        const Vec3 d = direction(ray), f = origin(ray) - center;
        const double a = glm::dot(d, d), middle = -glm::dot(f, d) / a;
        const Vec3 nearest = f + d * middle;
        const double discriminant = radius * radius - glm::dot(nearest, nearest);
        if (!(discriminant >= 0.0)) return std::nan("");
        const double half = std::sqrt(discriminant / a);
        for (const double t : {middle - half, middle + half})
            if (t > ray.tnear && t < ray.tfar) return t;
        return std::nan("");
    }
};

struct DiskData {
    Vec3 center, normal, dual_u, dual_v;
    RTCBounds bounds;

    double intersect(const RTCRay& ray) const {
        const Vec3 d = direction(ray), f = center - origin(ray);
        const double t = glm::dot(normal, f) / glm::dot(normal, d);
        if (!(t > ray.tnear && t < ray.tfar)) return std::nan("");
        const Vec3 p = d * t - f;
        const double a = glm::dot(p, dual_u), b = glm::dot(p, dual_v);
        return a * a + b * b <= 1.0 ? t : std::nan("");
    }
};

struct CylinderData {
    Vec3 base, axis;
    double length, radius;
    RTCBounds bounds;

    // As for the sphere, perpendicular to the axis; only roots between the two ends count.
    double intersect(const RTCRay& ray) const {
        const Vec3 d = direction(ray), f = origin(ray) - base;
        const double d_along = glm::dot(d, axis), f_along = glm::dot(f, axis);
        const Vec3 d_across = d - axis * d_along, f_across = f - axis * f_along;
        const double a = glm::dot(d_across, d_across), middle = -glm::dot(f_across, d_across) / a;
        const Vec3 nearest = f_across + d_across * middle;
        const double discriminant = radius * radius - glm::dot(nearest, nearest);
        if (!(discriminant >= 0.0)) return std::nan("");
        const double half = std::sqrt(discriminant / a);
        for (const double t : {middle - half, middle + half}) {
            const double along = f_along + t * d_along;
            if (t > ray.tnear && t < ray.tfar && along >= 0.0 && along <= length) return t;
        }
        return std::nan("");
    }
};

// The float box around center ± extent, rounded outwards.
RTCBounds outward_bounds(const Vec3& center, const Vec3& extent) {
    const auto down = [](double x) { return std::nextafter(static_cast<float>(x), -infinity); };
    const auto up = [](double x) { return std::nextafter(static_cast<float>(x), infinity); };
    const Vec3 low = center - extent, high = center + extent;
    return {down(low.x), down(low.y), down(low.z), 0.0f, up(high.x), up(high.y), up(high.z), 0.0f};
}

template <class Data>
void bounds_callback(const RTCBoundsFunctionArguments* args) {
    *args->bounds_o = static_cast<const Data*>(args->geometryUserPtr)->bounds;
}

template <class Data>
void intersect_callback(const RTCIntersectFunctionNArguments* args) {
    if (static_cast<const Query*>(args->context)->leaves_out(args->geomID, args->primID)) return;
    const unsigned N = args->N;
    RTCRayN* rays = RTCRayHitN_RayN(args->rayhit, N);
    RTCHitN* hits = RTCRayHitN_HitN(args->rayhit, N);
    for (unsigned i = 0; i < N; ++i) {
        if (!args->valid[i]) continue;
        const double t = static_cast<const Data*>(args->geometryUserPtr)->intersect(rtcGetRayFromRayN(rays, N, i));
        if (std::isnan(t)) continue;
        RTCRayN_tfar(rays, N, i) = static_cast<float>(t);
        RTCHitN_geomID(hits, N, i) = args->geomID;
        RTCHitN_primID(hits, N, i) = args->primID;
        RTCHitN_instID(hits, N, i, 0) = RTC_INVALID_GEOMETRY_ID;
    }
}

template <class Data>
void occluded_callback(const RTCOccludedFunctionNArguments* args) {
    if (static_cast<const Query*>(args->context)->leaves_out(args->geomID, args->primID)) return;
    const unsigned N = args->N;
    for (unsigned i = 0; i < N; ++i)
        if (args->valid[i] &&
            !std::isnan(static_cast<const Data*>(args->geometryUserPtr)->intersect(rtcGetRayFromRayN(args->ray, N, i))))
            RTCRayN_tfar(args->ray, N, i) = -infinity;
}

#if RTC_VERSION_MAJOR >= 4
constexpr RTCSceneFlags filters_allowed = RTC_SCENE_FLAG_FILTER_FUNCTION_IN_ARGUMENTS;
template <class Arguments>
void ask(Query& query, RayCaster::Rays kind, Arguments& arguments) {
    arguments.context = &query;
    arguments.flags = kind == RayCaster::Rays::alike ? RTC_RAY_QUERY_FLAG_COHERENT : RTC_RAY_QUERY_FLAG_INCOHERENT;
    if (query.without.empty()) return;
    arguments.filter = filter;
    arguments.flags = static_cast<RTCRayQueryFlags>(arguments.flags | RTC_RAY_QUERY_FLAG_INVOKE_ARGUMENT_FILTER);
}
RTCIntersectArguments to_intersect(Query& query, RayCaster::Rays kind) {
    RTCIntersectArguments arguments;
    rtcInitIntersectArguments(&arguments);
    ask(query, kind, arguments);
    return arguments;
}
RTCOccludedArguments to_occlude(Query& query, RayCaster::Rays kind) {
    RTCOccludedArguments arguments;
    rtcInitOccludedArguments(&arguments);
    ask(query, kind, arguments);
    return arguments;
}
void trace(RTCScene scene, RTCRayHit& ray, Query query) {
    auto arguments = to_intersect(query, RayCaster::Rays::any);
    rtcIntersect1(scene, &ray, &arguments);
}
void trace(RTCScene scene, RTCRay& ray, Query query) {
    auto arguments = to_occlude(query, RayCaster::Rays::any);
    rtcOccluded1(scene, &ray, &arguments);
}
void trace(const int* valid, RTCScene scene, RTCRayHit8& rays, RayCaster::Rays kind) {
    Query query;
    auto arguments = to_intersect(query, kind);
    rtcIntersect8(valid, scene, &rays, &arguments);
}
void trace(const int* valid, RTCScene scene, RTCRay8& rays, RayCaster::Rays kind) {
    Query query;
    auto arguments = to_occlude(query, kind);
    rtcOccluded8(valid, scene, &rays, &arguments);
}
#else
constexpr RTCSceneFlags filters_allowed = RTC_SCENE_FLAG_CONTEXT_FILTER_FUNCTION;
Query& prepared(Query& query, RayCaster::Rays kind = RayCaster::Rays::any) {
    if (kind == RayCaster::Rays::alike) query.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
    if (!query.without.empty()) query.filter = filter;
    return query;
}
void trace(RTCScene scene, RTCRayHit& ray, Query query) { rtcIntersect1(scene, &prepared(query), &ray); }
void trace(RTCScene scene, RTCRay& ray, Query query) { rtcOccluded1(scene, &prepared(query), &ray); }
void trace(const int* valid, RTCScene scene, RTCRayHit8& rays, RayCaster::Rays kind) {
    Query query;
    rtcIntersect8(valid, scene, &prepared(query, kind), &rays);
}
void trace(const int* valid, RTCScene scene, RTCRay8& rays, RayCaster::Rays kind) {
    Query query;
    rtcOccluded8(valid, scene, &prepared(query, kind), &rays);
}
#endif

void set_ray(RTCRay& ray, const Vec3& org, const Vec3& dir, float tfar) {
    ray.org_x = static_cast<float>(org.x);
    ray.org_y = static_cast<float>(org.y);
    ray.org_z = static_cast<float>(org.z);
    ray.dir_x = static_cast<float>(dir.x);
    ray.dir_y = static_cast<float>(dir.y);
    ray.dir_z = static_cast<float>(dir.z);
    ray.tnear = 0.0f;
    ray.tfar = tfar;
    ray.time = 0.0f;
    ray.mask = ~0u;
    ray.flags = 0;
}

template <std::size_t N>
void copy(const float (&from)[N], float* to) {
    std::copy(from, from + N, to);
}

// Embree's mask of valid rays: n of 8 lanes are used.
struct Valid {
    explicit Valid(std::size_t n) {
        for (std::size_t i = 0; i < 8; ++i) lanes[i] = i < n ? -1 : 0;
    }
    alignas(32) int lanes[8];
};

}  // namespace

struct RayCaster::Impl {
    RTCDevice device = nullptr;
    RTCScene scene = nullptr;
    std::vector<std::unique_ptr<SphereData>> spheres;
    std::vector<std::unique_ptr<DiskData>> disks;
    std::vector<std::unique_ptr<CylinderData>> cylinders;

    ~Impl() {
        if (scene) rtcReleaseScene(scene);
        if (device) rtcReleaseDevice(device);
    }

    void check(const char* what) const {
        const RTCError code = rtcGetDeviceError(device);
        if (code == RTC_ERROR_OUT_OF_MEMORY) throw RunError(std::string("not enough memory while ") + what);
        if (code != RTC_ERROR_NONE) throw RunError("Embree error " + std::to_string(code) + " while " + what);
    }

    template <class Data>
    void attach_user(Data* data, std::uint32_t id) {
        RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_USER);
        rtcSetGeometryUserPrimitiveCount(geometry, 1);
        rtcSetGeometryUserData(geometry, data);
        rtcSetGeometryBoundsFunction(geometry, bounds_callback<Data>, nullptr);
        rtcSetGeometryIntersectFunction(geometry, intersect_callback<Data>);
        rtcSetGeometryOccludedFunction(geometry, occluded_callback<Data>);
        attach(geometry, id);
    }

    void attach(RTCGeometry geometry, std::uint32_t id) {
        rtcCommitGeometry(geometry);
        rtcAttachGeometryByID(scene, geometry, id);
        rtcReleaseGeometry(geometry);
    }

    void attach_mesh(const TriangleMesh& mesh, std::uint32_t id, std::span<const Face> without, const RayCaster& caster) {
        if (mesh.triangles.empty() || without.size() == mesh.triangles.size()) return;
        RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
        auto* vertices = static_cast<float*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                                                     3 * sizeof(float), mesh.vertices.size()));
        constexpr std::size_t triangle_size = sizeof(mesh.triangles.front());
        if (without.empty()) {
            rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, mesh.triangles.data(), 0,
                                       triangle_size, mesh.triangles.size());
        } else {
            // Removed triangles keep their number, so that the others' numbers do not change.
            auto* triangles = static_cast<std::array<std::uint32_t, 3>*>(rtcSetNewGeometryBuffer(
                geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, triangle_size, mesh.triangles.size()));
            std::copy(mesh.triangles.begin(), mesh.triangles.end(), triangles);
            const auto kept = std::find_if(mesh.triangles.begin(), mesh.triangles.end(), [&](const auto& t) {
                const auto number = static_cast<std::uint32_t>(&t - mesh.triangles.data());
                return !std::binary_search(without.begin(), without.end(), Face{id, number});
            });
            for (const Face& face : without) triangles[face.primitive].fill((*kept)[0]);
        }
        check("building the scene");
        for (const Vec3& world : mesh.vertices) {
            const Vec3 p = caster.to_embree(world);
            for (int axis = 0; axis < 3; ++axis) *vertices++ = static_cast<float>(p[axis]);
        }
        attach(geometry, id);
    }

    void attach_sphere(const Sphere& sphere, std::uint32_t id, const RayCaster& caster) {
        const Vec3 center = caster.to_embree(sphere.center);
        const double radius = sphere.radius * caster.scale_;
        spheres.push_back(std::make_unique<SphereData>(SphereData{center, radius, outward_bounds(center, Vec3(radius))}));
        attach_user(spheres.back().get(), id);
    }

    void attach_disk(const Disk& disk, std::uint32_t id, const RayCaster& caster) {
        const Vec3 center = caster.to_embree(disk.center), u = disk.u * caster.scale_, v = disk.v * caster.scale_;
        const double uu = glm::dot(u, u), uv = glm::dot(u, v), vv = glm::dot(v, v), gram = uu * vv - uv * uv;
        const Vec3 extent(std::hypot(u.x, v.x), std::hypot(u.y, v.y), std::hypot(u.z, v.z));
        disks.push_back(std::make_unique<DiskData>(
            DiskData{center, disk.normal, (u * vv - v * uv) / gram, (v * uu - u * uv) / gram, outward_bounds(center, extent)}));
        attach_user(disks.back().get(), id);
    }

    void attach_cylinder(const Cylinder& cylinder, std::uint32_t id, const RayCaster& caster) {
        const RTCBounds bounds = outward_bounds(caster.to_embree(cylinder.center()), cylinder.extent() * caster.scale_);
        cylinders.push_back(
            std::make_unique<CylinderData>(CylinderData{caster.to_embree(cylinder.base), cylinder.axis,
                                                        cylinder.length * caster.scale_, cylinder.radius * caster.scale_, bounds}));
        attach_user(cylinders.back().get(), id);
    }
};

RayCaster::RayCaster(const std::vector<Shape>& shapes, std::span<const Face> without, const Vec3& center, double scale)
    : center_(center), scale_(scale), impl_(std::make_unique<Impl>()) {
    impl_->device = rtcNewDevice(nullptr);
    if (!impl_->device) throw RunError("Embree could not be started");
    impl_->scene = rtcNewScene(impl_->device);
    // In robust mode no ray passes between two triangles that share an edge.
    rtcSetSceneFlags(impl_->scene, static_cast<RTCSceneFlags>(RTC_SCENE_FLAG_ROBUST | filters_allowed));
    for (std::uint32_t id = 0; id < shapes.size(); ++id) {
        const auto begin = std::lower_bound(without.begin(), without.end(), Face{id, 0});
        const std::span<const Face> of_shape(begin, std::lower_bound(begin, without.end(), Face{id + 1, 0}));
        if (const auto* mesh = std::get_if<TriangleMesh>(&shapes[id])) {
            impl_->attach_mesh(*mesh, id, of_shape, *this);
            continue;
        }
        if (!has_extent(shapes[id]) || !of_shape.empty()) continue;
        if (const auto* sphere = std::get_if<Sphere>(&shapes[id])) impl_->attach_sphere(*sphere, id, *this);
        if (const auto* disk = std::get_if<Disk>(&shapes[id])) impl_->attach_disk(*disk, id, *this);
        if (const auto* cylinder = std::get_if<Cylinder>(&shapes[id])) impl_->attach_cylinder(*cylinder, id, *this);
    }
    rtcCommitScene(impl_->scene);
    impl_->check("building the scene");
    ++built;
}

RayCaster::~RayCaster() = default;

bool RayCaster::intersect(const Vec3& origin, const Vec3& direction, double distance, Hit& hit) const {
    return intersect(origin, direction, distance, {}, hit);
}

bool RayCaster::intersect(const Vec3& origin, const Vec3& direction, double distance, std::span<const Face> without,
                          Hit& hit) const {
    RTCRayHit query;
    set_ray(query.ray, to_embree(origin), direction, static_cast<float>(distance * scale_));
    query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
    trace(impl_->scene, query, Query(without));
    if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) return false;
    hit = {query.hit.geomID, query.hit.primID, query.hit.u, query.hit.v, query.ray.tfar / scale_};
    return true;
}

bool RayCaster::occluded(const Vec3& from, const Vec3& to) const { return occluded(from, to, {}); }

bool RayCaster::occluded(const Vec3& from, const Vec3& to, std::span<const Face> without) const {
    const Vec3 org = to_embree(from);
    RTCRay ray;
    set_ray(ray, org, to_embree(to) - org, 1.0f);
    trace(impl_->scene, ray, Query(without));
    return ray.tfar < 0.0f;
}

void RayCaster::set_rays(const Packet& packet, RTCRay8& rays) {
    copy(packet.origin_[0], rays.org_x);
    copy(packet.origin_[1], rays.org_y);
    copy(packet.origin_[2], rays.org_z);
    copy(packet.direction_[0], rays.dir_x);
    copy(packet.direction_[1], rays.dir_y);
    copy(packet.direction_[2], rays.dir_z);
    copy(packet.length_, rays.tfar);
    std::fill_n(rays.tnear, 8, 0.0f);
    std::fill_n(rays.time, 8, 0.0f);
    std::fill_n(rays.mask, 8, ~0u);
    std::fill_n(rays.flags, 8, 0u);
}

std::uint32_t RayCaster::intersect(const Packet& packet, std::span<Hit> hits, Rays kind) const {
    RTCRayHit8 queries;
    set_rays(packet, queries.ray);
    std::fill_n(queries.hit.geomID, 8, RTC_INVALID_GEOMETRY_ID);
    std::fill_n(queries.hit.instID[0], 8, RTC_INVALID_GEOMETRY_ID);
    trace(Valid(packet.size_).lanes, impl_->scene, queries, kind);
    std::uint32_t found = 0;
    for (std::size_t i = 0; i < packet.size_; ++i) {
        if (queries.hit.geomID[i] == RTC_INVALID_GEOMETRY_ID) continue;
        found |= 1u << i;
        hits[i] = {queries.hit.geomID[i], queries.hit.primID[i], queries.hit.u[i], queries.hit.v[i], queries.ray.tfar[i] / scale_};
    }
    return found;
}

std::uint32_t RayCaster::occluded(const Packet& packet, Rays kind) const {
    RTCRay8 rays;
    set_rays(packet, rays);
    trace(Valid(packet.size_).lanes, impl_->scene, rays, kind);
    std::uint32_t found = 0;
    for (std::size_t i = 0; i < packet.size_; ++i) found |= static_cast<std::uint32_t>(rays.tfar[i] < 0.0f) << i;
    return found;
}

void RayCaster::near(const Vec3& p, double distance, std::vector<Face>& found) const {
    const Vec3 at = to_embree(p);
    // The radius covers the rounding of the boxes and of p to float.
    const double radius = distance * scale_ + 0x1p-22 * (1.0 + distance * scale_);
    RTCPointQuery query{static_cast<float>(at.x), static_cast<float>(at.y), static_cast<float>(at.z), 0.0f,
                        std::nextafter(static_cast<float>(radius), infinity)};
    RTCPointQueryContext context;
    rtcInitPointQueryContext(&context);
    rtcPointQuery(
        impl_->scene, &query, &context,
        [](RTCPointQueryFunctionArguments* args) {
            static_cast<std::vector<Face>*>(args->userPtr)->push_back({args->geomID, args->primID});
            return false;
        },
        &found);
}

RTCSceneTy* RayCaster::embree_scene() const { return impl_->scene; }

std::uint64_t trees_built() { return built; }
const char* embree_version() { return "Embree " RTC_VERSION_STRING; }

}  // namespace neumann
