// A projector at the place of the camera, whose picture is cut into columns and rows; each block by itself is a light.
// It shines on everything that the camera sees and on nothing else, as Seitz, Matsushita and Kutulakos suppose.
#pragma once

#include "core/emitter/projector_light.h"
#include "core/scene/scene.h"
#include "operators/experiments/unbounce/regions.h"
#include "operators/render/methods/goal.h"

#include <cstdint>
#include <functional>

namespace neumann {

// The scene as its camera sees it, in the light of such a projector alone. A white surface at the scene's middle that
// faces the projector has the radiance 1.
class ProjectorLights {
public:
    // `width`: of the pictures, in pixels; their height follows from the scene's film. Pixels have the box filter, so
    // that each lies in the light of one block. Throws InputError unless the camera is a pinhole in the film's middle,
    // with a whole film, and there are at most as many columns and rows as pixels.
    ProjectorLights(const Scene& scene, int width, int columns, int rows);

    std::size_t lights() const { return static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_); }
    int width() const { return scene_.film.width; }
    int height() const { return scene_.film.height; }

    // Blocks of the pictures: the pixels that each light shines on.
    Regions regions() const { return block_regions(width(), height(), columns_, rows_); }
    // The light whose beam contains a point that the projector sees.
    std::size_t light_at(const Vec3& point) const;

    // The scene with block `light` switched on, counted from the upper left corner row by row; and with all of them.
    Scene lit_by(std::size_t light) const;
    Scene flooded() const;

    // The goal of a render with random numbers of its own, of which bounce 1 and the limit are wanted.
    static Goal goal_of(std::size_t number, std::uint64_t samples, std::uint64_t seed);

private:
    Scene lit(const std::function<double(int light)>& brightness) const;
    Slide slide_of(const std::function<double(int light)>& brightness) const;

    Scene scene_;
    int columns_, rows_;
    ProjectorLight white_, numbers_;  // the second shows each light's number, from 1, where the first shows 1
};

}  // namespace neumann
