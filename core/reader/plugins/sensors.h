// <sensor type="perspective">, "thinlens", "orthographic" and "radiancemeter", with its film and sampler.
#pragma once

#include "core/reader/plugins/context.h"
#include "core/reader/xml/properties.h"
#include "core/scene/scene.h"

namespace neumann::reader {

struct ReadSensor {
    SensorOptions camera;
    Film film;
    std::optional<SamplerKind> sampler;
};

// `fov` with its axis or `focal_length`, as an angle; Mitsuba's default is a lens of 50 mm.
struct FieldOfView {
    double angle;  // full, radians
    FovAxis axis;
};
FieldOfView read_field_of_view(Properties& p);
// Rotations, reflections and translations only.
Mat4 read_rigid_transform(Properties& p);

ReadSensor read_sensor(const Element& e, const Context& context);
Film read_film(const Element& e, const Context& context);
PixelFilter read_filter(const Element& e, const Context& context);
SamplerKind read_sampler(const Element& e, const Context& context);

}  // namespace neumann::reader
