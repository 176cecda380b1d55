// Reads <emitter type="area"> and "directionalarea", on its own or on a shape.
#pragma once

#include "core/emitter/emitters.h"
#include "core/reader/plugins/context.h"

namespace neumann::reader {

// Whether an <emitter> is of a type that only shapes have.
inline bool is_of_shapes(const Element& e) {
    const std::string& type = e.attribute("type").value;
    return type == "area" || type == "directionalarea";
}

class AreaLights {
public:
    explicit AreaLights(const Context& context) : context_(context) {}

    // The index of the light, or none for a light with an error. Each element is stored once.
    int index(const Element& e);
    // The same for a light of this shape.
    int index(const Element& e, const Shape& shape);

    bool has(const Element& e) const { return index_.count(&e) > 0; }
    std::vector<AreaLight> take() { return std::move(lights_); }

private:
    AreaLight read(const Element& e) const;
    const Context& context_;
    std::vector<AreaLight> lights_;
    std::map<const Element*, int> index_;
};

}  // namespace neumann::reader
