// Makes shapes, objects and instances as <shape> elements.
#pragma once

#include "core/reader/formats/pbrt/area_lights.h"
#include "core/reader/formats/pbrt/importer.h"
#include "core/reader/formats/pbrt/materials.h"
#include "core/reader/formats/pbrt/meshes.h"
#include "core/reader/formats/pbrt/textures.h"
#include "core/reader/xml/element.h"

#include <optional>
#include <vector>

namespace neumann::reader::pbrt {

class Shapes {
public:
    Shapes(PbrtScene& scene, Materials& materials, Textures& textures, Importer& importer);

    // Makes all of them.
    std::vector<Element> make();

private:
    // A shape before it has a material.
    struct Form {
        Element element;
        Coordinates coordinates = Coordinates::same;
        std::optional<MadeMesh> mesh = {};              // the mesh, if the shape is one; the element has no file name yet
        double area = 0.0, radius = 0.0, height = 0.0;  // of round shapes, in their own space
        bool is_round() const { return area > 0.0; }
    };

    // Adds the elements of a shape: none for what cannot be seen, and several for some lights.
    void add(ShapeEntity& s, std::vector<Element>& to);
    Form make_form(ShapeEntity& s);
    Form make_sphere(ShapeEntity& s);
    Form make_disk(ShapeEntity& s);
    Form make_cylinder(ShapeEntity& s);
    Form make_mesh(ShapeEntity& s);
    // The mesh of a round shape, whose area in its own space is given.
    Form make_part(ShapeEntity& s, MadeMesh mesh, double area);
    // Puts a mesh where a map without inverse places it. Returns false for what pbrt does not show then.
    bool lay_flat(ShapeEntity& s, Form& form);
    void add_lights(const ShapeEntity& s, const Form& form, const MadeMaterial& material, std::vector<Element>& to);
    // A form behind the given one, which shines to the other side.
    Form behind(const ShapeEntity& s, const Form& form);
    // The element with its mesh, its side, its material and its light.
    Element finished(const ShapeEntity& s, const Form& form, const MadeMaterial& material, std::optional<Element> emitter,
                     bool turned = false);
    std::string add_mesh(const ShapeEntity& s, MeshFile file);
    void add_objects(std::vector<Element>& to);

    PbrtScene& scene_;
    Materials& materials_;
    Textures& textures_;
    Importer& importer_;
    std::vector<std::optional<AreaLight>> lights_;
    std::map<std::string, int> names_;  // how many meshes have each name
};

}  // namespace neumann::reader::pbrt
