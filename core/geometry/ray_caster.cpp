#include "core/geometry/ray_caster.h"

#include "core/base/error.h"
#include "core/geometry/affine.h"
#include "core/geometry/embree_query.h"
#include "core/geometry/embree_rounds.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <map>
#include <span>

namespace neumann {

namespace {

std::atomic<std::uint64_t> built = 0;

constexpr float infinity = std::numeric_limits<float>::infinity();

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
    // The scene of a mesh that has instances, in the coordinates (x − center) · scale.
    struct SharedScene {
        RTCScene scene;
        Vec3 center;
        double scale;
    };

    RTCDevice device = nullptr;
    RTCScene scene = nullptr;
    std::map<const SharedMesh*, SharedScene> shared;
    double distortion = 0.0;  // the largest of any instance
    std::vector<std::unique_ptr<embree::SphereData>> spheres;
    std::vector<std::unique_ptr<embree::DiskData>> disks;
    std::vector<std::unique_ptr<embree::CylinderData>> cylinders;

    ~Impl() {
        if (scene) rtcReleaseScene(scene);
        for (const auto& [mesh, own] : shared) rtcReleaseScene(own.scene);
        if (device) rtcReleaseDevice(device);
    }

    void check(const char* what) const {
        const RTCError code = rtcGetDeviceError(device);
        if (code == RTC_ERROR_OUT_OF_MEMORY) throw RunError(std::string("not enough memory while ") + what);
        if (code != RTC_ERROR_NONE) throw RunError("Embree error " + std::to_string(code) + " while " + what);
    }

    RTCScene new_scene() const {
        RTCScene made = rtcNewScene(device);
        // In robust mode no ray passes between two triangles that share an edge.
        rtcSetSceneFlags(made, static_cast<RTCSceneFlags>(RTC_SCENE_FLAG_ROBUST | embree::filters_allowed));
        return made;
    }

    template <class Data>
    void attach_user(Data* data, std::uint32_t id) {
        RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_USER);
        rtcSetGeometryUserPrimitiveCount(geometry, 1);
        rtcSetGeometryUserData(geometry, data);
        rtcSetGeometryBoundsFunction(geometry, embree::bounds_callback<Data>, nullptr);
        rtcSetGeometryIntersectFunction(geometry, embree::intersect_callback<Data>);
        rtcSetGeometryOccludedFunction(geometry, embree::occluded_callback<Data>);
        attach(geometry, id);
    }

    void attach(RTCGeometry geometry, std::uint32_t id) { attach(scene, geometry, id); }
    static void attach(RTCScene to, RTCGeometry geometry, std::uint32_t id) {
        rtcCommitGeometry(geometry);
        rtcAttachGeometryByID(to, geometry, id);
        rtcReleaseGeometry(geometry);
    }

    void attach_mesh(const TriangleMesh& mesh, std::uint32_t id, std::span<const Face> without, const RayCaster& caster) {
        if (mesh.triangles.empty() || without.size() == mesh.triangles.size()) return;
        attach(make_mesh(mesh, id, without, [&](const Vec3& p) { return caster.to_embree(p); }), id);
    }

