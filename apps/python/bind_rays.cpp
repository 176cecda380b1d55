// Rays, visibility and light samples for arrays of points, for estimators written in Python.
#include "apps/python/arrays.h"
#include "apps/python/module.h"
#include "core/base/error.h"
#include "operators/experiments/queries/ray_queries.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace neumann {

namespace {

// Rows of numbers, (n, 2) or (n, 3). Throws InputError, with the name of the argument.
template <class Row>
std::vector<Row> rows_of(const py::object& given, const char* name) {
    constexpr py::ssize_t width = Row::length();
    const py::array array = py::array::ensure(given);
    if (!array || std::string("fiu").find(array.dtype().kind()) == std::string::npos)
        throw InputError(fmt::format("{}: {}, expected numbers, an array (n, {})", name,
                                     array ? "an array of " + py::str(array.dtype()).cast<std::string>() : "no array", width));
    if (array.ndim() != 2 || array.shape(1) != width)
        throw InputError(fmt::format("{}: an array of shape {}, expected (n, {})", name,
                                     py::str(py::object(array.attr("shape"))).cast<std::string>(), width));
    const auto numbers = py::array_t<double, py::array::c_style | py::array::forcecast>(array);
    std::vector<Row> rows(static_cast<std::size_t>(array.shape(0)));
    const double* from = numbers.data();
    for (std::size_t i = 0; i < rows.size(); ++i)
        for (int axis = 0; axis < static_cast<int>(width); ++axis) {
            rows[i][axis] = *from++;
            if (!std::isfinite(rows[i][axis])) throw InputError(fmt::format("{}: row {} is not finite", name, i));
        }
    return rows;
}

void expect_rows(std::size_t given, std::size_t expected, const char* name, const char* of) {
    if (given != expected) throw InputError(fmt::format("{}: {} rows, expected {}, as of {}", name, given, expected, of));
}

// The directions, normalised.
std::vector<Vec3> directions_of(const py::object& given, std::size_t expected) {
    std::vector<Vec3> directions = rows_of<Vec3>(given, "direction");
    expect_rows(directions.size(), expected, "direction", "origin");
    for (std::size_t i = 0; i < directions.size(); ++i) {
        const double length = length_of(directions[i]);
        if (length == 0.0) throw InputError(fmt::format("direction: row {} is zero", i));
        directions[i] /= length;
    }
    return directions;
}

struct SeenPoints {
    std::shared_ptr<const LoadedScene> scene;
    std::vector<SeenPoint> all;
};
struct LightPoints {
    std::shared_ptr<const LoadedScene> scene;
    std::vector<LightPoint> all;
};

const SurfacePoint& on_surface(const SeenPoint& seen) { return seen.y; }
const SurfacePoint& on_surface(const LightPoint& light) { return light.point; }

// Start or end points of rays, which must belong to this scene. Throws InputError, with the name of the argument.
template <class Points>
std::vector<SurfacePoint> surface_points(const LoadedScene& scene, const Points& points, const char* name) {
    if (points.scene.get() != &scene) throw InputError(fmt::format("{}: points of another scene", name));
    std::vector<SurfacePoint> found;
    found.reserve(points.all.size());
    for (const auto& point : points.all) {
        found.push_back(on_surface(point));
        if (!is_finite(found.back().position))
            throw InputError(
                fmt::format("{}: row {} is a ray that has hit nothing; points[points.hit] are the others", name, found.size() - 1));
    }
    return found;
}
// The same, or an array (n, 3) of points in space.
std::vector<SurfacePoint> points_of(const LoadedScene& scene, const py::object& given, const char* name) {
    if (py::isinstance<SeenPoints>(given)) return surface_points(scene, given.cast<const SeenPoints&>(), name);
    if (py::isinstance<LightPoints>(given)) return surface_points(scene, given.cast<const LightPoints&>(), name);
    std::vector<SurfacePoint> found;
    for (const Vec3& position : rows_of<Vec3>(given, name))
        found.push_back({.position = position, .normal = Vec3(0.0), .shape = SurfacePoint::infinity});
    return found;
}

// Rays from points in space. Throws InputError.
std::vector<Ray> rays_of(const py::object& origin, const py::object& direction, const py::object& length) {
    const std::vector<Vec3> origins = rows_of<Vec3>(origin, "origin"), directions = directions_of(direction, origins.size());
    std::vector<Ray> rays(origins.size());
    for (std::size_t i = 0; i < rays.size(); ++i) rays[i] = {origins[i], directions[i]};
    if (!length.is_none()) {
        const auto lengths = py::array_t<double, py::array::c_style | py::array::forcecast>::ensure(length);
        if (!lengths || lengths.ndim() != 1) throw InputError("length: expected numbers, an array (n,)");
        expect_rows(static_cast<std::size_t>(lengths.shape(0)), rays.size(), "length", "origin");
        for (std::size_t i = 0; i < rays.size(); ++i) {
            rays[i].length = lengths.data()[i];
            if (!(rays[i].length > 0.0))
                throw InputError(fmt::format("length: row {} is {}, expected more than 0", i, rays[i].length));
        }
    }
    return rays;
}

SeenPoints intersect(const std::shared_ptr<LoadedScene>& scene, const py::object& origin, const py::object& direction,
                     const py::object& length) {
    if (py::isinstance<SeenPoints>(origin) || py::isinstance<LightPoints>(origin)) {
        if (!length.is_none()) throw InputError("length: expected with origins in space, and not with points on surfaces");
        const std::vector<SurfacePoint> from = points_of(*scene, origin, "origin");
        const std::vector<Vec3> directions = directions_of(direction, from.size());
        const py::gil_scoped_release without_lock;
        return {scene, see(*scene->scene, from, directions)};
    }
    const std::vector<Ray> rays = rays_of(origin, direction, length);
    const py::gil_scoped_release without_lock;
    return {scene, see(*scene->scene, rays)};
}

SeenPoints seen_by_camera(const std::shared_ptr<LoadedScene>& scene, const py::object& origin, const py::object& direction,
                          const py::object& length) {
    const std::vector<Ray> rays = rays_of(origin, direction, length);
    const py::gil_scoped_release without_lock;
    return {scene, see_from_camera(*scene->scene, rays)};
}

py::array_t<bool> sees(const LoadedScene& scene, const py::object& a, const py::object& b) {
    const std::vector<SurfacePoint> x = points_of(scene, a, "a"), y = points_of(scene, b, "b");
    expect_rows(y.size(), x.size(), "b", "a");
    std::vector<char> found;
    {
        const py::gil_scoped_release without_lock;
        found = visible(*scene.scene, x, y);
    }
    py::array_t<bool> array(static_cast<py::ssize_t>(found.size()));
    std::transform(found.begin(), found.end(), array.mutable_data(), [](char seen) { return seen != 0; });
    return array;
}

LightPoints samples_of_lights(const std::shared_ptr<LoadedScene>& scene, const py::object& points, const py::object& random) {
    const std::vector<SurfacePoint> x = points_of(*scene, points, "points");
    const std::vector<Vec2> u = rows_of<Vec2>(random, "u");
    expect_rows(u.size(), x.size(), "u", "points");
    for (std::size_t i = 0; i < u.size(); ++i)
        if (!(u[i].x >= 0.0 && u[i].x < 1.0 && u[i].y >= 0.0 && u[i].y < 1.0))
            throw InputError(fmt::format("u: row {} is ({}, {}), expected numbers from 0 to below 1", i, u[i].x, u[i].y));
    const py::gil_scoped_release without_lock;
    return {scene, sample_lights(*scene->scene, x, u)};
}

py::dict rays_of_camera(const LoadedScene& scene, std::int64_t samples, std::int64_t first, std::uint64_t seed) {
    const Film& film = scene.scene->film;
    const std::int64_t most = (std::int64_t{1} << 28) / (std::int64_t{film.crop_width} * film.crop_height);
    if (samples < 1 || samples > most) throw InputError(fmt::format("samples {}: expected 1 to {}", samples, most));
    if (first < 0) throw InputError(fmt::format("first {}: expected at least 0", first));
    CameraRays made;
    {
        const py::gil_scoped_release without_lock;
        made = camera_rays(*scene.scene, static_cast<std::uint64_t>(first), static_cast<std::uint64_t>(samples), seed);
    }
    py::dict d = as_dict(made.rays, made.pixels);
    d["weight"] = py::array_t<double>(static_cast<py::ssize_t>(made.weights.size()), made.weights.data());
    return d;
}

// A member of each point as an array view that keeps the points alive: (n, 3) for vectors, (n,) for numbers.
template <class Points, class Get>
py::array view(const py::object& owner, const Get& get) {
    const Points& points = owner.cast<const Points&>();
    using Point = typename decltype(points.all)::value_type;
    using Member = std::remove_cvref_t<decltype(get(points.all.front()))>;
    const auto n = static_cast<py::ssize_t>(points.all.size());
    const double* data = nullptr;
    constexpr py::ssize_t stride = sizeof(Point), size = sizeof(double);
    py::array array;
    if constexpr (std::is_same_v<Member, double>) {
        if (n > 0) data = &get(points.all.front());
        array = py::array_t<double>({n}, {stride}, data, owner);
    } else {
        if (n > 0) data = &get(points.all.front())[0];
        array = py::array_t<double>({n, py::ssize_t{3}}, {stride, size}, data, owner);
    }
    array.attr("flags").attr("writeable") = false;
    return array;
}

template <class Points>
Points take(const Points& points, const py::array_t<std::int64_t, py::array::c_style>& numbers) {
    Points taken{points.scene, {}};
    taken.all.reserve(static_cast<std::size_t>(numbers.size()));
    for (py::ssize_t i = 0; i < numbers.size(); ++i)
        taken.all.push_back(points.all.at(static_cast<std::size_t>(numbers.data()[i])));
    return taken;
}

py::dict arrays(const py::object& owner, const SeenPoints& points) {
    constexpr int nowhere = -1;
    py::dict d;
    d["hit"] = column<bool>(points.all, [](const SeenPoint& p) { return !p.y.is_infinite(); });
    d["distance"] = view<SeenPoints>(
        owner, [](const SeenPoint& p) -> const auto& { return p.distance; });
    d["position"] = view<SeenPoints>(
        owner, [](const SeenPoint& p) -> const auto& { return p.y.position; });
    d["normal"] = view<SeenPoints>(
        owner, [](const SeenPoint& p) -> const auto& { return p.normal; });
    d["emission"] = view<SeenPoints>(
        owner, [](const SeenPoint& p) -> const auto& { return p.emission; });
    d["reflectance"] = view<SeenPoints>(
        owner, [](const SeenPoint& p) -> const auto& { return p.reflectance; });
    d["shape"] =
        column<int>(points.all, [](const SeenPoint& p) { return p.y.is_infinite() ? nowhere : static_cast<int>(p.y.shape); });
    d["primitive"] =
        column<int>(points.all, [](const SeenPoint& p) { return p.y.is_infinite() ? nowhere : static_cast<int>(p.y.primitive); });
    return d;
}

py::dict arrays(const py::object& owner, const LightPoints&) {
    py::dict d;
    d["position"] = view<LightPoints>(
        owner, [](const LightPoint& p) -> const auto& { return p.point.position; });
    d["normal"] = view<LightPoints>(
        owner, [](const LightPoint& p) -> const auto& { return p.point.normal; });
    d["direction"] = view<LightPoints>(
        owner, [](const LightPoint& p) -> const auto& { return p.w; });
    d["weight"] = view<LightPoints>(
        owner, [](const LightPoint& p) -> const auto& { return p.weight; });
    d["pdf"] = view<LightPoints>(
        owner, [](const LightPoint& p) -> const auto& { return p.pdf; });
    d["density"] = view<LightPoints>(
        owner, [](const LightPoint& p) -> const auto& { return p.density; });
    return d;
}

template <class Points>
void bind_points(py::module_& m, const char* name, const char* doc) {
    py::class_<Points>(m, name, doc)
        .def("arrays", [](const py::object& self) { return arrays(self, self.cast<const Points&>()); })
        .def("take", &take<Points>, py::arg("numbers"))
        .def("__len__", [](const Points& points) { return points.all.size(); });
}

}  // namespace

