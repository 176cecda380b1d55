// The film of an imported scene.
#pragma once

#include "core/reader/xml/raw_scene.h"

namespace neumann::reader {

struct FilmSize {
    double width, height;  // in pixels, before rounding
    Location place_of_width, place_of_height;
};

// Adds `width` and `height`, which -D width and -D height override. If only one of them is given, the film keeps its shape.
void add_film_size(Element& scene, Element& film, const FilmSize& size, const NamedValues& definitions);

// Adds a film to the sensor of a file that says nothing about it but the aspect, width / height: 768 pixels wide, with
// a Gaussian pixel filter unless -D filter names another.
void add_film(Element& scene, Element& sensor, double aspect, const Location& place, const NamedValues& definitions);
constexpr double usual_aspect = 4.0 / 3.0;

}  // namespace neumann::reader
