// Members of many objects as NumPy arrays.
#pragma once

#include "core/base/vec.h"

#include <pybind11/numpy.h>

#include <algorithm>
#include <limits>
#include <optional>

namespace neumann {

namespace py = pybind11;

// An array (n,) of get(thing) for each.
template <class T, class Things, class Get>
py::array_t<T> column(const Things& things, const Get& get) {
    py::array_t<T> array(static_cast<py::ssize_t>(things.size()));
    std::transform(things.begin(), things.end(), array.mutable_data(), get);
    return array;
}

// An array (n, width) of the numbers of get(thing), which is anything with []. Its result may be a reference.
template <class T = double, class Things, class Get>
py::array_t<T> rows(const Things& things, py::ssize_t width, const Get& get) {
    py::array_t<T> array({static_cast<py::ssize_t>(things.size()), width});
    T* to = array.mutable_data();
    for (const auto& thing : things) {
        const auto& numbers = get(thing);
        for (int k = 0; k < static_cast<int>(width); ++k) *to++ = numbers[k];
    }
    return array;
}

// The pixel where the camera sees a point; NaN if it does not.
inline Vec2 on_film(const std::optional<Vec2>& pixel) { return pixel.value_or(Vec2(std::numeric_limits<double>::quiet_NaN())); }

}  // namespace neumann