    template <class ToEmbree>
    RTCGeometry make_mesh(const TriangleMesh& mesh, std::uint32_t id, std::span<const Face> without,
                          const ToEmbree& to_embree) const {
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
            const Vec3 p = to_embree(world);
            for (int axis = 0; axis < 3; ++axis) *vertices++ = static_cast<float>(p[axis]);
        }
        return geometry;
    }

    const SharedScene& scene_of(const SharedMesh& mesh) {
        const auto [entry, is_new] = shared.try_emplace(&mesh);
        SharedScene& own = entry->second;
        if (!is_new) return own;
        const Bounds& bounds = mesh.bounds();
        own = {new_scene(), bounds.center(), scale_to_one(bounds)};
        attach(own.scene, make_mesh(mesh.mesh(), 0, {}, [&](const Vec3& p) { return (p - own.center) * own.scale; }), 0);
        rtcCommitScene(own.scene);
        check("building the scene");
        return own;
    }

    void attach_instance(const MeshInstance& instance, std::uint32_t id, const RayCaster& caster) {
        const SharedScene& of_mesh = scene_of(*instance.shared());
        const Mat4& m = instance.to_world();
        const glm::dmat3 linear = glm::dmat3(m) * (caster.scale_ / of_mesh.scale);
        const Vec3 center = caster.to_embree(transformed_point(m, of_mesh.center));
        float columns[12];
        for (int axis = 0; axis < 3; ++axis) {
            for (int column = 0; column < 3; ++column) columns[3 * column + axis] = static_cast<float>(linear[column][axis]);
            columns[9 + axis] = static_cast<float>(center[axis]);
        }
        RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_INSTANCE);
        rtcSetGeometryInstancedScene(geometry, of_mesh.scene);
        rtcSetGeometryTransform(geometry, 0, RTC_FORMAT_FLOAT3X4_COLUMN_MAJOR, columns);
        distortion = std::max(distortion, instance.distortion());
        attach(geometry, id);
    }

    void attach_sphere(const Sphere& sphere, std::uint32_t id, const RayCaster& caster) {
        const Vec3 center = caster.to_embree(sphere.center);
        const double radius = sphere.radius * caster.scale_;
        spheres.push_back(
            std::make_unique<embree::SphereData>(embree::SphereData{center, radius, embree::outward_bounds(center, Vec3(radius))}));
        attach_user(spheres.back().get(), id);
    }

    void attach_disk(const Disk& disk, std::uint32_t id, const RayCaster& caster) {
        const Vec3 center = caster.to_embree(disk.center), u = disk.u * caster.scale_, v = disk.v * caster.scale_;
        const double uu = glm::dot(u, u), uv = glm::dot(u, v), vv = glm::dot(v, v), gram = uu * vv - uv * uv;
        const Vec3 extent(std::hypot(u.x, v.x), std::hypot(u.y, v.y), std::hypot(u.z, v.z));
        disks.push_back(std::make_unique<embree::DiskData>(embree::DiskData{
            center, disk.normal, (u * vv - v * uv) / gram, (v * uu - u * uv) / gram, embree::outward_bounds(center, extent)}));
        attach_user(disks.back().get(), id);
    }

    void attach_cylinder(const Cylinder& cylinder, std::uint32_t id, const RayCaster& caster) {
        const RTCBounds bounds = embree::outward_bounds(caster.to_embree(cylinder.center()), cylinder.extent() * caster.scale_);
        cylinders.push_back(std::make_unique<embree::CylinderData>(
            embree::CylinderData{caster.to_embree(cylinder.base), cylinder.axis, cylinder.length * caster.scale_,
                                 cylinder.radius * caster.scale_, bounds}));
        attach_user(cylinders.back().get(), id);
    }
};

RayCaster::RayCaster(const std::vector<Shape>& shapes, std::span<const Face> without, const Vec3& center, double scale)
    : center_(center), scale_(scale), impl_(std::make_unique<Impl>()) {
    impl_->device = rtcNewDevice(nullptr);
    if (!impl_->device) throw RunError("Embree could not be started");
    impl_->scene = impl_->new_scene();
    for (std::uint32_t id = 0; id < shapes.size(); ++id) {
        const auto begin = std::lower_bound(without.begin(), without.end(), Face{id, 0});
        const std::span<const Face> of_shape(begin, std::lower_bound(begin, without.end(), Face{id + 1, 0}));
        if (const auto* mesh = std::get_if<TriangleMesh>(&shapes[id])) {
            impl_->attach_mesh(*mesh, id, of_shape, *this);
            continue;
        }
        if (!has_extent(shapes[id]) || !of_shape.empty()) continue;
        if (const auto* instance = std::get_if<MeshInstance>(&shapes[id])) impl_->attach_instance(*instance, id, *this);
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
    embree::trace(impl_->scene, query, embree::Query(without));
    if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) return false;
    hit = {embree::shape_of(query.hit.instID[0], query.hit.geomID), query.hit.primID, query.hit.u, query.hit.v,
           query.ray.tfar / scale_};
    return true;
}

