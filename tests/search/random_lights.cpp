#include "tests/search/scene_elements.h"

namespace neumann::search {

namespace {

void aim(Node light, RandomNumbers& random) {
    add_lookat(add_transform(light), random.triple(-2.0, 2.0), random.triple(-0.5, 0.5));
}

void add_surroundings(Node scene, Making& making) {
    RandomNumbers& random = making.random;
    if (random.chance(0.6)) {
        add_value(add_object(scene, "emitter", "constant"), "rgb", "radiance", random.colour(0.1, 1.0));
    } else if (random.chance(0.7)) {
        Node sky = add_object(scene, "emitter", "sunsky");
        add_value(sky, "vector", "sun_direction",
                  fmt::format("{}, {}, {}", random.between(-1.0, 1.0), random.between(-1.0, 1.0), random.between(0.1, 1.0)));
        // A sun of the usual half degree is hardly met by chance, which is no fault.
        add_number(sky, "sun_aperture", random.between(5.0, 60.0));
        add_number(sky, "sun_scale", random.chance(0.3) ? 0.0 : 1.0);
        add_number(sky, "turbidity", random.between(1.5, 8.0));
    } else {
        const std::string name = fmt::format("surroundings{}.pfm", making.files.size());
        std::string bytes = "PF\n4 3\n-1.0\n";
        for (int i = 0; i < 36; ++i) {
            const auto value = static_cast<float>(random.chance(0.2) ? random.between(1.0, 5.0) : random.between(0.0, 0.5));
            bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
        }
        making.files[name] = bytes;
        add_value(add_object(scene, "emitter", "envmap"), "string", "filename", name);
    }
}

void add_light_without_extent(Node scene, Making& making) {
    RandomNumbers& random = making.random;
    static const std::array<const char*, 5> types{"point", "point", "directional", "spot", "projector"};
    const std::string type = random.one_of(types);
    Node light = add_object(scene, "emitter", type);
    if (type == "point") {
        add_value(light, "point", "position", random.triple(-2.0, 2.0));
        add_value(light, "rgb", "intensity", random.colour(0.5, 4.0));
    } else if (type == "directional") {
        add_value(light, "vector", "direction", random.triple(-1.0, 1.0));
        add_value(light, "rgb", "irradiance", random.colour(0.3, 2.0));
    } else if (type == "spot") {
        aim(light, random);
        add_value(light, "rgb", "intensity", random.colour(1.0, 6.0));
        add_number(light, "cutoff_angle", random.between(10.0, 80.0));
    } else {
        aim(light, random);
        add_value(light, "rgb", "irradiance", random.colour(0.5, 3.0));
        add_number(light, "fov", random.between(20.0, 90.0));
    }
}

}  // namespace

void add_lights(Node scene, bool needed, Making& making) {
    RandomNumbers& random = making.random;
    const bool surroundings = random.chance(0.3);
    const std::uint64_t others = random.chance(0.4) ? random.below(2) + 1 : 0;
    if (surroundings || (needed && others == 0)) add_surroundings(scene, making);
    for (std::uint64_t i = 0; i < others; ++i) add_light_without_extent(scene, making);
}

}  // namespace neumann::search
