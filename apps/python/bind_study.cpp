// `neumann study`.
#include "apps/output/files/json_text.h"
#include "apps/output/study/study_data.h"
#include "apps/python/module.h"
#include "core/base/error.h"

#include <fmt/format.h>
#include <pybind11/stl.h>

namespace neumann {

namespace {

// Makes an estimator of function(rays as from as_dict(), bounces, seed). The study calls it in the job's thread.
OwnEstimator estimator_of(const py::object& function) {
    const std::shared_ptr<py::object> kept(new py::object(function), [](py::object* f) {
        const py::gil_scoped_acquire lock;
        delete f;
    });
    return [kept](std::span<const CameraRay> rays, std::span<const Pixel> pixels, int bounces, std::uint64_t seed) {
        const py::gil_scoped_acquire lock;
        const auto n = static_cast<py::ssize_t>(rays.size());
        const py::ssize_t terms = bounces + 1;
        const py::object made = (*kept)(as_dict(rays, pixels), bounces, seed);
        const auto array = py::array_t<double, py::array::c_style | py::array::forcecast>::ensure(made);
        if (!array || array.ndim() != 3 || array.shape(0) != n || array.shape(1) != terms || array.shape(2) != 3)
            throw InputError(fmt::format("returned {}, expected an array ({}, {}, 3): rays, bounces 0 to {}, channels",
                                         array ? py::str(array.attr("shape")).cast<std::string>() : "no array", n, terms, bounces));
        const double* from = array.data();
        std::vector<Rgb> samples(static_cast<std::size_t>(n * terms));
        for (Rgb& x : samples) {
            x = Rgb(from[0], from[1], from[2]);
            from += 3;
        }
        return samples;
    };
}

// `own`: functions for estimator_of(), by names that are among the methods.
std::unique_ptr<Job> start(const std::shared_ptr<LoadedScene>& loaded, const Keywords& keywords,
                           const std::map<std::string, py::object>& own) {
    StudyRequest request = request_of(study_options(), *loaded, keywords);
    request.quiet = true;
    std::map<std::string, OwnEstimator> estimators;
    for (const auto& [name, function] : own) estimators[name] = estimator_of(function);
    return std::make_unique<Job>(request.threads, [loaded, request, estimators](Job& job) -> Job::Finish {
        job.tell("measuring how fast the methods are, and making a reference");
        std::string csv, json;
        std::vector<std::string> warnings;
        const StudyEnd end = run_study(
            request, estimators, nullptr, *loaded->scene, loaded->seconds,
            [&](const std::string& what, double fraction) { job.tell(what, fraction); },
            [&](const StudyData& data, const std::vector<StudiedPicture>&, const nlohmann::ordered_json& found) {
                csv = study_csv(data);
                json = json_text(found);
                warnings = data.warnings();
            });
        if (json.empty()) throw RunError("interrupted before any method had two runs");
        return [=]() -> py::object { return py::make_tuple(json, csv, warnings, end.complete); };
    });
}

}  // namespace

void bind_study(py::module_& m) { m.def("study", &start, py::arg("scene"), py::arg("keywords"), py::arg("own")); }

}  // namespace neumann
