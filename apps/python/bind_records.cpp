// The records of an irradiance cache as arrays.
#include "apps/commands/interrupt.h"
#include "apps/python/module.h"
#include "core/base/error.h"
#include "core/base/memory.h"
#include "operators/cache/record_points.h"
#include "operators/methods/method_options.h"
#include "operators/methods/sampling.h"

#include <fmt/format.h>
#include <pybind11/stl.h>

#include <limits>

namespace neumann {

namespace {

py::dict as_dict(const std::vector<RecordPoint>& points, int bounces) {
    const auto n = static_cast<py::ssize_t>(points.size());
    py::array_t<double> position({n, py::ssize_t{3}}), normal({n, py::ssize_t{3}}), pixel({n, py::ssize_t{2}}), radius(n),
        irradiance({n, py::ssize_t{bounces}, py::ssize_t{3}});
    py::array_t<bool> seen(n);
    for (py::ssize_t i = 0; i < n; ++i) {
        const RecordPoint& point = points[static_cast<std::size_t>(i)];
        const Vec2 on_film = point.pixel.value_or(Vec2(std::numeric_limits<double>::quiet_NaN()));
        for (int c = 0; c < 3; ++c) {
            position.mutable_at(i, c) = point.record.x.position[c];
            normal.mutable_at(i, c) = point.record.frame.n[c];
            for (int k = 0; k < bounces; ++k) irradiance.mutable_at(i, k, c) = point.irradiance[static_cast<std::size_t>(k)][c];
        }
        for (int c = 0; c < 2; ++c) pixel.mutable_at(i, c) = on_film[c];
        radius.mutable_at(i) = point.record.radius;
        seen.mutable_at(i) = point.record.is_seen;
    }
    py::dict d;
    d["position"] = position;
    d["normal"] = normal;
    d["radius"] = radius;
    d["seen"] = seen;
    d["irradiance"] = irradiance;
    d["pixel"] = pixel;
    return d;
}

std::unique_ptr<Job> start_records(const std::shared_ptr<LoadedScene>& loaded, int bounces,
                                   const std::vector<std::pair<std::string, std::string>>& options, std::uint64_t seed) {
    if (bounces < 1 || bounces > 1000) throw InputError(fmt::format("bounces {}: expected 1 to 1000", bounces));
    const auto cache = std::get<method::Cache>(make_method({method::Cache::name, options}));
    return std::make_unique<Job>(0, [=](Job& job) -> Job::Finish {
        job.tell("placing records");
        const auto points = std::make_shared<const std::vector<RecordPoint>>(
            record_points(*loaded->scene, settings_of(cache), bounces, seed, default_memory(), {.stop = interrupted}));
        return [points, bounces] { return as_dict(*points, bounces); };
    });
}

}  // namespace

void bind_records(py::module_& m) {
    m.def("records", &start_records, py::arg("scene"), py::arg("bounces"), py::arg("options"), py::arg("seed"));
}

}  // namespace neumann
