#include "core/reader/formats/collada/shapes.h"

#include "core/geometry/affine.h"
#include "core/reader/formats/collada/corners.h"
#include "core/reader/formats/collada/materials.h"
#include "core/reader/formats/collada/meshes.h"
#include "core/reader/formats/collada/texts.h"
#include "core/reader/formats/flattened.h"
#include "core/reader/formats/make_elements.h"
#include "core/reader/xml/transform.h"

#include <algorithm>
#include <array>
#include <tuple>

#include <fmt/format.h>
#include <oneapi/tbb/parallel_for.h>

namespace neumann::reader::collada {

namespace {

const std::array<std::string, 10> parts_of_mesh = {"extra",  "lines",     "linestrips", "polygons",  "polylist",
                                                   "source", "triangles", "trifans",    "tristrips", "vertices"};

std::string file_name(const std::string& id, std::size_t number) {
    std::string name = id.substr(0, 100);
    for (char& c : name)
        if (static_cast<unsigned char>(c) < ' ' || std::string_view("/\\:*?\"<>|").find(c) != std::string_view::npos) c = '_';
    return fmt::format("meshes/{}{}.ply", name, number == 0 ? "" : fmt::format("-{}", number));
}

class ShapeAdder {
public:
    ShapeAdder(const std::vector<Lamp>& lamps, const Import& import) : lamps_(lamps), import_(import), materials_(import) {}

    void add(const Instance& instance) {
        const Element& geometry = *instance.element;
        if (const Element* radius = radius_of_sphere(geometry)) return add_sphere(instance, *radius);
        const Element* mesh = child(geometry, "mesh");
        if (!mesh)
            throw Unknown(geometry.place, "<geometry> has no <mesh> inside",
                          ", expected one; <convex_mesh>, <spline> and <brep> are not supported", "left out");
        if (checked_.insert(mesh).second) check_children(*mesh, parts_of_mesh, import_.problems);
        for (const Element& primitive : mesh->children)
            if (has_triangles(primitive)) import_.problems.attempt(primitive.place, [&] { add_part(instance, *mesh, primitive); });
    }

    // Adds all shapes to the scene. Meshes that stand at several places with the same material become instances.
    void finish() {
        read_meshes();
        std::vector<Placed> all;
        for (Placed& placed : placed_)
            if (!placed.mesh || (placed.mesh->file && complete(placed))) all.push_back(std::move(placed));

        using Part = std::pair<const Mesh*, std::string>;
        const auto part = [](const Placed& placed) { return Part(placed.mesh, placed.bound.bsdf); };
        std::map<Part, int> places;
        for (const Placed& placed : all) ++places[part(placed)];
        std::set<Part> groups;
        for (Placed& placed : all)
            if (!is_shared(placed, places[part(placed)])) {
                add_alone(std::move(placed));
            } else {
                const bool is_first = groups.insert(part(placed)).second;
                add_of_group(std::move(placed), is_first);
            }
    }

    Bounds bounds;

private:
    struct Mesh {
        const Element *mesh, *primitive;
        Coordinates coordinates;
        std::shared_ptr<const MeshFile> file = {};  // null if it has no triangles or is wrong
        std::string name = {};                      // empty until it is in the scene

        bool is_flat() const { return file->normals.empty(); }
    };
    // A shape element without its place and its material.
    struct Placed {
        Element shape;
        const Instance* instance;
        Bound bound;
        Mesh* mesh = nullptr;  // null for a sphere
    };

    // Whether a shape becomes an instance: it has a mesh that stands at several places, under a map with an inverse.
    bool is_shared(const Placed& placed, int places) const {
        return placed.mesh && !placed.bound.emitter && places > 1 && is_invertible(placed.instance->to_world);
    }

    static const Element* radius_of_sphere(const Element& geometry) {
        const Element* technique = course_technique(geometry);
        const Element* sphere = technique ? child(*technique, "sphere") : nullptr;
        return sphere ? &required_child(*sphere, "radius") : nullptr;
    }

    void add_sphere(const Instance& instance, const Element& radius) {
        const double r = read_number(radius);
        if (!is_invertible(instance.to_world))
            throw InputError(instance.node->place, "the node of a sphere scales it to 0 or flattens it, which only meshes can be");
        const Bound bound = materials_.bound(*instance.use, nullptr);
        Placed sphere{make_object("shape", "sphere", instance.use->place), &instance, bound};
        add_float(sphere.shape, "radius", r, radius.place);
        placed_.push_back(std::move(sphere));
        for (int i = 0; i < 8; ++i) {
            const Vec3 corner((i & 1) != 0 ? r : -r, (i & 2) != 0 ? r : -r, (i & 4) != 0 ? r : -r);
            bounds.add(transformed_point(instance.to_world, corner));
        }
    }

    void add_part(const Instance& instance, const Element& mesh, const Element& primitive) {
        const Bound bound = materials_.bound(*instance.use, primitive.find("material"));
        Mesh& made = meshes_.try_emplace({&primitive, bound.coordinates}, Mesh{&mesh, &primitive, bound.coordinates}).first->second;
        placed_.push_back({make_object("shape", "ply", instance.use->place), &instance, bound, &made});
    }

    // Reads the meshes in parallel, because this takes most of the time of a large file.
    void read_meshes() {
        std::vector<Mesh*> meshes;
        for (auto& [key, mesh] : meshes_) meshes.push_back(&mesh);
        oneapi::tbb::parallel_for(std::size_t{0}, meshes.size(), [&](std::size_t i) {
            Mesh& m = *meshes[i];
            import_.problems.attempt(m.primitive->place,
                                     [&] { m.file = read_mesh(*m.mesh, *m.primitive, m.coordinates, import_.problems); });
        });
    }

