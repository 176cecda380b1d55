// The parts of the compiled module _neumann, and their shared helpers. The package `neumann` wraps the module.
#pragma once

#include "apps/commands/patch_scene.h"
#include "apps/python/job.h"
#include "apps/python/text.h"
#include "apps/requests/option.h"
#include "apps/requests/scene_file.h"
#include "core/image/pixel_estimate.h"
#include "core/reader/changed_scene.h"
#include "core/scene/scene.h"
#include "operators/experiments/queries/camera_rays.h"
#include "operators/statistics/picture_statistics.h"

#include <fmt/ranges.h>
#include <pybind11/numpy.h>
#include <algorithm>

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace neumann {

namespace py = pybind11;

// A scene as its files were when it was read.
struct LoadedScene {
    SceneFile file;
    SceneChanges changes = {};
    std::shared_ptr<const Scene> scene = {};
    double seconds = 0.0;  // time to read it
};

void bind_scene(py::module_& m);
void bind_render(py::module_& m);
void bind_pictures(py::module_& m);
void bind_patched(py::module_& m);
void bind_matrices(py::module_& m);
void bind_solvers(py::module_& m);
void bind_study(py::module_& m);
void bind_photons(py::module_& m);
void bind_records(py::module_& m);
void bind_chains(py::module_& m);
void bind_blame(py::module_& m);
void bind_unbounce(py::module_& m);
void bind_rays(py::module_& m);

// The scene on patches, traced. Throws as PatchScene's constructor does.
std::shared_ptr<const PatchScene> patch_scene(const LoadedScene& loaded, PatchOptions options);

// (height, width, 3), row 0 at the top; float32, as in files.
py::array_t<float> as_array(const Image& image);
// The same, or None if the image is empty.
py::object as_array_or_none(const Image& image);
// Mean, stderr, discretisation, spread, and (mean, standard error, degrees of freedom) of r, g, b and all; or None.
py::tuple as_tuple(const PixelEstimate& picture, const std::optional<PictureMeans>& means);
// Takes any numeric array of this shape. Throws InputError.
Image as_image(const py::array_t<double, py::array::c_style | py::array::forcecast>& array);

// origin and direction (n, 3), length (n,), and pixel (n, 2), column and row.
py::dict as_dict(std::span<const CameraRay> rays, std::span<const Pixel> pixels);

// Keywords as options: their names have - instead of _, and their values are texts.
using Keywords = Given;

// The command line for the same request.
std::string command_line(const LoadedScene& scene, const std::string& command, const std::vector<std::string>& words);

// The request that the keywords describe. Throws InputError, which begins with the keyword.
template <class Request>
Request request_of(const Options<Request>& options, const LoadedScene& scene, Keywords keywords) {
    std::vector<std::string> words;
    for (auto& [name, texts] : keywords) {
        const Option<Request>* o = options.find(name);
        if (!o) throw InputError(fmt::format("'{}' is no option of {}", name, options.command));
        if (!o->comma) texts = {fmt::format("{}", fmt::join(texts, ","))};
        if (o->kind == OptionWords::Kind::flag && texts.front() == "false") continue;
        words.push_back(o->spelled());
        if (o->kind != OptionWords::Kind::flag) words.push_back(fmt::format("{}", fmt::join(texts, ",")));
    }
    Request request;
    take(options, keywords, request, [](const OptionWords& o) {
        std::string keyword = o.name;
        std::ranges::replace(keyword, '-', '_');
        return keyword;
    });
    const auto be_of_scene = [&](auto& its) {
        its.scene = scene.file;
        its.command_line = command_line(scene, options.command, words);
    };
    if constexpr (requires { request.patches; })
        be_of_scene(request.patches);
    else
        be_of_scene(request);
    return request;
}

}  // namespace neumann
