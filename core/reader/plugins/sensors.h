// Reads <sensor>, with its film and sampler.
#pragma once

#include "core/reader/plugins/context.h"
#include "core/reader/plugins/shape_plugins.h"
#include "core/reader/xml/properties.h"
#include "core/scene/scene.h"

#include <set>

namespace neumann::reader {

struct ReadSensor {
    SensorOptions camera;
    Film film;
    std::optional<SamplerKind> sampler;
    std::set<const Element*> meters;  // sensors of shapes that are part of it
};

// The angle given by `fov` with its axis or by `focal_length`; Mitsuba's default is a lens of 50 mm.
struct FieldOfView {
    double angle;  // full, in radians
    FovAxis axis;
};
FieldOfView read_field_of_view(Properties& p);
// Reads a transform that must consist of rotations, reflections and translations.
Mat4 read_rigid_transform(Properties& p);

// `shapes` are those of the scene.
ReadSensor read_sensor(const Element& e, const Context& context, const std::vector<ReadShape>& shapes);
Film read_film(const Element& e, const Context& context);
PixelFilter read_filter(const Element& e, const Context& context);
SamplerKind read_sampler(const Element& e, const Context& context);

}  // namespace neumann::reader