    // Completes a part whose mesh has been read. Returns whether it is in the scene.
    bool complete(Placed& part) {
        const Instance& instance = *part.instance;
        Mesh& made = *part.mesh;
        const Location& place = made.primitive->place;
        const std::string& id = required_attribute(*instance.element, "id").value;
        if (made.name.empty()) made.name = add_to_files(made, made.file, id);
        const TriangleMesh& triangles = made.file->mesh;

        if (part.bound.emitter && is_on_a_lamp(triangles, instance)) {
            import_.warnings.add(fmt::format(
                "the geometry '{}' gives off light and lies on an area light: its light counts once, and the geometry is left out",
                required_attribute(*instance.element, "id").value));
            return false;
        }
        std::optional<MeshFile> flat;
        const bool is_laid_flat = !is_invertible(instance.to_world);
        if (is_laid_flat && !(flat = flattened(*made.file, instance.to_world))) {
            import_.warnings.add("a geometry that its node scales to nothing is left out");
            return false;
        }
        add_string(part.shape, "filename",
                   flat ? add_to_files(made, std::make_shared<const MeshFile>(std::move(*flat)), id) : made.name, place);
        if (made.is_flat() || is_laid_flat) add_boolean(part.shape, "face_normals", true, place);
        if (!triangles.uv.empty()) add_boolean(part.shape, "flip_tex_coords", true, place);
        for (const Vec3& v : triangles.vertices) bounds.add(transformed_point(instance.to_world, v));
        return true;
    }

    // Returns the name of the file.
    std::string add_to_files(const Mesh& made, std::shared_ptr<const MeshFile> file, const std::string& id) const {
        auto& files = import_.scene.in_memory.meshes;
        std::string name;
        for (std::size_t number = 0; name.empty() || files.contains(name); ++number) name = file_name(id, number);
        files[name] = std::move(file);
        if (has_vertex_colors(*made.mesh, *made.primitive))
            import_.warnings.add("colours of vertices are left out: no material of COLLADA uses them");
        return name;
    }

    void add_alone(Placed placed) const {
        const Instance& instance = *placed.instance;
        if (placed.mesh && placed.mesh->is_flat() && is_invertible(instance.to_world) && is_mirroring(instance.to_world))
            add_boolean(placed.shape, "flip_normals", true, instance.node->place);
        add_to_world(placed.shape, instance);
        add_surface(placed);
        reader::add(import_.scene.root, std::move(placed.shape));
    }

    void add_of_group(Placed placed, bool is_first) const {
        const Instance& instance = *placed.instance;
        const std::string group = fmt::format("instances of {}, {}", placed.mesh->name, placed.bound.bsdf);
        if (is_first) {
            add_surface(placed);
            Element e = make_object("shape", "shapegroup", instance.use->place);
            e.attributes.push_back({"id", group, instance.use->place});
            reader::add(e, std::move(placed.shape));
            reader::add(import_.scene.root, std::move(e));
        }
        Element e = make_object("shape", "instance", instance.use->place);
        add_reference(e, group, instance.use->place);
        add_to_world(e, instance);
        reader::add(import_.scene.root, std::move(e));
    }

    static void add_to_world(Element& e, const Instance& instance) {
        if (instance.to_world != Mat4(1.0) && is_invertible(instance.to_world))
            add_matrix(e, "to_world", instance.to_world, instance.node->place);
    }
    static void add_surface(Placed& placed) {
        const Location& place = placed.instance->use->place;
        if (!placed.bound.bsdf.empty())
            add_reference(placed.shape, placed.bound.bsdf, place);
        else if (!placed.bound.emitter)
            reader::add(placed.shape, default_bsdf(place));
        if (placed.bound.emitter) reader::add(placed.shape, *placed.bound.emitter);
    }

    bool is_on_a_lamp(const TriangleMesh& mesh, const Instance& instance) const {
        return std::any_of(lamps_.begin(), lamps_.end(), [&](const Lamp& lamp) {
            Bounds on_lamp;
            for (const Vec3& v : mesh.vertices) on_lamp.add(lamp.coordinates(transformed_point(instance.to_world, v)));
            constexpr double thickness = 1e-4;  // relative to the lamp's size
            return std::max(std::abs(on_lamp.low.z), std::abs(on_lamp.high.z)) <= thickness && on_lamp.low.x < 1.0 &&
                   on_lamp.high.x > -1.0 && on_lamp.low.y < 1.0 && on_lamp.high.y > -1.0;
        });
    }

    const std::vector<Lamp>& lamps_;
    const Import& import_;
    MaterialReader materials_;
    std::map<std::tuple<const Element*, Coordinates>, Mesh> meshes_;
    std::set<const Element*> checked_;
    std::vector<Placed> placed_;
};

}  // namespace

Bounds add_shapes(const std::vector<Instance>& geometries, const std::vector<Lamp>& lamps, const Import& import) {
    ShapeAdder adder(lamps, import);
    for (const Instance& instance : geometries)
        if (instance.is_placed) import.problems.attempt(instance.use->place, [&] { adder.add(instance);
});
adder.finish();
return adder.bounds;
}  // namespace neumann::reader::collada

}  // namespace neumann::reader::collada
