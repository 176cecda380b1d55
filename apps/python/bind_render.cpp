// Renders, as `neumann render` makes and writes them.
#include "apps/commands/merge_command.h"
#include "apps/commands/print_warnings.h"
#include "apps/commands/progress_line.h"
#include "apps/commands/render_command.h"
#include "apps/live/live_page.h"
#include "apps/output/files/json_text.h"
#include "apps/output/files/series_files.h"
#include "apps/output/run_json.h"
#include "apps/python/module.h"
#include "core/base/error.h"
#include "core/base/interrupt.h"
#include "core/base/stopwatch.h"
#include "operators/render/methods/merge.h"
#include "operators/render/methods/render.h"

#include <fmt/format.h>
#include <pybind11/stl.h>

#include <algorithm>

namespace neumann {

namespace {

// A render whose samples can be merged with those of others.
struct Mergeable : Rendering {
    std::optional<RenderState> state = {};  // none for a method with fields
};
using Kept = std::shared_ptr<Mergeable>;

// Keeps the state of the samples when the last one is done.
Saving keeping(std::optional<RenderState>& state) {
    Saving saving;
    saving.keep = [&state](const RecordedRender& render, const std::optional<MethodChoice>& choice, const RenderedSeries& series,
                           bool is_last) {
        if (is_last) state = RenderState{render, choice, series};
    };
    return saving;
}

// `live`: a page that shows the render meanwhile, or null.
std::unique_ptr<Job> start(const std::shared_ptr<LoadedScene>& loaded, const Keywords& keywords,
                           const std::shared_ptr<LivePage>& live) {
    RenderRequest request = request_of(render_options(), *loaded, keywords);
    request.quiet = true;
    return std::make_unique<Job>(request.threads, [loaded, request, live](Job& job) -> Job::Finish {
        Watch watch;
        watch.stop = interrupted;
        watch.progress = [&](const RenderProgress& p) {
            job.tell(progress_text(p), p.seconds_left ? std::optional(p.fraction) : std::nullopt);
            if (live) live->tell(p);
        };
        std::optional<RenderState> state;
        Viewers viewers = chosen_viewers({});
        if (live) viewers.all.push_back(live.get());
        const auto rendering = render(request, loaded->scene, watch, keeping(state), &viewers);
        if (live) live->finish(page_data(*rendering, false), "");
        const auto kept = std::make_shared<Mergeable>(Mergeable{std::move(*rendering), std::move(state)});
        return [kept] { return py::cast(kept); };
    });
}

std::unique_ptr<Job> start_merge(const Kept& a, const Kept& b) {
    const std::string names[] = {"the first series", "the second series"};
    for (const Kept& series : {a, b})
        if (!series->state)
            throw InputError(names[series == a ? 0 : 1] +
                             " was rendered from fields on patches, and has no samples that could be put together");
    if (a->scene->hash != b->scene->hash)
        throw InputError(fmt::format("{} and {} cannot be merged: their scenes are not the same", names[0], names[1]));
    RenderState merged = merge({{names[0], *a->state}, {names[1], *b->state}});
    return std::make_unique<Job>(0, [a, b, merged = std::move(merged)](Job& job) -> Job::Finish {
        job.tell("merging");
        const Stopwatch clock;
        Goal goal;
        goal.samples = merged.series.samples;
        std::optional<RenderState> state;
        Saving saving = keeping(state);
        saving.from = merged;
        BounceSeries series = render(*a->scene, merged.render.method, goal, {}, std::move(saving));
        auto kept = std::make_shared<Mergeable>(Mergeable{*a, std::move(state)});
        kept->series = std::move(series);
        kept->request = request_for_all(a->request, merged);
        kept->request.command_line = a->request.command_line + " merged with " + b->request.command_line;
        kept->seconds = clock.seconds();
        return [kept] { return py::cast(kept); };
    });
}

std::unique_ptr<Job> save(const Kept& rendering, const std::string& path, const std::vector<std::string>& files) {
    return std::make_unique<Job>(0, [rendering, path, chosen = choose_files(files)](Job& job) -> Job::Finish {
        job.tell("writing " + path);
        OutputFolder folder(path, "render");
        Rendering saved = *rendering;
        saved.files = chosen;
        write_rendering(saved, folder);
        return [] { return py::none(); };
    });
}

py::object ways(const Mergeable& rendering) {
    if (!rendering.series.ways) return py::none();
    py::list list;
    for (const Way& way : rendering.series.ways->ways)
        list.append(py::make_tuple(way.s, way.t, as_array(way.weighted.picture.mean), as_array(way.unweighted.picture.mean)));
    return list;
}

}  // namespace

void bind_render(py::module_& m) {
    py::class_<Mergeable, Kept>(m, "Rendering", "A finished render.")
        .def_property_readonly("bounces", [](const Mergeable& r) { return r.series.bounces(); })
        .def("term",
             [](const Mergeable& r, std::size_t i) {
                 const BounceSeries& s = r.series;
                 return as_tuple(s.term(i),
                                 s.report.bounces.at(i).infinite_variance ? std::nullopt : std::optional(s.means_of_term(i)));
             })
        .def("sum",
             [](const Mergeable& r, std::size_t i) {
                 const BounceSeries& s = r.series;
                 const auto end = s.report.bounces.begin() + static_cast<std::ptrdiff_t>(i) + 1;
                 const bool infinite =
                     std::any_of(s.report.bounces.begin(), end, [](const BounceReport& b) { return b.infinite_variance; });
                 return as_tuple(s.sum(i), infinite ? std::nullopt : std::optional(s.means_of_sum(i)));
             })
        .def("rest",
             [](const Mergeable& r) {
                 const BounceSeries& s = r.series;
                 if (!s.rest) return py::object(py::none());
                 return py::object(as_tuple(*s.rest, s.report.rest_infinite_variance ? std::nullopt : s.means_of_rest));
             })
        .def("ways", &ways)
        .def("table", [](const Mergeable& r) { return series_table(r.series.report); })
        .def("convergence", [](const Mergeable& r) { return convergence_table(r.series.convergence); })
        .def("run",
             [](const Mergeable& r, const std::string& folder) { return json_text(run_json(r, r.warnings(), folder, r.seconds)); })
        .def_property_readonly("warnings", [](const Mergeable& r) { return texts(r.series.warnings); })
        .def(
            "complaints", [](const Mergeable& r, const std::string& folder) { return r.complaints(folder); }, py::arg("folder"))
        .def("save", &save, py::arg("folder"), py::arg("files") = file_groups());
    py::class_<LivePage, std::shared_ptr<LivePage>>(m, "LivePage",
                                                    "A page that fills while a render runs, on a server of this process.")
        .def(py::init([] { return std::make_shared<LivePage>(std::uint16_t{0}); }))
        .def("expect", &LivePage::expect, "A browser will ask for it, and the end of the render waits for that, for some seconds.")
        .def_property_readonly("address", &LivePage::address, "http://127.0.0.1:…/, on this machine alone.");
    m.def("render", &start, py::arg("scene"), py::arg("keywords"), py::arg("live"));
    m.def("merge", &start_merge, py::arg("a"), py::arg("b"));
}

}  // namespace neumann
