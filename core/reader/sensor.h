// <sensor type="perspective">, with its film and sampler.
#pragma once

#include "core/reader/context.h"
#include "core/scene/scene.h"

namespace neumann::reader {

struct Sensor {
    Perspective::Options camera;
    Film film;
    std::optional<SamplerKind> sampler;
};

Sensor read_sensor(const Element& e, const Context& context);
Film read_film(const Element& e, const Context& context);
PixelFilter read_filter(const Element& e, const Context& context);
SamplerKind read_sampler(const Element& e, const Context& context);

}  // namespace neumann::reader
