// Pictures of light that comes by links (operators/fields/matrix/link_light.h) to diffuse sides. Reflected off a mirror or
// refracted through glass it draws sharp figures, caustics, which patches would blur. Where the camera sees the end of such a path,
// the path is added to the pixels there; where the end is seen in a mirror or through glass, it is read from a raster.
#pragma once

#include "core/scene/scene.h"
#include "operators/fields/matrix/row_share.h"
#include "operators/render/from_fields/link_raster.h"
#include "operators/watch.h"

#include <cstdint>
#include <span>

namespace neumann {

// Whether the ends of such paths can be joined to the camera: not if it looks through lights, nor if it is a single ray.
bool shows_links(const Scene& scene);

struct LinkPictures {
    std::vector<Rgb> picture;  // N + 2 colours for each pixel: bounces 2 … N and, as N + 1, later ones
    LinkRaster raster;
    std::uint64_t rays = 0;
};

// `rays`: their approximate number. Throws Stopped if `watch` stops it. With shared rows, all processes get the result.
LinkPictures picture_links(const Scene& scene, const RowShare& rows, double rays, std::uint64_t seed, int bounces,
                           const Watch& watch = {});

}  // namespace neumann
