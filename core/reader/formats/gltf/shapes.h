// Adds the meshes of a glTF file as <shape>s, with their materials.
#pragma once

#include "core/geometry/bounds.h"
#include "core/reader/formats/gltf/nodes.h"
#include "core/reader/formats/gltf/primitive.h"
#include "core/reader/xml/raw_scene.h"

#include <map>
#include <memory>
#include <optional>

namespace neumann::reader::gltf {

class Shapes {
public:
    Shapes(JsonObject& root, Accessors& accessors, Pictures& pictures, FilesInMemory& in_memory);

    // Adds a mesh at all of its places to the scene, and the materials that are not there yet. A mesh at several places
    // becomes a group and instances of it; what emits becomes copies.
    void add(Element& scene, std::size_t mesh, const std::vector<Placed>& places);

    const Bounds& bounds() const { return bounds_; }

private:
    // The part of a mesh that has one material.
    struct Part {
        Location place;
        std::string name, filename, bsdf;
        const Material* material;
        std::shared_ptr<const MeshFile> file;
    };

    std::vector<Part> read_parts(Element& scene, std::size_t mesh);
    const Material& material_of(JsonObject& primitive);
    std::string bsdf_of(Element& scene, const Material& material, const OnMesh& mesh);
    std::string add_file(const std::string& name, std::shared_ptr<const MeshFile> file);
    // Returns nothing, with a warning, if a map without an inverse leaves no area.
    std::optional<Element> make_shape(const Part& part, const Placed* placed);
    void expect_memory_for(const MeshFile& file, const Location& place);

    Notes& notes_;
    JsonList meshes_, materials_;
    Textures textures_;
    Accessors& accessors_;
    Pictures& pictures_;
    FilesInMemory& in_memory_;
    Names mesh_names_, ids_;
    std::map<std::size_t, std::unique_ptr<const Material>> known_materials_;  // null: a reported error
    const Material default_material_;
    std::map<std::pair<const Material*, OnMesh>, std::string> bsdfs_;  // ids; empty: a reported error
    Bounds bounds_;
    double triangles_ = 0.0;
};

}  // namespace neumann::reader::gltf
