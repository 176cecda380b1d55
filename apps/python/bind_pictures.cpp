// Pictures as arrays, as files and for display, and error metrics between two pictures.
#include "apps/output/files/rendered_picture.h"
#include "apps/python/module.h"
#include "core/image/image_io.h"
#include "core/image/resize.h"
#include "operators/statistics/flip.h"
#include "operators/statistics/metrics.h"

#include <fmt/format.h>

#include <pybind11/stl.h>

#include <array>
#include <vector>

namespace neumann {

py::array_t<float> as_array(const Image& image) {
    py::array_t<float> array({image.height, image.width, 3});
    float* to = array.mutable_data();
    for (const Rgb& p : image.pixels)
        for (int c = 0; c < 3; ++c) *to++ = static_cast<float>(p[c]);
    return array;
}

py::object as_array_or_none(const Image& image) {
    if (image.pixels.empty()) return py::none();
    return as_array(image);
}

py::tuple as_tuple(const PixelEstimate& picture, const std::optional<PictureMeans>& means) {
    py::object figures = py::none();
    if (means) {
        const auto row = [](const MeanWithError& m) { return py::make_tuple(m.mean, m.standard_error, m.degrees_of_freedom); };
        figures = py::make_tuple(row(means->channel[0]), row(means->channel[1]), row(means->channel[2]), row(means->all));
    }
    return py::make_tuple(as_array(picture.mean), as_array_or_none(picture.pixel_errors()),
                          as_array_or_none(picture.discretisation), as_array_or_none(picture.standard_error), figures);
}

Image as_image(const py::array_t<double, py::array::c_style | py::array::forcecast>& array) {
    if (array.ndim() != 3 || array.shape(2) != 3 || array.shape(0) < 1 || array.shape(1) < 1) {
        std::string shape;
        for (py::ssize_t i = 0; i < array.ndim(); ++i) shape += (i ? ", " : "") + std::to_string(array.shape(i));
        throw InputError(fmt::format("an array of shape ({}) is no picture, which has (height, width, 3)", shape));
    }
    Image image(static_cast<int>(array.shape(1)), static_cast<int>(array.shape(0)));
    const double* from = array.data();
    for (Rgb& p : image.pixels)
        for (int c = 0; c < 3; ++c) p[c] = *from++;
    return image;
}

namespace {

using Array = py::array_t<double, py::array::c_style | py::array::forcecast>;

py::tuple read(const std::string& path) {
    RenderedPicture rendered;
    {
        const py::gil_scoped_release release;
        rendered = read_rendered_picture(path);
    }
    return as_tuple(rendered.picture, rendered.infinite_variance ? std::nullopt : rendered.means);
}

Estimate estimate(const Array& mean, const py::object& standard_error) {
    Estimate picture{as_image(mean), {}};
    if (!standard_error.is_none()) picture.standard_error = as_image(standard_error.cast<Array>());
    return picture;
}

PictureMeans picture_means(const py::object& figures) {
    PictureMeans means;
    if (figures.is_none()) return means;
    const auto rows = figures.cast<std::vector<std::array<double, 3>>>();
    const auto of = [&](std::size_t i) { return MeanWithError{rows.at(i)[0], rows.at(i)[1], rows.at(i)[2]}; };
    for (std::size_t c = 0; c < 3; ++c) means.channel[c] = of(c);
    means.all = of(3);
    return means;
}

py::dict compare_arrays(const Array& a, const Array& b, const py::object& a_stderr, const py::object& b_stderr,
                        const py::object& a_means, const py::object& b_means) {
    const Estimate test = estimate(a, a_stderr), reference = estimate(b, b_stderr);
    const Metrics m = compare(test.mean, reference.mean);
    py::dict d;
    d["rmse"] = m.rmse;
    d["rmse_by_noise"] =
        a_stderr.is_none() && b_stderr.is_none() ? py::object(py::none()) : py::object(py::float_(expected_rmse(test, reference)));
    d["rel_mse"] = m.rel_mse;
    d["mape"] = m.mape;
    d["smape"] = m.smape;
    d["max_error"] = m.max_error;
    d["mean"] = m.mean;
    d["reference_mean"] = m.reference_mean;
    d["mean_difference"] = m.mean_difference;
    d["mean_difference_interval95"] = py::none();
    // A picture without means does not say which of its errors are correlated.
    const bool known = (a_stderr.is_none() || !a_means.is_none()) && (b_stderr.is_none() || !b_means.is_none());
    if (known && m.not_finite == 0 && !(a_stderr.is_none() && b_stderr.is_none())) {
        const PictureMeans of_a = picture_means(a_means), of_b = picture_means(b_means);
        d["mean_difference_interval95"] =
            compare_means({test, exact_degrees_of_freedom, &of_a}, {reference, exact_degrees_of_freedom, &of_b}).all.half_width;
    }
    d["pixels"] = m.pixels;
    d["not_finite"] = m.not_finite;
    return d;
}

// HDR-FLIP of each pixel, (height, width).
py::array_t<float> flip(const Array& a, const Array& b) {
    const Image test = as_image(a), reference = as_image(b);
    std::vector<float> errors;
    {
        const py::gil_scoped_release without_lock;
        errors = hdr_flip(test, reference);
    }
    return py::array_t<float>({test.height, test.width}, errors.data());
}

// A PNG at most `height` pixels high; small pictures are enlarged by whole factors, so that pixels stay equal.
py::bytes png(const Array& array, double exposure, int height) {
    Image image = as_image(array);
    const double scale = image.height > height ? static_cast<double>(height) / image.height : height / image.height;
    image = resized(image, std::max(1, static_cast<int>(image.width * scale)), std::max(1, static_cast<int>(image.height * scale)));
    return encode_png(to_display(image, exposure));
}

}  // namespace

void bind_pictures(py::module_& m) {
    m.def("read", &read, py::arg("path"));
    m.def("compare", &compare_arrays, py::arg("a"), py::arg("b"), py::arg("a_stderr") = py::none(),
          py::arg("b_stderr") = py::none(), py::arg("a_means") = py::none(), py::arg("b_means") = py::none());
    m.def("flip", &flip, py::arg("a"), py::arg("b"));
    m.attr("metrics_epsilon") = metrics_epsilon;
    m.def("png", &png, py::arg("picture"), py::arg("exposure"), py::arg("height"));
    m.def(
        "exposure", [](const Array& sum, const Array& emission) { return exposure_for(as_image(sum), as_image(emission)); },
        py::arg("sum"), py::arg("emission"));
}

}  // namespace neumann
