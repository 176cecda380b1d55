#include "core/reader/formats/gltf/shapes.h"

#include "core/base/memory.h"
#include "core/reader/formats/flattened.h"
#include "core/reader/formats/gltf/back_side.h"
#include "core/reader/formats/make_elements.h"
#include "core/reader/xml/transform.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

namespace neumann::reader::gltf {

namespace {

void add_instance(Element& scene, const std::string& group, const Placed& placed) {
    Element& e = add(scene, make_object("shape", "instance", placed.place));
    add_reference(e, group, placed.place);
    add_matrix(e, "to_world", placed.to_world, placed.place);
}

Bounds bounds_of(const TriangleMesh& mesh) {
    Bounds bounds;
    for (const Vec3& v : mesh.vertices) bounds.add(v);
    return bounds;
}

// The bounds of the transformed corners of b.
Bounds transformed(const Bounds& b, const Mat4& m) {
    Bounds result;
    for (int i = 0; i < 8; ++i)
        result.add(Vec3(m * glm::dvec4(i & 1 ? b.high.x : b.low.x, i & 2 ? b.high.y : b.low.y, i & 4 ? b.high.z : b.low.z, 1.0)));
    return result;
}

Material default_material() {
    Material m;
    m.name = "default";
    return m;
}

}  // namespace

Shapes::Shapes(JsonObject& root, Accessors& accessors, Pictures& pictures, FilesInMemory& in_memory)
    : notes_(root.notes()),
      meshes_(root.list("meshes")),
      materials_(root.list("materials")),
      textures_(root, pictures),
      accessors_(accessors),
      pictures_(pictures),
      in_memory_(in_memory),
      default_material_(default_material()) {}

const Material& Shapes::material_of(JsonObject& primitive) {
    const auto index = primitive.index("material", materials_, "material");
    if (!index && primitive.has("material")) throw AlreadyReported();
    if (!index) return default_material_;
    const auto [found, is_new] = known_materials_.try_emplace(*index);
    if (is_new)
        notes_.problems.attempt(materials_.place_of(*index), [&, &material = found->second] {
            material = std::make_unique<const Material>(read_material(materials_.object(*index), textures_));
        });
    if (!found->second) throw AlreadyReported();
    return *found->second;
}

std::string Shapes::bsdf_of(Element& scene, const Material& material, const OnMesh& mesh) {
    const auto [found, is_new] = bsdfs_.try_emplace({&material, mesh});
    if (is_new)
        notes_.problems.attempt(material.place, [&, &known = found->second] {
            const std::string id = ids_.unique(material.name);
            neumann::reader::add(scene, make_bsdf(material, mesh, id, pictures_, notes_.warnings));
            known = id;
        });
    if (found->second.empty()) throw AlreadyReported();
    return found->second;
}

// Throws InputError if the triangles need more than half of the memory; the rest of the program keeps this many bytes for each.
void Shapes::expect_memory_for(const MeshFile& file, const Location& place) {
    constexpr double bytes_of_triangle = 300.0, part_of_memory = 0.5;
    triangles_ += static_cast<double>(file.mesh.triangles.size());
    const double bytes = triangles_ * bytes_of_triangle;
    if (bytes > part_of_memory * physical_memory())
        throw InputError(place, fmt::format("with this mesh there are {:.0f} triangles; they need about {:.1f} GiB, more than half "
                                            "of the machine's {:.1f}",
                                            triangles_, bytes / 0x1p30, physical_memory() / 0x1p30));
}

std::vector<Shapes::Part> Shapes::read_parts(Element& scene, std::size_t mesh) {
    JsonObject object = meshes_.object(mesh);
    const std::string name = object.text("name").value_or(fmt::format("mesh_{}", mesh));
    const JsonList primitives = object.list("primitives");
    refuse_morphs(object.list("weights"), notes_.problems);
    object.finish();
    std::vector<Part> parts;
    const auto keep = [&](MeshFile file, const Part& like) {
        expect_memory_for(file, like.place);
        Part part = like;
        part.file = std::make_shared<const MeshFile>(std::move(file));
        part.filename = add_file(name, part.file);
        parts.push_back(std::move(part));
    };
    for (std::size_t i = 0; i < primitives.size(); ++i)
        notes_.problems.attempt(primitives.place_of(i), [&] {
            JsonObject primitive = primitives.object(i);
            const Material& material = material_of(primitive);
            for (PrimitiveMesh& read : read_primitive(primitive, accessors_, material)) {
                const Part like{primitive.place(), name, "", bsdf_of(scene, material, read.traits), &material, nullptr};
                keep(std::move(read.file), like);
                if (material.emits() && material.is_double_sided) keep(back_side(*parts.back().file), like);
            }
        });
    return parts;
}

std::string Shapes::add_file(const std::string& name, std::shared_ptr<const MeshFile> file) {
    const std::string filename = fmt::format("meshes/{}.ply", mesh_names_.unique(name));
    in_memory_.meshes[filename] = std::move(file);
    return filename;
}

std::optional<Element> Shapes::make_shape(const Part& part, const Placed* placed) {
    std::optional<MeshFile> flat;
    const bool is_laid_flat = placed && !is_invertible(placed->to_world);
    if (is_laid_flat && !(flat = flattened(*part.file, placed->to_world))) {
        notes_.warnings.add("a mesh in a node of scale 0 left out");
        return std::nullopt;
    }
    const bool is_flat = is_laid_flat || part.file->normals.empty();
    Element e = make_object("shape", "ply", part.place);
    add_string(e, "filename", flat ? add_file(part.name, std::make_shared<const MeshFile>(std::move(*flat))) : part.filename,
               part.place);
    if (is_flat) add_boolean(e, "face_normals", true, part.place);
    if (placed && !is_laid_flat) {
        add_matrix(e, "to_world", placed->to_world, placed->place);
        // A mesh in a mirror shows the same side. One with normals is turned to their side anyway.
        if (is_flat && glm::determinant(glm::dmat3(placed->to_world)) < 0.0) add_boolean(e, "flip_normals", true, placed->place);
    }
    add_reference(e, part.bsdf, part.place);
    if (part.material->emits()) neumann::reader::add(e, make_emitter(*part.material, pictures_, notes_.warnings));
    return e;
}

void Shapes::add(Element& scene, std::size_t mesh, const std::vector<Placed>& places) {
    const std::vector<Part> parts = read_parts(scene, mesh);
    const auto is_instance = [&](const Placed& placed) { return places.size() > 1 && is_invertible(placed.to_world); };
    std::vector<const Part*> shared;
    for (const Part& part : parts) {
        const Bounds bounds = bounds_of(part.file->mesh);
        for (const Placed& placed : places) bounds_.add(transformed(bounds, placed.to_world));
        if (!part.material->emits() && std::ranges::any_of(places, is_instance)) shared.push_back(&part);
        for (const Placed& placed : places)
            if (part.material->emits() || !is_instance(placed))
                if (auto shape = make_shape(part, &placed)) neumann::reader::add(scene, std::move(*shape));
    }
    if (shared.empty()) return;
    const std::string id = ids_.unique(fmt::format("group_{}", mesh));
    Element group = make_object("shape", "shapegroup", meshes_.place_of(mesh), id);
    for (const Part* part : shared) neumann::reader::add(group, *make_shape(*part, nullptr));
    neumann::reader::add(scene, std::move(group));
    for (const Placed& placed : places)
        if (is_instance(placed)) add_instance(scene, id, placed);
}

}  // namespace neumann::reader::gltf
