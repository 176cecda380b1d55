// Photons as arrays.
#include "apps/commands/interrupt.h"
#include "apps/python/module.h"
#include "core/base/error.h"
#include "operators/photons/photon_points.h"

#include <fmt/format.h>

#include <limits>

namespace neumann {

namespace {

template <class T, class Get>
py::array_t<T> column(const std::vector<PhotonPoint>& points, const Get& get) {
    py::array_t<T> array(static_cast<py::ssize_t>(points.size()));
    std::transform(points.begin(), points.end(), array.mutable_data(), get);
    return array;
}

template <class Get>
py::array_t<double> rows(const std::vector<PhotonPoint>& points, py::ssize_t width, const Get& get) {
    py::array_t<double> array({static_cast<py::ssize_t>(points.size()), width});
    double* to = array.mutable_data();
    for (const PhotonPoint& p : points) {
        const auto values = get(p);
        for (int k = 0; k < static_cast<int>(width); ++k) *to++ = values[k];
    }
    return array;
}

py::dict as_dict(const std::vector<PhotonPoint>& points) {
    py::dict d;
    d["position"] = rows(points, 3, [](const PhotonPoint& p) { return p.photon.position; });
    d["normal"] = rows(points, 3, [](const PhotonPoint& p) { return p.photon.normal; });
    d["wi"] = rows(points, 3, [](const PhotonPoint& p) { return p.photon.wi; });
    d["power"] = rows(points, 3, [](const PhotonPoint& p) { return p.photon.power; });
    d["pixel"] =
        rows(points, 2, [](const PhotonPoint& p) { return p.pixel.value_or(Vec2(std::numeric_limits<double>::quiet_NaN())); });
    d["bounce"] = column<int>(points, [](const PhotonPoint& p) { return static_cast<int>(p.photon.bounce); });
    d["path"] = column<int>(points, [](const PhotonPoint& p) { return static_cast<int>(p.photon.path); });
    d["caustic"] = column<bool>(points, [](const PhotonPoint& p) { return p.is_caustic; });
    return d;
}

std::unique_ptr<Job> start_photons(const std::shared_ptr<LoadedScene>& loaded, std::int64_t paths, int bounces,
                                   std::uint64_t seed) {
    constexpr std::int64_t most = std::int64_t{1} << 28;
    if (paths < 1 || paths > most) throw InputError(fmt::format("paths {}: expected 1 to {}", paths, most));
    if (bounces < 1) throw InputError(fmt::format("bounces {}: expected at least 1", bounces));
    return std::make_unique<Job>(0, [=](Job& job) -> Job::Finish {
        job.tell("tracing photons");
        const auto points = std::make_shared<const std::vector<PhotonPoint>>(
            photon_points(*loaded->scene, bounces, static_cast<std::uint32_t>(paths), seed, {.stop = interrupted}));
        return [points] { return as_dict(*points); };
    });
}

}  // namespace

void bind_photons(py::module_& m) {
    m.def("photons", &start_photons, py::arg("scene"), py::arg("paths"), py::arg("bounces"), py::arg("seed"));
}

}  // namespace neumann
