#include "core/reader/formats/collada/lights.h"

#include "core/reader/formats/collada/sky.h"
#include "core/reader/formats/collada/spot.h"
#include "core/reader/formats/collada/texts.h"
#include "core/reader/formats/make_elements.h"
#include "core/reader/xml/transform.h"

#include <algorithm>
#include <array>
#include <span>

#include <fmt/format.h>

namespace neumann::reader::collada {

namespace {

const std::array<std::string, 4> parts_of_light = {"asset", "extra", "technique", "technique_common"};
const std::array<std::string, 4> common_kinds = {"ambient", "directional", "point", "spot"};
const std::array<std::string, 6> course_kinds = {"ambient", "area", "directional", "hemisphere", "point", "spot"};
const std::array<std::string, 7> parts_of_kind = {
    "color", "constant_attenuation", "falloff_angle", "falloff_exponent", "linear_attenuation", "quadratic_attenuation", "zfar"};

Vec3 unit_column(const Mat4& m, int column) {
    const Vec3 v(m[column]);
    const double length = length_of(v);
    return length > 0.0 ? v / length : Vec3(0.0);
}

class LightAdder {
public:
    LightAdder(int up, const Import& import) : up_(up), import_(import) {}

    void add(const Instance& instance) {
        const Element& light = *instance.element;
        check_children(light, parts_of_light, import_.problems);
        const Element* course = course_technique(light);
        const Element& technique = course ? *course : required_child(light, "technique_common");
        const std::span<const std::string> kinds = course ? std::span<const std::string>(course_kinds) : common_kinds;
        check_children(technique, kinds, import_.problems);
        if (technique.children.empty())
            throw InputError(technique.place, "<technique> of a light has no light inside, expected one");
        const Element& kind = technique.children.front();
        if (std::ranges::find(kinds, kind.tag) == kinds.end()) return;  // already reported
        check_children(kind, parts_of_kind, import_.problems);
        if ((kind.tag == "directional" || kind.tag == "spot") && !is_invertible(instance.to_world))
            throw InputError(instance.node->place, "the node of a light scales it to 0: it does not tell where the light shines");
        const Rgb color = read_color(required_child(kind, "color")).rgb;
        if (kind.tag == "directional") add_directional(instance, kind, color);
        if (kind.tag == "point") add_point_light(instance, kind, color);
        if (kind.tag == "spot") add_spot(instance, kind, color);
        if (kind.tag == "area") add_area(instance, kind, color);
        if (kind.tag == "hemisphere" || (kind.tag == "ambient" && import_.file.is_of_course())) add_to(from_above_, kind, color);
        if (kind.tag == "ambient" && !import_.file.is_of_course()) add_to(from_everywhere_, kind, color);
    }

    void add_surroundings() const {
        if (from_above_.place) {
            import_.warnings.add(
                "an ambient light shines from the upper half of the sky, as in the course's program, and is seen there");
            reader::add(import_.scene.root, make_sky(from_above_.radiance, up_, *from_above_.place, import_.scene));
        } else if (from_everywhere_.place) {
            Element emitter = make_object("emitter", "constant", *from_everywhere_.place);
            add_rgb(emitter, "radiance", from_everywhere_.radiance, emitter.place);
            reader::add(import_.scene.root, std::move(emitter));
        }
    }

    std::vector<Lamp> lamps;

private:
    // The sum of all lights of a kind, because only one can surround the scene.
    struct Sum {
        Rgb radiance{0.0};
        std::optional<Location> place = {};
    };
    static void add_to(Sum& sum, const Element& kind, const Rgb& color) {
        sum.radiance += color;
        if (!sum.place) sum.place = kind.place;
    }

    void add_directional(const Instance& instance, const Element& kind, const Rgb& color) {
        Element emitter = make_object("emitter", "directional", kind.place);
        add_vector(emitter, "direction", -unit_column(instance.to_world, 2), instance.node->place);
        add_rgb(emitter, "irradiance", color, kind.place);
        reader::add(import_.scene.root, std::move(emitter));
    }

    // The intensity of a light that falls off with the square of the distance and is as bright at the distance 1.
    Rgb intensity(const Element& kind, const Rgb& color) const {
        const auto attenuation = [&](const char* tag, double missing) {
            const Element* e = child(kind, tag);
            const double value = e ? read_number(*e) : missing;
            if (value < 0.0) throw InputError(e->place, fmt::format("<{}> is {}, expected at least 0", tag, value));
            return value;
        };
        const double constant = attenuation("constant_attenuation", 1.0), linear = attenuation("linear_attenuation", 0.0),
                     quadratic = attenuation("quadratic_attenuation", 0.0), at_one = constant + linear + quadratic;
        if (at_one == 0.0) throw InputError(kind.place, "the attenuations of a light are all 0, expected one that is not");
        if (constant + linear > 0.0)
            import_.warnings.add(
                "a light falls off otherwise than with the square of the distance; it is taken as one that does, as "
                "bright as that at the distance 1");
        return color / at_one;
    }

