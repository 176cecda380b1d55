// The parts of the compiled module _neumann, and their shared helpers. The package `neumann` wraps the module.
#pragma once

#include "apps/command_line/commands.h"
#include "apps/commands/patch_scene.h"
#include "apps/python/job.h"
#include "apps/python/text.h"
#include "core/image/pixel_estimate.h"
#include "core/reader/changed_scene.h"
#include "core/scene/scene.h"
#include "operators/experiments/queries/camera_rays.h"
#include "operators/statistics/picture_statistics.h"

#include <pybind11/numpy.h>

#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace neumann {

namespace py = pybind11;

// A scene as its files were when it was read.
struct LoadedScene {
    std::string path;
    std::map<std::string, std::string> definitions;
    bool lenient = false;
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
// Mean, stderr, discretisation, spread, and (mean, standard error, degrees of freedom) of red, green, blue and all; None for
// missing parts.
py::tuple as_tuple(const PixelEstimate& picture, const std::optional<PictureMeans>& means);
// Takes any numeric array of this shape. Throws InputError.
Image as_image(const py::array_t<double, py::array::c_style | py::array::forcecast>& array);

// origin and direction (n, 3), length (n,), and pixel (n, 2), column and row.
py::dict as_dict(std::span<const CameraRay> rays, std::span<const Pixel> pixels);

// The equivalent command line.
std::string command_line(const std::string& command, const LoadedScene& scene, const std::vector<std::string>& arguments);

// Parses keyword arguments, given as options of a command, with the command line's parser. Throws InputError with its message.
template <class Request>
Request parse(const std::string& command, CLI::App* (*add)(CLI::App&, Request&), const LoadedScene& scene,
              const std::vector<std::string>& arguments) {
    Request request;
    std::vector<std::string> line{command};
    line.insert(line.end(), arguments.begin(), arguments.end());
    line.insert(line.end(), {"--", scene.path});
    read_arguments([&](CLI::App& app) { add(app, request); }, line);
    return request;
}

}  // namespace neumann
