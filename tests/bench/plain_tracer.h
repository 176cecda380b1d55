// The yardstick for the walk: path tracing as short as it can be written. Single rays through Embree, floats, a pinhole camera, a
// box filter, constant diffuse materials, one lamp that is a parallelogram; no error bars, no hits in double, no messages. The
// estimator is the walk's: at every bounce the lamp and the BSDF are sampled once each and weighted by the power heuristic, and the
// BSDF's direction goes on.
#pragma once

#include "core/scene/scene.h"

#include <cstdint>
#include <memory>
#include <vector>

namespace neumann {

class PlainTracer {
public:
    // The scene must have nothing but the above.
    explicit PlainTracer(const Scene& scene);
    ~PlainTracer();

    struct Pictures {
        std::vector<glm::vec3> of;  // pixel by pixel, bounces 0 … N together: means over the samples
        std::uint64_t rays;
    };
    Pictures render(int bounces, int samples, std::uint64_t seed) const;

private:
    struct Face {
        glm::vec3 normal, albedo_front, albedo_back;
        bool is_lamp;
    };
    struct Numbers;
    struct Embree;

    std::uint64_t trace(int x, int y, int bounces, Numbers& numbers, glm::vec3* sum) const;

    int width_, height_;
    std::vector<Face> faces_;
    glm::vec3 eye_, corner_, across_, down_;  // a ray through the film has the direction corner + x across + y down
    float near_;                              // the rays' origins are this far from the eye, along the axis
    glm::vec3 lamp_, lamp_a_, lamp_b_, lamp_normal_, radiance_;
    float lamp_area_ = 0.0f, offset_;
    std::unique_ptr<Embree> embree_;
};

}  // namespace neumann