    void add_point_light(const Instance& instance, const Element& kind, const Rgb& color) {
        Element emitter = make_object("emitter", "point", kind.place);
        add_point(emitter, "position", Vec3(instance.to_world[3]), instance.node->place);
        add_rgb(emitter, "intensity", intensity(kind, color), kind.place);
        reader::add(import_.scene.root, std::move(emitter));
    }

    void add_spot(const Instance& instance, const Element& kind, const Rgb& color) {
        const Element *angle = child(kind, "falloff_angle"), *exponent = child(kind, "falloff_exponent");
        const double degrees = angle ? read_number(*angle) : 180.0, power = exponent ? read_number(*exponent) : 0.0;
        if (!(degrees > 0.0 && degrees <= 180.0))
            throw InputError(angle->place,
                             fmt::format("<falloff_angle> is {}, expected more than 0 and at most 180 degrees", degrees));
        if (!(power >= 0.0)) throw InputError(exponent->place, fmt::format("<falloff_exponent> is {}, expected at least 0", power));
        if (power > 0.0)
            import_.warnings.add(
                "a spot light falls off with a power of the cosine; it is taken as one that falls off linearly with "
                "the angle, of the same total power");
        const double cutoff = 0.5 * degrees;
        Element emitter = make_object("emitter", "spot", kind.place);
        add_rgb(emitter, "intensity", intensity(kind, color), kind.place);
        add_float(emitter, "cutoff_angle", cutoff, angle ? angle->place : kind.place);
        add_float(emitter, "beam_width", spot_beam_width(cutoff, power), kind.place);
        add_matrix(emitter, "to_world", facing_back(instance.to_world), instance.node->place);
        reader::add(import_.scene.root, std::move(emitter));
    }

    // Adds the square [-½, ½]² of the node's x and y, facing −z. As in the course's program, z only decides the sign of the normal.
    void add_area(const Instance& instance, const Element& kind, const Rgb& color) {
        const Mat4& m = instance.to_world;
        Lamp lamp{Vec3(m[3]), 0.5 * Vec3(m[0]), 0.5 * Vec3(m[1]), {}};
        const Vec3 across = unit_column(m, 0), up = unit_column(m, 1);
        const Vec3 normal = glm::cross(across, up);
        const double sine = length_of(normal);
        if (!(sine > 1e-9)) throw InputError(instance.node->place, "an area light has no area: its node has no inverse");
        lamp.normal = normal / sine;
        if (glm::dot(lamp.normal, Vec3(m[2])) > 0.0) {
            lamp.normal = -lamp.normal;
            lamp.a = -lamp.a;
        }
        lamps.push_back(lamp);
        Element shape = make_object("shape", "rectangle", kind.place);
        add_matrix(
            shape, "to_world",
            Mat4(glm::dvec4(lamp.a, 0.0), glm::dvec4(lamp.b, 0.0), glm::dvec4(lamp.normal, 0.0), glm::dvec4(lamp.center, 1.0)),
            instance.node->place);
        Element emitter = make_object("emitter", "area", kind.place);
        add_rgb(emitter, "radiance", color, kind.place);
        reader::add(shape, std::move(emitter));
        reader::add(import_.scene.root, std::move(shape));
    }

    const int up_;
    const Import& import_;
    Sum from_above_, from_everywhere_;
};

}  // namespace

Vec3 Lamp::coordinates(const Vec3& p) const {
    const Vec3 from = p - center;
    const double aa = glm::dot(a, a), ab = glm::dot(a, b), bb = glm::dot(b, b), gram = aa * bb - ab * ab;
    const double fa = glm::dot(from, a), fb = glm::dot(from, b);
    return {(fa * bb - fb * ab) / gram, (fb * aa - fa * ab) / gram, glm::dot(from, normal) / (glm::length(a) + glm::length(b))};
}

std::vector<Lamp> add_lights(const std::vector<Instance>& lights, int up, const Import& import) {
    LightAdder adder(up, import);
    for (const Instance& instance : lights)
        if (instance.is_placed) import.problems.attempt(instance.use->place, [&] { adder.add(instance);
});
adder.add_surroundings();
return std::move(adder.lamps);
}  // namespace neumann::reader::collada

}  // namespace neumann::reader::collada
