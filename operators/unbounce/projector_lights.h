// A projector in the place of the camera, whose picture is cut into columns and rows: each block by itself is a light. It shines on
// all that the camera sees and on nothing else, as Seitz, Matsushita and Kutulakos suppose.
#pragma once

#include "core/scene/scene.h"
#include "operators/methods/bounce_series.h"
#include "operators/methods/goal.h"

#include <cstdint>

namespace neumann {

// The scene as its camera sees it, in the light of such a projector alone. A white surface that faces it where the scene's middle
// is has the radiance 1.
class ProjectorLights {
public:
    // `width`: of the pictures, in pixels; their height follows from the scene's film. Pixels have the box filter, so that each
    // lies in the light of one block. Throws InputError unless the camera is a pinhole in the film's middle, with a whole film, and
    // there are at most as many columns and rows as pixels.
    ProjectorLights(const Scene& scene, int width, int columns, int rows);

    std::size_t lights() const { return static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_); }
    int width() const { return scene_.film.width; }
    int height() const { return scene_.film.height; }

    // The scene with block `light` switched on, from the upper left corner row by row; and with all of them.
    Scene lit_by(std::size_t light) const;
    Scene flooded() const;

    // The goal of the picture of a light, of which the bounce 1 and the limit are wanted: with random numbers of its own.
    static Goal goal_of(std::size_t light, std::uint64_t samples, std::uint64_t seed);

private:
    Scene lit(int light) const;  // -1: all

    Scene scene_;
    int columns_, rows_;
};

}  // namespace neumann
