#include "core/reader/formats/collada/materials.h"

#include "core/base/did_you_mean.h"
#include "core/reader/formats/collada/texts.h"
#include "core/reader/formats/make_elements.h"

#include <fmt/format.h>

namespace neumann::reader::collada {

namespace {

std::vector<const Element*> bindings_of(const Element& instance_geometry) {
    std::vector<const Element*> bindings;
    const Element* bind = child(instance_geometry, "bind_material");
    const Element* technique = bind ? child(*bind, "technique_common") : nullptr;
    if (!technique) return bindings;
    for (const Element& e : technique->children)
        if (e.tag == "instance_material") bindings.push_back(&e);
    return bindings;
}

// The binding of a symbol; null if nothing is bound at all, or if a part without a symbol has several bindings.
const Element* binding_of(const Element& instance_geometry, const Attribute* symbol) {
    const std::vector<const Element*> bindings = bindings_of(instance_geometry);
    if (bindings.empty()) return nullptr;
    if (!symbol) return bindings.size() == 1 ? bindings.front() : nullptr;
    std::vector<std::string> symbols;
    for (const Element* e : bindings) {
        symbols.push_back(required_attribute(*e, "symbol").value);
        if (symbols.back() == symbol->value) return e;
    }
    throw InputError(instance_geometry.place,
                     fmt::format("no material is bound to the symbol '{}' at {}; bound: {}{}", symbol->value,
                                 to_string(symbol->place), join(symbols), did_you_mean(symbol->value, symbols)));
}

// The set of texture coordinates to which the name is bound, if any.
std::optional<int> set_of(const Element& binding, const std::string& name) {
    for (const Element& e : binding.children) {
        if (e.tag != "bind_vertex_input" || required_attribute(e, "semantic").value != name) continue;
        const Attribute& kind = required_attribute(e, "input_semantic");
        if (kind.value != "TEXCOORD")
            throw InputError(kind.place, fmt::format("input_semantic is '{}', expected TEXCOORD", kind.value));
        const Attribute* set = e.find("input_set");
        return set ? static_cast<int>(std::min<std::size_t>(read_count(*set), 1 << 20)) : 0;
    }
    return std::nullopt;
}

Coordinates coordinates_of(const Element& binding, const std::set<std::string>& names) {
    Coordinates result{!names.empty()};
    bool is_first = true;
    for (const std::string& name : names) {
        const std::optional<int> set = set_of(binding, name);
        if (!is_first && set != result.set)
            throw InputError(binding.place,
                             "the pictures of a material use several sets of texture coordinates, expected one for all of them");
        result.set = set;
        is_first = false;
    }
    return result;
}

}  // namespace

Bound MaterialReader::bound(const Element& instance_geometry, const Attribute* symbol) {
    const Element* binding = binding_of(instance_geometry, symbol);
    if (!binding) {
        import_.warnings.add("no material is bound to a part of a geometry, which is taken as diffuse with the albedo 0.5");
        return {};
    }
    const Made& made = make(import_.file.find(required_attribute(*binding, "target"), "material"));
    return {made.id, made.surface.emitter ? &*made.surface.emitter : nullptr, coordinates_of(*binding, made.surface.coordinates)};
}

const MaterialReader::Made& MaterialReader::make(const Element& material) {
    const auto known = made_.find(&material);
    if (known != made_.end()) return known->second;
    Made& made = made_[&material];
    const auto surface = import_.problems.attempt(material.place, [&] { return read(material); });
    if (!surface) return made;
    made.surface = *surface;
    if (!surface->bsdf) return made;
    made.id = required_attribute(material, "id").value;
    Element bsdf = *surface->bsdf;
    bsdf.attributes.push_back(make_object("bsdf", "", material.place, made.id).attributes.back());
    add(import_.scene.root, std::move(bsdf));
    return made;
}

Surface MaterialReader::read(const Element& material) const {
    const Element& use = required_child(material, "instance_effect");
    if (const Element* e = child(use, "setparam"))
        import_.problems.replace(
            Unknown(e->place, "<setparam> is not supported", ", expected its value in the <effect>", "ignored"), e->place);
    const Element& effect = import_.file.find(required_attribute(use, "url"), "effect");
    const std::string name = required_attribute(material, "id").value;
    if (const Element* technique = course_technique(effect)) return read_course_effect(*technique, name, import_);
    return read_common_effect(effect, name, import_);
}

}  // namespace neumann::reader::collada
