#include "core/scene/scene.h"

#include "core/scene/coincident_surfaces.h"
#include "core/scene/lost_triangles.h"
#include "core/scene/measured_laws.h"

#include <fmt/format.h>
#include <algorithm>

namespace neumann {

namespace {

// A text such as " (bsdf 'principled' of shape 'obj', room.xml:7:5)".
std::string where(const std::vector<Origin>& origins, std::uint32_t shape) {
    if (shape >= origins.size()) return "";
    const Origin& origin = origins[shape];
    return fmt::format(" ({} of {}, {})", origin.bsdf, origin.shape, to_string(origin.place));
}

// A text such as "shape 'obj' (room.xml:7:5)".
std::string name(const std::vector<Origin>& origins, std::uint32_t shape) {
    if (shape >= origins.size()) return fmt::format("shape {}", shape);
    return fmt::format("{} ({})", origins[shape].shape, to_string(origins[shape].place));
}

InputError error_of(const std::vector<Origin>& origins, std::uint32_t shape, const std::string& what) {
    if (shape >= origins.size()) return InputError(fmt::format("shape {}: {}", shape, what));
    return InputError(origins[shape].place, fmt::format("{}: {}", origins[shape].shape, what));
}

// Within these limits, squares of areas and of squared distances neither overflow nor underflow, so any unit of length works.
constexpr double largest_scene = 1e70, smallest_scene = 1e-70;
// The largest distance of a ray's origin that Embree accepts, in units of the scene's size.
constexpr double farthest_camera = 1e15;

// A text such as ", for shape 'obj' (room.xml:7:5) has a vertex at 0 1e+39 0".
std::string blame(const Geometry& geometry, const std::vector<Origin>& origins, std::uint32_t shape) {
    const std::optional<FarVertex> far = farthest_vertex(geometry, shape);
    if (!far) return "";
    const Vec3& p = far->position;
    return fmt::format(", for {} has a vertex at {:g} {:g} {:g}", name(origins, far->shape), p.x, p.y, p.z);
}

void expect_size(const Geometry& geometry, const std::vector<Origin>& origins) {
    const double size = 2.0 * geometry.radius();
    if (size == 0.0 || (size >= smallest_scene && size <= largest_scene)) return;
    std::uint32_t shape = 0;
    while (shape + 1 < geometry.shapes().size() && !std::holds_alternative<TriangleMesh>(geometry.shapes()[shape])) ++shape;
    throw error_of(origins, shape,
                   fmt::format("the scene is {:.2g} across{}; expected from {:g} to {:g}", size, blame(geometry, origins, shape),
                               smallest_scene, largest_scene));
}

void expect_visible(const Geometry& geometry, const std::vector<Origin>& origins, Warnings& warnings) {
    const double size = 2.0 * geometry.radius();
    const LostTriangles lost = lost_triangles(geometry);
    if (lost.whole)
        throw error_of(origins, *lost.whole,
                       fmt::format("all of its triangles are too small or too thin for rays to meet them in a scene that is {:.2g} "
                                   "across{}; expected at least 1e-7 of that",
                                   size, blame(geometry, origins, *lost.whole)));
    if (lost.count > 0)
        warnings.add(fmt::format("triangle is too thin for rays to meet it in a scene that is {:.2g} across; the first is of {}",
                                 size, name(origins, lost.first)),
                     lost.count);
}

void expect_near(const Geometry& geometry, const SensorOptions& camera, const std::vector<Origin>& origins) {
    for (const SensorOptions& sensor : camera.sensors) expect_near(geometry, sensor, origins);
    if (camera.is_even() || camera.kind == SensorOptions::Kind::batch) return;  // no such limit for these
    const double away = glm::length(geometry.caster().to_embree(Vec3(camera.to_world[3]))),
                 clip = camera.near_clip * geometry.caster().scale();
    if (geometry.radius() == 0.0 || std::max(away, clip) <= farthest_camera) return;
    const std::string what = fmt::format(
        "the sensor looks from {:.2g} away, with a near_clip of {:.2g}, at a scene that is {:.2g} across; expected at "
        "most {:g} times that",
        away / geometry.caster().scale(), camera.near_clip, 2.0 * geometry.radius(), farthest_camera);
    throw origins.empty() ? InputError(what) : InputError(Location{origins.front().place.file}, what);
}

// If nothing is between the planes, pictures are dark and no sample shows why.
void warn_of_clipping(const Geometry& geometry, const SensorOptions& camera, Warnings& warnings) {
    for (const SensorOptions& sensor : camera.sensors) warn_of_clipping(geometry, sensor, warnings);
    if (camera.is_even() || camera.kind == SensorOptions::Kind::batch || geometry.shapes().empty()) return;
    // The depths of the sphere around all shapes along the view.
    const Vec3 to_centre = -geometry.caster().to_embree(Vec3(camera.to_world[3])) / geometry.caster().scale();
    const Vec3 view = Vec3(camera.to_world[2]) / length_of(Vec3(camera.to_world[2]));
    const double middle = glm::dot(to_centre, view), nearest = middle - geometry.radius(), farthest = middle + geometry.radius();
    if (farthest > 0.0 && farthest < camera.near_clip)
        warnings.add(
            fmt::format("the camera sees no surface: all are nearer than its near_clip, {:g}; the farthest are {:.2g} away",
                        camera.near_clip, farthest));
    if (nearest > camera.far_clip)
        warnings.add(fmt::format("the camera sees no surface: all are farther than its far_clip, {:g}; the nearest are {:.2g} away",
                                 camera.far_clip, nearest));
}

// Three digits, and more if an albedo above 1 would be printed as 1.
std::string albedo_text(double albedo) {
    return albedo > 1.0 && albedo < 1.0005 ? fmt::format("1 + {:.1g}", albedo - 1.0) : fmt::format("{:.3f}", albedo);
}

// Names the material with the largest albedo. For materials without guarantees the bound is measured plus 1%, and need not be
// reached.
void warn_of_gain(const Geometry& geometry, const Materials& materials, const std::vector<Origin>& origins, Warnings& warnings) {
    double largest = 1.0;
    std::uint32_t brightest = 0;
    std::size_t shapes = 0;
    bool is_certain = true;
    for (std::uint32_t shape = 0; shape < geometry.shapes().size(); ++shape) {
        bool gains = false;
        for (const bool front : {true, false}) {
            const Bsdf* bsdf = materials.at(shape, front);
            const double albedo = bsdf ? max_component(largest_basic_albedo(*bsdf)) : 0.0;
            gains = gains || albedo > 1.0;
            if (albedo <= largest) continue;
            largest = albedo;
            brightest = shape;
            is_certain = is_lawful(*bsdf);
        }
        shapes += gains;
    }
    if (shapes == 0) return;
    const std::string gives = is_certain ? "gives back" : "may give back";
    warnings.add(fmt::format("reflectance above 1: a surface{} {}{}", where(origins, brightest),
                             std::isinf(largest)
                                 ? fmt::format("{}, without limit, more light than it receives at grazing angles", gives)
                                 : fmt::format("{} up to {} times the light that it receives", gives, albedo_text(largest)),
                             shapes > 1 ? fmt::format("; {} other{} above 1, too", shapes - 1, shapes > 2 ? "s are" : " is") : ""));
}

void warn_of_laws(const MeasuredLaws& laws, const std::vector<Origin>& origins, Warnings& warnings) {
    if (laws.materials == 0) return;
    warnings.add(
        fmt::format("{} material{} neither energy conservation nor reciprocity; the largest albedo is {}{} and the largest "
                    "reciprocity defect "
                    "{:.2g}{}",
                    laws.materials, laws.materials == 1 ? " promises" : "s promise", albedo_text(laws.largest_albedo),
                    where(origins, laws.brightest), laws.reciprocity_defect, where(origins, laws.least_reciprocal)));
}

// No ray meets such lights, and a meter takes no light samples.
void warn_of_missed_light(const SensorOptions& camera, const Emitters& emitters, Warnings& warnings) {
    if (!emitters.has_delta_lights() || !camera.has(SensorOptions::Kind::irradiance_meter)) return;
    warnings.add(
        "sensor 'irradiancemeter' does not measure what comes straight from lights without extent (directional, directionalarea, "
        "point, projector, spot): bounce 0 is without it");
}

void warn_of_coincidence(const CoincidentSurfaces& found, const std::vector<Origin>& origins, Warnings& warnings) {
    warnings.add(
        "part of a light lies in the same place as another shape: which one is seen is chance, and its light may count twice",
        found.lights);
    if (!found.first_unlike) return;
    warnings.add(
        fmt::format("{} and {} face the same way in the same place and are made of different materials: which one is seen "
                    "is chance{}",
                    name(origins, found.first_unlike->first), name(origins, found.first_unlike->second),
                    found.unlike > 2 ? "; others do as well" : ""));
}

}  // namespace

Scene make_scene(SceneParts parts) {
    const auto shared_geometry = std::make_shared<const Geometry>(std::move(parts.shapes));
    const Geometry& geometry = *shared_geometry;
    expect_size(geometry, parts.origins);
    expect_visible(geometry, parts.origins, parts.warnings);
    expect_near(geometry, parts.camera, parts.origins);
    warn_of_clipping(geometry, parts.camera, parts.warnings);
    Materials materials(std::move(parts.bsdfs), std::move(parts.sides_of_shape), geometry.shared_shapes());
    Warnings warnings = std::move(parts.warnings);
    warn_of_coincidence(coincident_surfaces(geometry, materials, parts.lights.of_shape), parts.origins, warnings);
    Emitters emitters(geometry, std::move(parts.lights));
    warnings.add("degenerate triangle or shape without extent left out", geometry.degenerate_count());
    warnings.add("light without area gives off nothing", emitters.without_area());
    if (geometry.shapes().empty()) warnings.add("the scene has no surfaces");
    if (emitters.empty()) warnings.add("the scene has no light");
    warn_of_gain(geometry, materials, parts.origins, warnings);
    warn_of_laws(measure_laws(geometry, materials), parts.origins, warnings);
    warn_of_missed_light(parts.camera, emitters, warnings);
    const Film film = film_of(parts.camera, parts.film);
    const Sensor camera(parts.camera, film, &geometry);
    SceneNotes notes = std::move(parts);
    notes.warnings = std::move(warnings);
    return Scene(shared_geometry, std::move(materials), std::move(emitters), camera, film, std::move(notes));
}

Scene::Scene(std::shared_ptr<const Geometry> g, Materials m, Emitters e, const Sensor& sensor, const Film& f, SceneNotes notes)
    : SceneNotes(std::move(notes)),
      shared_geometry_(std::move(g)),
      shared_emitters_(std::make_shared<const Emitters>(std::move(e))),
      geometry(*shared_geometry_),
      materials(std::move(m)),
      emitters(*shared_emitters_),
      camera(sensor),
      film(f) {}

Scene Scene::with(Materials other) const {
    Scene scene = *this;
    scene.materials = std::move(other);
    return scene;
}

Scene Scene::with(Lights lights) const {
    lights.of_shape.resize(geometry.shapes().size(), Emitters::none);
    return Scene(shared_geometry_, materials, Emitters(geometry, std::move(lights)), camera, film, *this);
}

Scene Scene::with(const SensorOptions& sensor, const Film& other) const {
    Scene scene = *this;
    scene.film = film_of(sensor, other);
    scene.camera = Sensor(sensor, scene.film, &geometry);
    return scene;
}

}  // namespace neumann
