// A material as the elements of a Mitsuba file.
#pragma once

#include "core/reader/formats/gltf/material.h"
#include "core/reader/xml/element.h"

namespace neumann::reader::gltf {

// What the mesh on which a material is has to do with it.
struct OnMesh {
    bool has_colors = false;   // base colours are the mesh's attribute vertex_color
    bool is_mirrored = false;  // the texture coordinates are, which turns normal maps around
    auto operator<=>(const OnMesh&) const = default;
};

// <bsdf>. Throws InputError where a picture cannot be read.
Element make_bsdf(const Material& material, const OnMesh& mesh, const std::string& id, Pictures& pictures, Warnings& warnings);

// <emitter type="area"> of a material that emits.
Element make_emitter(const Material& material, Pictures& pictures, Warnings& warnings);

}  // namespace neumann::reader::gltf
