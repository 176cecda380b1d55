// `neumann study`.
#include "apps/commands/study_data.h"
#include "apps/python/module.h"
#include "core/base/error.h"

#include <pybind11/stl.h>

namespace neumann {

namespace {

std::unique_ptr<Job> start(const std::shared_ptr<LoadedScene>& loaded, const std::vector<std::string>& arguments) {
    StudyRequest request = parse<StudyRequest>("study", add_study, *loaded, arguments);
    request.definitions = loaded->definitions;
    request.command_line = command_line("study", *loaded, arguments);
    request.quiet = true;
    return std::make_unique<Job>(request.threads, [loaded, request](Job& job) -> Job::Finish {
        job.tell("measuring how fast the methods are, and making a reference");
        std::string csv, json;
        std::vector<std::string> warnings;
        const StudyEnd end = run_study(
            request, *loaded->scene, loaded->seconds, [&](const std::string& what, double fraction) { job.tell(what, fraction); },
            [&](const StudyData& data, const std::vector<StudiedPicture>&, const nlohmann::ordered_json& found) {
                csv = study_csv(data);
                json = found.dump();
                warnings = data.warnings();
            });
        if (json.empty()) throw RunError("interrupted before any method had two runs");
        return [=]() -> py::object { return py::make_tuple(json, csv, warnings, end.complete); };
    });
}

}  // namespace

void bind_study(py::module_& m) { m.def("study", &start, py::arg("scene"), py::arg("arguments")); }

}  // namespace neumann
