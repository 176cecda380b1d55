// Makes the <sensor> from camera, film, pixel filter and sampler, and the <integrator>.
#pragma once

#include "core/reader/formats/pbrt/importer.h"
#include "core/reader/xml/element.h"

namespace neumann::reader::pbrt {

// Takes pbrt's defaults for what the file does not have. Sets the importer's imaging ratio. `scene` gets <default>s for
// what -D sets: width, height and spp.
Element make_sensor(PbrtScene& from, Element& scene, Importer& importer);

Element make_integrator(PbrtScene& from, Importer& importer);

// The film with its filter. Making it multiplies the imaging ratio by the film's part.
struct MadeFilm {
    Element element;
    int width, height;
};
MadeFilm make_film(PbrtScene& from, Element& scene, Importer& importer);
Element make_filter(Entity& e, Importer& importer);

// The object that pbrt takes without a directive.
Entity missing_entity(const std::string& noun, const std::string& type, const PbrtScene& from, Importer& importer);

}  // namespace neumann::reader::pbrt
