#include "core/reader/formats/pbrt/shapes.h"

#include "core/base/did_you_mean.h"
#include "core/reader/formats/flattened.h"
#include "core/reader/formats/make_elements.h"
#include "core/reader/meshes/mesh_text.h"
#include "core/reader/xml/transform.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <glm/gtc/matrix_transform.hpp>

namespace neumann::reader::pbrt {

namespace {

// The distance at which the back of a two-sided light is behind its front, relative to its size.
constexpr double thickness = 1e-4;

bool swaps_handedness(const Mat4& m) { return glm::determinant(glm::dmat3(m)) < 0.0; }

Vec3 across(const TriangleMesh& mesh, const std::array<std::uint32_t, 3>& t) {
    return glm::cross(mesh.vertices[t[1]] - mesh.vertices[t[0]], mesh.vertices[t[2]] - mesh.vertices[t[0]]);
}

double area_of(const TriangleMesh& mesh, std::size_t first, std::size_t count, const Mat4& to_world) {
    double area = 0.0;
    for (std::size_t i = first; i < first + count; ++i) {
        const auto& t = mesh.triangles[i];
        const Vec3 a(to_world * glm::dvec4(mesh.vertices[t[1]] - mesh.vertices[t[0]], 0.0)),
            b(to_world * glm::dvec4(mesh.vertices[t[2]] - mesh.vertices[t[0]], 0.0));
        area += 0.5 * glm::length(glm::cross(a, b));
    }
    return area;
}

MeshFile part_of(const MeshFile& file, std::size_t first, std::size_t count) {
    MeshFile part;
    for (std::size_t i = first; i < first + count; ++i) {
        const auto start = static_cast<std::uint32_t>(part.mesh.vertices.size());
        for (const std::uint32_t v : file.mesh.triangles[i]) {
            part.mesh.vertices.push_back(file.mesh.vertices[v]);
            if (!file.normals.empty()) part.normals.push_back(file.normals[v]);
            if (!file.mesh.uv.empty()) part.mesh.uv.push_back(file.mesh.uv[v]);
        }
        part.mesh.triangles.push_back({start, start + 1, start + 2});
    }
    return part;
}

}  // namespace

Shapes::Shapes(PbrtScene& scene, Materials& materials, Textures& textures, Importer& importer)
    : scene_(scene), materials_(materials), textures_(textures), importer_(importer) {
    for (Entity& e : scene.area_lights)
        lights_.push_back(importer.problems.attempt(e.place(), [&] { return read_area_light(e, importer); }));
}

std::vector<Element> Shapes::make() {
    std::vector<Element> all;
    add_objects(all);
    for (ShapeEntity& s : scene_.shapes) importer_.problems.attempt(s.place(), [&] { add(s, all); });
    return all;
}

void Shapes::add(ShapeEntity& s, std::vector<Element>& to) {
    Parameters& p = s.parameters;
    auto form = importer_.problems.attempt(s.place(), [&] { return make_form(s); });
    const auto alpha = textures_.find_number(p, "alpha");
    if (form) p.finish();
    // The material is made first, so that its problems are reported even if the shape has some.
    MadeMaterial material = materials_.use(s.material, form ? form->coordinates : Coordinates::same);
    if (!form && importer_.problems.lenient()) return;  // its type is not known
    if (!form || p.is_wrong()) throw AlreadyReported();
    if (!lay_flat(s, *form)) return;
    if (material.is_interface) {
        if (s.light) importer_.warnings.add("area light on a shape with the material 'interface': left out, as in pbrt");
        return;
    }
    if (alpha && alpha->constant() && alpha->constant()->r >= 1.0) {
        // Everything is opaque.
    } else if (alpha && s.light) {
        throw InputError(p.place("alpha"), fmt::format("alpha of {}, which has an area light: expected one of them", p.title()));
    } else if (alpha) {
        if (alpha->constant() && alpha->constant()->r <= 0.0) return;
        material = materials_.masked(material, *alpha, form->coordinates, p.place("alpha"));
    }
    const bool light_is_left_out = s.light && !lights_[*s.light] && importer_.problems.lenient();
    if (s.light && !light_is_left_out)
        add_lights(s, *form, material, to);
    else
        to.push_back(finished(s, *form, material, std::nullopt));
}

bool Shapes::lay_flat(ShapeEntity& s, Form& form) {
    if (is_invertible(s.to_world)) return true;
    std::optional<MeshFile> flat;
    if (form.mesh && !form.is_round()) flat = flattened(form.mesh->file, s.to_world);
    if (!flat) {
        importer_.warnings.add("a shape whose transformation has no inverse and leaves no area: left out, as in pbrt");
        return false;
    }
    std::erase_if(form.element.children, [](const Element& e) { return e.attribute("name").value == "to_world"; });
    form.mesh->file = std::move(*flat);
    s.to_world = Mat4(1.0);
    return true;
}

void Shapes::add_lights(const ShapeEntity& s, const Form& form, const MadeMaterial& material, std::vector<Element>& to) {
    const std::optional<AreaLight>& light = lights_[*s.light];
    if (!light) throw AlreadyReported();
    const auto add_sides = [&](const Form& part, double area) {
        MadeMaterial own = material;
        own.needs_coordinates = own.needs_coordinates || !light->radiance.constant();
        const Element emitter = light->emitter(area, part.coordinates, importer_);
        to.push_back(finished(s, part, own, emitter));
        if (light->two_sided) to.push_back(finished(s, behind(s, part), own, emitter, true));
    };
    if (form.is_round() || !light->power) {
        add_sides(form, form.area);
        return;
    }
    if (!form.mesh->triangles_of_light)
        throw InputError(light->place,
                         "the power of an area light is on a plymesh with faces of four corners, expected triangles only");
    // Each of pbrt's shapes emits the whole power. Shapes of one size have the same radiance.
    const TriangleMesh& mesh = form.mesh->file.mesh;
    const std::size_t count = *form.mesh->triangles_of_light, parts = mesh.triangles.size() / count;
    std::vector<double> areas;
    for (std::size_t i = 0; i < parts; ++i) areas.push_back(area_of(mesh, i * count, count, s.to_world));
    const auto [least, most] = std::minmax_element(areas.begin(), areas.end());
    if (*most - *least <= 1e-5 * *most) {
        add_sides(form, *most);
        return;
    }
    constexpr std::size_t max_parts = 1000;
    if (parts > max_parts)
        throw InputError(light->place,
                         fmt::format("the power of an area light is on each of {} faces of different size, expected at most "
                                     "{}; give L instead",
                                     parts, max_parts));
    for (std::size_t i = 0; i < parts; ++i) {
        if (areas[i] == 0.0) continue;
        Form part{form.element, form.coordinates, MadeMesh{part_of(form.mesh->file, i * count, count)}};
        add_sides(part, areas[i]);
    }
}

Shapes::Form Shapes::behind(const ShapeEntity& s, const Form& form) {
    importer_.warnings.add("light that shines from both sides: two lights, a ten-thousandth of their size apart");
    Form back = form;
    const std::string& type = form.element.attribute("type").value;
    // The handedness of the transformation turns round shapes as well.
    const double front = s.reversed != swaps_handedness(s.to_world) ? -1.0 : 1.0;
    const auto replace = [&](const std::string& name, auto&& add_new) {
        std::erase_if(back.element.children, [&](const Element& e) { return e.attribute("name").value == name; });
        add_new();
    };
    if (type == "sphere") {
        replace("radius", [&] { add_float(back.element, "radius", form.radius * (1.0 - front * thickness), s.place()); });
        return back;
    }
    if (type == "disk") {
        const Vec3 centre(0.0, 0.0, form.height - front * thickness * form.radius);
        const Mat4 own = glm::scale(glm::translate(Mat4(1.0), centre), Vec3(form.radius, form.radius, 1.0));
        replace("to_world", [&] { add_matrix(back.element, "to_world", s.to_world * own, s.place()); });
        return back;
    }
    if (!form.mesh)
        throw InputError(s.place(),
                         "an area light that shines from both sides is on a cylinder, expected a flat shape or a sphere");
    TriangleMesh& mesh = back.mesh->file.mesh;
    Vec3 normal(0.0), least = mesh.vertices.front(), most = least;
    for (const auto& t : mesh.triangles) normal += across(mesh, t);
    for (const Vec3& v : mesh.vertices) {
        least = glm::min(least, v);
        most = glm::max(most, v);
    }
    const bool is_flat = length_of(normal) > 0.0 && std::all_of(mesh.triangles.begin(), mesh.triangles.end(), [&](const auto& t) {
                             const Vec3 n = across(mesh, t);
                             return glm::dot(n, normal) >= (1.0 - 1e-6) * length_of(n) * length_of(normal);
                         });
    if (!is_flat || (!back.mesh->file.normals.empty() && !form.is_round()))
        throw InputError(
            s.place(),
            "an area light that shines from both sides is on a mesh that is not flat or has normals, expected a flat shape "
            "or a sphere");
    const Vec3 step = glm::normalize(normal) * (length_of(most - least) * thickness *
                                                (form.is_round() ? -front
                                                 : s.reversed    ? 1.0
                                                                 : -1.0));
    for (Vec3& v : mesh.vertices) v += step;
    return back;
}

Element Shapes::finished(const ShapeEntity& s, const Form& form, const MadeMaterial& material, std::optional<Element> emitter,
                         bool turned) {
    Element e = form.element;
    bool flipped = s.reversed != swaps_handedness(s.to_world);
    if (form.mesh) {
        const MeshFile& file = form.mesh->file;
        const bool has_normals = !file.normals.empty();
        if (has_normals && !form.is_round()) flipped = s.reversed;  // normals stay on their side
        const bool lacks_coordinates = material.needs_coordinates && file.mesh.uv.empty();
        add_string(e, "filename", add_mesh(s, lacks_coordinates ? with_coordinates(file) : file), s.place());
        if (!has_normals) add_boolean(e, "face_normals", true, s.place());
    }
    if (flipped != turned) add_boolean(e, "flip_normals", true, s.place());
    add_reference(e, material.id, s.place());
    if (emitter) reader::add(e, std::move(*emitter));
    return e;
}

std::string Shapes::add_mesh(const ShapeEntity& s, MeshFile file) {
    auto& meshes = importer_.scene.in_memory.meshes;
    const std::string stem = fmt::format("meshes/{}-{}", s.type, s.place().line);
    const int number = ++names_[stem];
    const std::string name = number == 1 ? stem + ".ply" : fmt::format("{}-{}.ply", stem, number);
    meshes[name] = std::make_shared<const MeshFile>(std::move(file));
    return name;
}

void Shapes::add_objects(std::vector<Element>& to) {
    std::map<std::string, bool> is_empty;
    std::vector<std::string> names;
    for (auto& [name, object] : scene_.objects) {
        names.push_back(name);
        Element group = make_object("shape", "shapegroup", object.place, "object " + name);
        for (ShapeEntity& s : object.shapes) importer_.problems.attempt(s.place(), [&] { add(s, group.children); });
        is_empty[name] = group.children.empty();
        if (!group.children.empty()) to.push_back(std::move(group));
    }
    for (const Instance& i : scene_.instances) {
        const auto found = is_empty.find(i.object);
        if (found == is_empty.end()) {
            importer_.problems.add(
                InputError(i.place, fmt::format("there is no object '{}'{}", printable(i.object), did_you_mean(i.object, names))),
                i.place);
            continue;
        }
        if (found->second) continue;
        if (!is_invertible(i.to_world)) {
            importer_.warnings.add("an instance whose transformation has no inverse: left out, as in pbrt");
            continue;
        }
        Element e = make_object("shape", "instance", i.place);
        if (i.to_world != Mat4(1.0)) add_matrix(e, "to_world", i.to_world, i.place);
        add_reference(e, "object " + i.object, i.place);
        to.push_back(std::move(e));
    }
}

}  // namespace neumann::reader::pbrt
