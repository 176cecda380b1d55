// Reads materials, and how an <instance_geometry> binds them to the parts of a mesh.
#pragma once

#include "core/reader/formats/collada/meshes.h"
#include "core/reader/formats/collada/surface.h"

#include <map>

namespace neumann::reader::collada {

struct Bound {
    std::string bsdf;  // id of the bsdf; if empty, a shape that does not emit gets the default one
    const Element* emitter = nullptr;
    Coordinates coordinates = {};
};

class MaterialReader {
public:
    explicit MaterialReader(const Import& import) : import_(import) {}

    // What is bound to a part with this symbol, or without one; nothing, with a warning, if no material is. Throws
    // InputError if only other symbols are bound, or if the material is not in the file.
    Bound bound(const Element& instance_geometry, const Attribute* symbol);

private:
    struct Made {
        Surface surface;
        std::string id;
    };
    const Made& make(const Element& material);
    Surface read(const Element& material) const;

    const Import& import_;
    std::map<const Element*, Made> made_;
};

}  // namespace neumann::reader::collada
