// The primitives as <shape>s and <emitter>s.
#pragma once

#include "core/reader/formats/tungsten/bsdfs.h"
#include "core/reader/formats/tungsten/mesh_parts.h"

namespace neumann::reader::tungsten {

class Primitives {
public:
    Primitives(JsonObject& root, Bsdfs& bsdfs, Textures& textures, Importing& importing)
        : list_(root.list("primitives")), bsdfs_(bsdfs), textures_(textures), importing_(importing), meshes_(importing) {}

    // Adds them to the scene.
    void add_all();
    // Whether one of them emits.
    bool emit() const { return emit_; }

private:
    using Shapes = std::vector<Element>;

    void add(JsonObject primitive);
    // Of what is a surface. Throws InputError.
    Shapes make_surface(JsonObject& primitive, const std::string& type);
    Shapes make_mesh(JsonObject& primitive, const Mat4& m);
    Element make_quad(JsonObject& primitive, const Mat4& m);
    Element make_cube(JsonObject& primitive, const Mat4& m);
    Element make_sphere(JsonObject& primitive, const Mat4& m);
    Element make_disk(JsonObject& primitive, const Mat4& m);
    Shapes make_cylinder(JsonObject& primitive, const Mat4& m);
    void add_instances(JsonObject& primitive);
    // Of each of the things that are instanced; "" for one that is wrong.
    std::vector<std::string> add_groups(const JsonList& masters);

    // What it emits, from this area, and whether it does.
    void add_emission(Element& shape, JsonObject& primitive, double area);
    // Material and emission of a round shape, whose coordinates are others here.
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
