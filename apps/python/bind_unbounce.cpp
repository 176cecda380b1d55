// `neumann unbounce`, on arrays: pictures have the shape (lights, height, width, 3).
#include "apps/output/files/json_text.h"
#include "apps/output/files/unbounce_files.h"
#include "apps/python/module.h"
#include "core/base/error.h"
#include "core/base/interrupt.h"

#include <fmt/format.h>

#include <pybind11/stl.h>

#include <cmath>

namespace neumann {

namespace {

using Array = py::array_t<double, py::array::c_style | py::array::forcecast>;
using Numbers = py::array_t<int, py::array::c_style | py::array::forcecast>;

// `errors`: an array of the same shape, or None.
std::vector<Estimate> estimates(const py::object& pictures, const py::object& errors) {
    std::vector<Estimate> result;
    if (pictures.is_none()) return result;
    for (const py::handle& picture : pictures) result.push_back({as_image(picture.cast<Array>()), {}});
    if (errors.is_none()) return result;
    std::size_t i = 0;
    for (const py::handle& error : errors) {
        if (i == result.size()) throw InputError("there are more standard errors than pictures");
        Estimate& estimate = result[i++];
        estimate.standard_error = as_image(error.cast<Array>());
        if (estimate.standard_error.width != estimate.mean.width || estimate.standard_error.height != estimate.mean.height)
            throw InputError("standard errors have another shape than their pictures");
    }
    if (i < result.size()) throw InputError("there are fewer standard errors than pictures");
    return result;
}

py::array_t<float> as_stack(const std::vector<Estimate>& pictures, Image Estimate::*image) {
    const Image& first = pictures.front().*image;
    py::array_t<float> stack({static_cast<int>(pictures.size()), first.height, first.width, 3});
    float* to = stack.mutable_data();
    for (const Estimate& picture : pictures)
        for (const Rgb& p : (picture.*image).pixels)
            for (int c = 0; c < 3; ++c) *to++ = static_cast<float>(p[c]);
    return stack;
}

py::array_t<double> as_matrix(const Eigen::MatrixXd& matrix) {
    py::array_t<double> result({matrix.rows(), matrix.cols()});
    auto at = result.mutable_unchecked<2>();
    for (Eigen::Index i = 0; i < matrix.rows(); ++i)
        for (Eigen::Index j = 0; j < matrix.cols(); ++j) at(i, j) = matrix(i, j);
    return result;
}

struct Task {
    std::vector<Estimate> pictures, direct, forward;
    std::optional<Estimate> picture;
    Regions regions;
    UnbounceSettings settings;
    std::vector<std::string> names;
    std::shared_ptr<const LightRenders> besides;  // further data about rendered pictures

