// The records of an irradiance cache as arrays.
#include "apps/python/arrays.h"
#include "apps/python/module.h"
#include "core/base/error.h"
#include "core/base/interrupt.h"
#include "core/base/memory.h"
#include "operators/paths/cache/record_points.h"
#include "operators/render/methods/method_options.h"
#include "operators/render/methods/sampling.h"

#include <fmt/format.h>
#include <pybind11/stl.h>

namespace neumann {

namespace {

py::dict as_dict(const std::vector<RecordPoint>& points, int bounces) {
    py::array_t<double> irradiance({static_cast<py::ssize_t>(points.size()), py::ssize_t{bounces}, py::ssize_t{3}});
    double* to = irradiance.mutable_data();
    for (const RecordPoint& point : points)
        for (const Rgb& E : point.irradiance)
            for (int c = 0; c < 3; ++c) *to++ = E[c];
    py::dict d;
    d["position"] = rows(points, 3, [](const RecordPoint& p) { return p.record.x.position; });
    d["normal"] = rows(points, 3, [](const RecordPoint& p) { return p.record.frame.n; });
    d["radius"] = column<double>(points, [](const RecordPoint& p) { return p.record.radius; });
    d["seen"] = column<bool>(points, [](const RecordPoint& p) { return p.record.is_seen; });
    d["irradiance"] = irradiance;
    d["pixel"] = rows(points, 2, [](const RecordPoint& p) { return on_film(p.pixel); });
    return d;
}

std::unique_ptr<Job> start_records(const std::shared_ptr<LoadedScene>& loaded, int bounces,
                                   const std::vector<std::pair<std::string, std::string>>& options, std::uint64_t seed) {
    if (bounces < 1 || bounces > 1000) throw InputError(fmt::format("bounces {}: expected 1 to 1000", bounces));
    const auto cache = std::get<method::Cache>(make_method({method::Cache::name, options}));
    return std::make_unique<Job>(0, [=](Job& job) -> Job::Finish {
        job.tell("placing records");
        const auto points = std::make_shared<const std::vector<RecordPoint>>(
            record_points(*loaded->scene, cache.settings(), bounces, seed, default_memory(), {.stop = interrupted}));
        return [points, bounces] { return as_dict(*points, bounces); };
    });
}

}  // namespace

void bind_records(py::module_& m) {
    m.def("records", &start_records, py::arg("scene"), py::arg("bounces"), py::arg("options"), py::arg("seed"));
}

}  // namespace neumann
