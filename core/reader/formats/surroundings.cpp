#include "core/reader/formats/surroundings.h"

#include "core/reader/formats/make_elements.h"

#include <algorithm>
#include <utility>

namespace neumann::reader {

void add_surroundings(Element& scene, Warnings& warnings) {
    warnings.add(
        "the file has no light: everything is surrounded by white light of radiance 1, or of another that -D surroundings "
        "gives");
    Element emitter = make_object("emitter", "constant", scene.place);
    add_defined(scene, emitter, "rgb", "radiance", "surroundings", "1", scene.place);
    add(scene, std::move(emitter));
}

bool has_emitters(const Element& scene) {
    return std::ranges::any_of(scene.children, [](const Element& e) { return e.tag == "emitter" || has_emitters(e); });
}

}  // namespace neumann::reader