bool RayCaster::occluded(const Vec3& from, const Vec3& to) const { return occluded(from, to, {}); }

bool RayCaster::occluded(const Vec3& from, const Vec3& to, std::span<const Face> without) const {
    const Vec3 org = to_embree(from);
    RTCRay ray;
    set_ray(ray, org, to_embree(to) - org, 1.0f);
    embree::trace(impl_->scene, ray, embree::Query(without));
    return ray.tfar < 0.0f;
}

void RayCaster::append_between(const Vec3& from, const Vec3& to, std::span<const Face> without, std::size_t most,
                               std::vector<Face>& found) const {
    if (found.size() >= most) return;
    const Vec3 org = to_embree(from);
    RTCRay ray;
    set_ray(ray, org, to_embree(to) - org, 1.0f);
    embree::Query query(without);
    query.passed = &found;
    query.most = most;
    embree::trace(impl_->scene, ray, query);
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
    embree::trace(Valid(packet.size_).lanes, impl_->scene, queries, kind);
    std::uint32_t found = 0;
    for (std::size_t i = 0; i < packet.size_; ++i) {
        if (queries.hit.geomID[i] == RTC_INVALID_GEOMETRY_ID) continue;
        found |= 1u << i;
        hits[i] = {embree::shape_of(queries.hit.instID[0][i], queries.hit.geomID[i]), queries.hit.primID[i], queries.hit.u[i],
                   queries.hit.v[i], queries.ray.tfar[i] / scale_};
    }
    return found;
}

std::uint32_t RayCaster::occluded(const Packet& packet, Rays kind) const {
    RTCRay8 rays;
    set_rays(packet, rays);
    embree::trace(Valid(packet.size_).lanes, impl_->scene, rays, kind);
    std::uint32_t found = 0;
    for (std::size_t i = 0; i < packet.size_; ++i) found |= static_cast<std::uint32_t>(rays.tfar[i] < 0.0f) << i;
    return found;
}

bool RayCaster::any_near(const Vec3& p, double distance, bool (*test)(const void*, const Face&), const void* wanted) const {
    const Vec3 at = to_embree(p);
    // The radius covers the rounding of the boxes, of p to float, and of p in the coordinates of an instance.
    const double radius = distance * scale_ + 0x1p-22 * (1.0 + distance * scale_) * (1.0 + impl_->distortion);
    RTCPointQuery query{static_cast<float>(at.x), static_cast<float>(at.y), static_cast<float>(at.z), 0.0f,
                        std::nextafter(static_cast<float>(radius), infinity)};
    RTCPointQueryContext context;
    rtcInitPointQueryContext(&context);
    struct Search {
        bool (*test)(const void*, const Face&);
        const void* wanted;
        bool found;
    } search{test, wanted, false};
    rtcPointQuery(
        impl_->scene, &query, &context,
        [](RTCPointQueryFunctionArguments* args) {
            auto& now = *static_cast<Search*>(args->userPtr);
            if (now.found) return false;
            const RTCPointQueryContext& query_context = *args->context;
            const std::uint32_t shape = query_context.instStackSize > 0 ? query_context.instID[0] : args->geomID;
            now.found = now.test(now.wanted, {shape, args->primID});
            // Once found, a sphere of radius 0 makes Embree visit no more boxes than those that hold the point.
            if (now.found) args->query->radius = 0.0f;
            return now.found;
        },
        &search);
    return search.found;
}

RTCSceneTy* RayCaster::embree_scene() const { return impl_->scene; }

std::uint64_t trees_built() { return built; }
const char* embree_version() { return "Embree " RTC_VERSION_STRING; }

}  // namespace neumann
