// Renders, as `neumann render` makes and writes them.
#include "apps/commands/interrupt.h"
#include "apps/commands/print_warnings.h"
#include "apps/commands/progress_line.h"
#include "apps/commands/render_command.h"
#include "apps/files/run_json.h"
#include "apps/files/series_files.h"
#include "apps/python/module.h"

#include <pybind11/stl.h>

#include <algorithm>

namespace neumann {

namespace {

std::unique_ptr<Job> start(const std::shared_ptr<LoadedScene>& loaded, const std::vector<std::string>& arguments) {
    RenderRequest request = parse<RenderRequest>("render", add_render, *loaded, arguments);
    request.definitions = loaded->definitions;
    request.command_line = command_line("render", *loaded, arguments);
    request.quiet = true;
    return std::make_unique<Job>(request.threads, [loaded, request](Job& job) -> Job::Finish {
        Watch watch;
        watch.stop = interrupted;
        watch.progress = [&](const RenderProgress& p) {
            job.tell(progress_text(p), p.seconds_left ? std::optional(p.fraction) : std::nullopt);
        };
        const std::shared_ptr<Rendering> rendering = render(request, loaded->scene, watch);
        return [rendering] { return py::cast(rendering); };
    });
}

std::unique_ptr<Job> save(const std::shared_ptr<Rendering>& rendering, const std::string& path,
                          const std::vector<std::string>& files) {
    return std::make_unique<Job>(0, [rendering, path, chosen = choose_files(files)](Job& job) -> Job::Finish {
        job.tell("writing " + path);
        OutputFolder folder(path, "render");
        Rendering saved = *rendering;
        saved.files = chosen;
        write_rendering(saved, folder);
        return [] { return py::none(); };
    });
}

py::object ways(const Rendering& rendering) {
    if (!rendering.series.ways) return py::none();
    py::list list;
    for (const Way& way : rendering.series.ways->ways)
        list.append(py::make_tuple(way.s, way.t, as_array(way.weighted.picture.mean), as_array(way.unweighted.picture.mean)));
    return list;
}

}  // namespace

void bind_render(py::module_& m) {
    py::class_<Rendering, std::shared_ptr<Rendering>>(m, "Rendering", "A finished render.")
        .def_property_readonly("bounces", [](const Rendering& r) { return r.series.bounces(); })
        .def("term",
             [](const Rendering& r, std::size_t i) {
                 const BounceSeries& s = r.series;
                 return as_tuple(s.term(i),
                                 s.report.bounces.at(i).infinite_variance ? std::nullopt : std::optional(s.means_of_term(i)));
             })
        .def("sum",
             [](const Rendering& r, std::size_t i) {
                 const BounceSeries& s = r.series;
                 const auto end = s.report.bounces.begin() + static_cast<std::ptrdiff_t>(i) + 1;
                 const bool infinite =
                     std::any_of(s.report.bounces.begin(), end, [](const BounceReport& b) { return b.infinite_variance; });
                 return as_tuple(s.sum(i), infinite ? std::nullopt : std::optional(s.means_of_sum(i)));
             })
        .def("rest",
             [](const Rendering& r) {
                 const BounceSeries& s = r.series;
                 if (!s.rest) return py::object(py::none());
                 return py::object(as_tuple(*s.rest, s.report.rest_infinite_variance ? std::nullopt : s.means_of_rest));
             })
        .def("ways", &ways)
        .def("table", [](const Rendering& r) { return series_table(r.series.report); })
        .def("convergence", [](const Rendering& r) { return convergence_table(r.series.convergence); })
        .def("run",
             [](const Rendering& r, const std::string& folder) { return run_json(r, r.warnings(), folder, r.seconds).dump(); })
        .def_property_readonly("warnings", [](const Rendering& r) { return texts(r.series.warnings); })
        .def("complaints", &Rendering::complaints)
        .def("save", &save, py::arg("folder"), py::arg("files") = file_groups());
    m.def("render", &start, py::arg("scene"), py::arg("arguments"));
}

}  // namespace neumann
