// A camera sample of a pixel: a ray through a point within the reach of the pixel's filter, and its weight, which is the filter's
// times the sensor's response.
#pragma once

#include "core/scene/scene.h"

namespace neumann {

struct CameraSample {
    CameraRay ray;
    double weight;
};

// Samples the pixel in column x and row y of the film.
template <class Sampler>
CameraSample sample_camera(const Scene& scene, int x, int y, Sampler& sampler) {
    const FilmSample place = scene.film.sample(sampler.next2(), x, y);
    return {scene.camera.sample_ray(place.position, sampler), place.weight * scene.camera.response(place.position)};
}

}  // namespace neumann
