// A sample of a pixel: the ray through a place that its filter reaches, and the filter's weight.
#pragma once

#include "core/scene/scene.h"

namespace neumann {

struct CameraSample {
    CameraRay ray;
    double weight;
};

// Of the pixel in column x and row y of the film.
template <class Sampler>
CameraSample sample_camera(const Scene& scene, int x, int y, Sampler& sampler) {
    const FilmSample place = scene.film.sample(sampler.next2(), x, y);
    return {scene.camera.sample_ray(place.position, sampler), place.weight};
}

}  // namespace neumann
