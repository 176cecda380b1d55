// Makes the primitives as <shape>s and <emitter>s.
#pragma once

#include "core/reader/formats/tungsten/bsdfs.h"
#include "core/reader/formats/tungsten/mesh_parts.h"

namespace neumann::reader::tungsten {

class Primitives {
public:
    Primitives(JsonObject& root, Bsdfs& bsdfs, Textures& textures, Importing& importing)
        : list_(root.list("primitives")), bsdfs_(bsdfs), textures_(textures), importing_(importing), meshes_(importing) {}

    // Adds the primitives to the scene.
    void add_all();
    // Whether any of them emits.
    bool emit() const { return emit_; }

private:
    using Shapes = std::vector<Element>;

    void add(JsonObject primitive);
    // Makes the shapes of a primitive that is a surface. Throws InputError.
    Shapes make_surface(JsonObject& primitive, const std::string& type);
    Shapes make_mesh(JsonObject& primitive, const Mat4& m);
    Element make_quad(JsonObject& primitive, const Mat4& m);
    Element make_cube(JsonObject& primitive, const Mat4& m);
    Element make_sphere(JsonObject& primitive, const Mat4& m);
    Element make_disk(JsonObject& primitive, const Mat4& m);
    Shapes make_cylinder(JsonObject& primitive, const Mat4& m);
    void add_instances(JsonObject& primitive);
    // The ids of the groups of the instanced things; "" for one that is wrong.
    std::vector<std::string> add_groups(const JsonList& masters);

    // Adds what a primitive of this area emits, and notes whether it emits.
    void add_emission(Element& shape, JsonObject& primitive, double area);
    // Adds material and emission to a round shape, whose texture coordinates differ from Tungsten's.
    void finish_round(Element& shape, JsonObject& primitive, double area);

    JsonList list_;
    Bsdfs& bsdfs_;
    Textures& textures_;
    Importing& importing_;
    MeshParts meshes_;
    std::optional<MeshPart> cube_;
    bool emit_ = false, in_group_ = false;
};

}  // namespace neumann::reader::tungsten