py::dict as_dict(std::span<const CameraRay> rays, std::span<const Pixel> pixels) {
    py::dict d;
    d["origin"] = rows(rays, 3, [](const CameraRay& ray) { return ray.origin; });
    d["direction"] = rows(rays, 3, [](const CameraRay& ray) { return ray.direction; });
    d["length"] = column<double>(rays, [](const CameraRay& ray) { return ray.length; });
    d["pixel"] = rows<int>(pixels, 2, [](const Pixel& pixel) { return std::array{pixel.x, pixel.y}; });
    return d;
}

void bind_rays(py::module_& m) {
    bind_points<SeenPoints>(m, "SeenPoints", "What rays have hit.");
    bind_points<LightPoints>(m, "LightPoints", "Samples of light.");
    m.def("camera_rays", &rays_of_camera, py::arg("scene"), py::arg("samples"), py::arg("first"), py::arg("seed"));
    m.def("intersect", &intersect, py::arg("scene"), py::arg("origin"), py::arg("direction"), py::arg("length"));
    m.def("seen", &seen_by_camera, py::arg("scene"), py::arg("origin"), py::arg("direction"), py::arg("length"));
    m.def("visible", &sees, py::arg("scene"), py::arg("a"), py::arg("b"));
    m.def("sample_lights", &samples_of_lights, py::arg("scene"), py::arg("points"), py::arg("u"));
}

}  // namespace neumann
