// `neumann blame`, on arrays.
#include "apps/commands/blame_command.h"
#include "apps/output/files/blame_files.h"
#include "apps/output/files/json_text.h"
#include "apps/python/module.h"
#include "core/base/error.h"
#include "core/base/interrupt.h"

#include <fmt/format.h>

#include <pybind11/stl.h>

#include <map>

namespace neumann {

namespace {

using Array = py::array_t<double, py::array::c_style | py::array::forcecast>;
using Arrays = std::map<int, Array>;

std::vector<DepthPicture> depth_pictures(const Arrays& pictures, const Arrays& again) {
    std::vector<DepthPicture> result;
    for (const auto& [number, array] : pictures) {
        const auto second = again.find(number);
        if (again.empty())
            result.push_back({number, as_image(array)});
        else if (second == again.end())
            throw InputError(fmt::format("again has no picture with the number {}", number));
        else
            result.push_back(mean_of_two(number, as_image(array), as_image(second->second)));
    }
    return result;
}

py::tuple as_tuple(const Blame& found, const Scene& scene) {
    py::list terms;
    for (const TermVerdict& t : found.terms)
        terms.append(py::make_tuple(as_array(t.theirs.mean), as_array(t.ours.mean), as_array(t.difference.mean),
                                    as_array(t.difference.standard_error), as_array(t.z)));
    return py::make_tuple(json_text(blame_json(found, scene)), terms);
}

std::unique_ptr<Job> start(const std::shared_ptr<LoadedScene>& loaded, const Arrays& pictures, const Arrays& again,
                           const Keywords& keywords) {
    const BlameRequest request = request_of(blame_options(), *loaded, keywords);
    return std::make_unique<Job>(
        request.threads,
        [loaded, theirs = depth_pictures(pictures, again), settings = blame_settings(request)](Job& job) -> Job::Finish {
            job.tell("comparing with our own terms");
            Watch watch;
            watch.stop = interrupted;
            const auto found = std::make_shared<const Blame>(blame(*loaded->scene, theirs, settings, watch));
            return [found, loaded]() -> py::object { return as_tuple(*found, *loaded->scene); };
        });
}

}  // namespace

void bind_blame(py::module_& m) {
    m.def("blame", &start, py::arg("scene"), py::arg("pictures"), py::arg("again"), py::arg("keywords"));
}

}  // namespace neumann
