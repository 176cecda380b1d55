// Photons as arrays.
#include "apps/python/arrays.h"
#include "apps/python/module.h"
#include "core/base/error.h"
#include "core/base/interrupt.h"
#include "operators/paths/photons/photon_points.h"

#include <fmt/format.h>

namespace neumann {

namespace {

py::dict as_dict(const std::vector<PhotonPoint>& points) {
    py::dict d;
    d["position"] = rows(points, 3, [](const PhotonPoint& p) { return p.photon.position; });
    d["normal"] = rows(points, 3, [](const PhotonPoint& p) { return p.photon.normal; });
    d["wi"] = rows(points, 3, [](const PhotonPoint& p) { return p.photon.wi; });
    d["power"] = rows(points, 3, [](const PhotonPoint& p) { return p.photon.power; });
    d["pixel"] = rows(points, 2, [](const PhotonPoint& p) { return on_film(p.pixel); });
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
