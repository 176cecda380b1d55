// Makes a material as the elements of a Mitsuba file.
#pragma once

#include "core/reader/formats/gltf/material.h"
#include "core/reader/xml/element.h"

namespace neumann::reader::gltf {

// Properties of the mesh on which its material depends.
struct OnMesh {
    bool has_colors = false;   // base colours are the mesh's attribute vertex_color
    bool is_mirrored = false;  // texture coordinates are mirrored, which turns normal maps around
    auto operator<=>(const OnMesh&) const = default;
};

// Makes a <bsdf>. Throws InputError if a picture cannot be read.
Element make_bsdf(const Material& material, const OnMesh& mesh, const std::string& id, Pictures& pictures, Warnings& warnings);

// Makes the <emitter type="area"> of a material that emits.
Element make_emitter(const Material& material, Pictures& pictures, Warnings& warnings);

}  // namespace neumann::reader::gltf