    LightPictures lights() const {
        LightPictures result;
        result.names = names;
        result.picture = [this](std::size_t j) { return pictures.at(j); };
        if (!direct.empty()) result.direct = [this](std::size_t j) { return direct.at(j); };
        if (besides) result.parts = &besides->parts;
        return result;
    }
};

py::tuple as_tuple(const Unbounced& found, const std::string& json) {
    py::list terms, channels;
    for (const PixelEstimate& term : found.terms)
        terms.append(
            py::make_tuple(as_array(term.mean), as_array_or_none(term.standard_error), as_array_or_none(term.discretisation)));
    for (const UnbouncedChannel& channel : found.channels)
        channels.append(py::make_tuple(channel.lights, as_matrix(channel.operators.T), as_matrix(channel.operators.inverse),
                                       as_matrix(channel.operators.direct), as_matrix(channel.once_more.value),
                                       as_matrix(channel.once_more.error), as_matrix(channel.terms.value),
                                       as_matrix(channel.terms.error)));
    return py::make_tuple(json, terms, as_array(found.rest), channels);
}

std::unique_ptr<Job> unbounce_arrays(const py::object& pictures, const py::object& errors, const py::object& direct,
                                     const py::object& direct_errors, const py::object& forward, const py::object& forward_errors,
                                     const py::object& picture, const py::object& regions,
                                     std::optional<std::pair<int, int>> blocks, int bounces, std::optional<double> regularisation,
                                     bool with_direct, std::uint64_t seed, std::shared_ptr<LightRenders> besides) {
    const auto task = std::make_shared<Task>();
    task->besides = std::move(besides);
    task->pictures = estimates(pictures, errors);
    task->direct = estimates(direct, direct_errors);
    task->forward = estimates(forward, forward_errors);
    if (task->pictures.empty()) throw InputError("there are no pictures");
    if (!task->direct.empty() && task->direct.size() != task->pictures.size())
        throw InputError(
            fmt::format("{} pictures of direct light, expected {} as of lights", task->direct.size(), task->pictures.size()));
    if (with_direct && task->direct.empty()) throw InputError("use_direct: there are no direct pictures");
    if (bounces < 1) throw InputError(fmt::format("bounces is {}, expected at least 1", bounces));
    if (regularisation && !(*regularisation >= 0.0 && std::isfinite(*regularisation)))
        throw InputError(fmt::format("regularisation is {}, expected at least 0", *regularisation));
    const Image& first = task->pictures.front().mean;
    if (!picture.is_none()) {
        task->picture = Estimate{as_image(picture.cast<Array>()), {}};
        if (task->picture->mean.width != first.width || task->picture->mean.height != first.height)
            throw InputError("picture has another shape than those of the lights");
    }
    for (std::size_t j = 0; j < task->pictures.size(); ++j) task->names.push_back(fmt::format("light {}", j));
    task->settings = {bounces, regularisation, with_direct, {}, seed};
    if (blocks) {
        if (blocks->first < 1 || blocks->second < 1 ||
            static_cast<std::size_t>(blocks->first) * static_cast<std::size_t>(blocks->second) != task->pictures.size())
            throw InputError(fmt::format("lights are ({}, {}), and there are {} pictures", blocks->first, blocks->second,
                                         task->pictures.size()));
        task->regions = block_regions(first.width, first.height, blocks->first, blocks->second);
        task->settings.merged = merged_by_four(blocks->first, blocks->second);
        if (task->settings.merged.back() == 0) task->settings.merged.clear();
    }
    if (!regions.is_none()) {
        const Numbers numbers = regions.cast<Numbers>();
        if (numbers.ndim() != 2 || numbers.shape(0) != first.height || numbers.shape(1) != first.width)
            throw InputError(fmt::format("regions: expected an array of shape ({}, {})", first.height, first.width));
        task->regions = {first.width, first.height, std::vector<int>(numbers.data(), numbers.data() + numbers.size())};
    }
    return std::make_unique<Job>(0, [task](Job& job) -> Job::Finish {
        job.tell("going backwards");
        Watch watch;
        watch.stop = interrupted;
        const LightPictures lights = task->lights();
        if (task->regions.of_pixel.empty()) task->regions = brightest_regions(lights);
        const auto found = std::make_shared<const Unbounced>(
            unbounce(lights, task->regions, task->picture ? &*task->picture : nullptr, task->settings, watch));
        const auto terms = agreement(*found, task->picture ? std::vector<Estimate>() : task->forward,
                                     task->besides ? task->besides->by_way_of_unseen : std::vector<MeanWithError>());
        const std::string json = json_text(unbounce_json(*found, task->names, terms, doubts_about(*found, task->names, terms)));
        return [found, json]() -> py::object { return as_tuple(*found, json); };
    });
}

std::unique_ptr<Job> under_lights(const std::shared_ptr<LoadedScene>& loaded, int columns, int rows, std::optional<int> width,
                                  int bounces, std::uint64_t samples, std::uint64_t seed, int threads) {
    if (columns < 1 || rows < 1 || bounces < 1 || samples < 1 || width.value_or(1) < 1)
        throw InputError("lights, width, bounces and spp are at least 1");
    const ProjectorLights projector(*loaded->scene, width.value_or(loaded->scene->film.width), columns, rows);
    return std::make_unique<Job>(
        threads, [loaded, projector, sampling = LightSampling{bounces, samples, seed}](Job& job) -> Job::Finish {
            Watch watch;
            watch.stop = interrupted;
            const auto made = std::make_shared<const LightRenders>(render_lights(projector, sampling, watch, [&](double done) {
                job.tell(fmt::format("under {} lights", projector.lights()), 0.5 * done);
            }));
            return [made]() -> py::object {
                std::vector<Estimate> direct;
                for (std::size_t j = 0; j < made->pictures.size(); ++j) direct.push_back(made->direct_of(j));
                const auto besides = std::make_shared<LightRenders>();  // without the pictures, which are in the arrays
                besides->parts = made->parts;
                besides->by_way_of_unseen = made->by_way_of_unseen;
                py::list warnings;
                for (const auto& [text, count] : made->warnings.counts()) warnings.append(text);
                return py::make_tuple(as_stack(made->pictures, &Estimate::mean),
                                      as_stack(made->pictures, &Estimate::standard_error), as_stack(direct, &Estimate::mean),
                                      as_stack(direct, &Estimate::standard_error), as_stack(made->forward, &Estimate::mean),
                                      as_stack(made->forward, &Estimate::standard_error), warnings, besides);
            };
        });
}

}  // namespace

void bind_unbounce(py::module_& m) {
    py::class_<LightRenders, std::shared_ptr<LightRenders>>(m, "LightRenders");
    m.def("unbounce", &unbounce_arrays, py::arg("pictures"), py::arg("errors"), py::arg("direct"), py::arg("direct_errors"),
          py::arg("forward"), py::arg("forward_errors"), py::arg("picture"), py::arg("regions"), py::arg("blocks"),
          py::arg("bounces"), py::arg("regularisation"), py::arg("with_direct"), py::arg("seed"), py::arg("besides"));
    m.def("under_lights", &under_lights, py::arg("scene"), py::arg("columns"), py::arg("rows"), py::arg("width"),
          py::arg("bounces"), py::arg("samples"), py::arg("seed"), py::arg("threads"));
}

}  // namespace neumann
