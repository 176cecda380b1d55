// Camera, film, pixel filter and sampler as a <sensor>, and the <integrator>.
#pragma once

#include "core/reader/formats/pbrt/importer.h"
#include "core/reader/xml/element.h"

namespace neumann::reader::pbrt {

// What pbrt has where a file has none. Sets the importer's imaging ratio. `scene` gets <default>s for what -D sets: width, height
// and spp.
Element make_sensor(PbrtScene& from, Element& scene, Importer& importer);

Element make_integrator(PbrtScene& from, Importer& importer);

// The film with its filter; adds the film's part of the imaging ratio.
struct MadeFilm {
    Element element;
    int width, height;
};
MadeFilm make_film(PbrtScene& from, Element& scene, Importer& importer);
Element make_filter(Entity& e, Importer& importer);

// What pbrt has without a directive.
Entity missing_entity(const std::string& noun, const std::string& type, const PbrtScene& from, Importer& importer);

}  // namespace neumann::reader::pbrt
