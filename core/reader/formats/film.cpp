#include "core/reader/formats/film.h"

#include "core/reader/formats/make_elements.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>

namespace neumann::reader {

namespace {

std::string pixels(double size) {
    constexpr double most = 65536.0;
    return std::to_string(std::lround(std::clamp(size, 1.0, most)));
}

// The definition, or nothing if it is no whole number above 0, which the reader of the film reports.
std::optional<double> defined(const NamedValues& definitions, const std::string& name) {
    const auto found = definitions.find(name);
    if (found == definitions.end()) return std::nullopt;
    const std::string& text = found->second;
    int value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    return error == std::errc() && end == text.data() + text.size() && value > 0 ? std::optional<double>(value) : std::nullopt;
}

}  // namespace

void add_film_size(Element& scene, Element& film, const FilmSize& size, const NamedValues& definitions) {
    const auto width = defined(definitions, "width"), height = defined(definitions, "height");
    const double scale = width ? *width / size.width : height ? *height / size.height : 1.0;
    add_defined(scene, film, "integer", "width", "width", pixels(size.width * scale), size.place_of_width);
    add_defined(scene, film, "integer", "height", "height", pixels(size.height * scale), size.place_of_height);
}

void add_film(Element& scene, Element& sensor, double aspect, const Location& place, const NamedValues& definitions) {
    constexpr double width = 768.0;
    Element& film = add(sensor, make_object("film", "hdrfilm", place));
    add_film_size(scene, film, {width, width / aspect, place, place}, definitions);
    add_defined_type(scene, add(film, make_object("rfilter", "", place)), "filter", "gaussian");
}

}  // namespace neumann::reader
