#include "tests/search/scene_elements.h"

#include <cmath>
#include <numbers>

namespace neumann::search {

namespace {

std::string place_outside(RandomNumbers& random) {
    const double angle = random.between(0.0, 2.0 * std::numbers::pi), height = random.between(-2.0, 2.0),
                 far = random.between(3.5, 4.5);
    return fmt::format("{:.3f}, {:.3f}, {}", far * std::cos(angle), far * std::sin(angle), height);
}

void add_film(Node sensor, std::uint64_t width, std::uint64_t height, bool box, RandomNumbers& random) {
    Node film = add_object(sensor, "film", "hdrfilm");
    add_whole(film, "width", width);
    add_whole(film, "height", height);
    if (width > 4 && random.chance(0.1)) {
        add_whole(film, "crop_offset_x", 1);
        add_whole(film, "crop_width", width - 2);
    }
    static const std::array<const char*, 5> wide{"tent", "gaussian", "mitchell", "catmullrom", "lanczos"};
    add_object(film, "rfilter", box || random.chance(0.6) ? "box" : random.one_of(wide));
}

void add_view(Node sensor, bool room, double largest_angle, RandomNumbers& random) {
    add_lookat(add_transform(sensor), room ? random.triple(-1.4, 1.4) : place_outside(random), random.triple(-0.5, 0.5));
    add_number(sensor, "fov", random.between(20.0, largest_angle));
}

}  // namespace

void add_camera(Node scene, bool room, const std::vector<Node>& meters, Making& making) {
    RandomNumbers& random = making.random;
    static const std::array<const char*, 6> unusual{"thinlens", "orthographic",  "irradiancemeter",
                                                    "distant",  "radiancemeter", "batch"};
    const std::string type = random.chance(0.75) ? "perspective" : random.one_of(unusual);
    Node sensor;
    std::uint64_t width = random.chance(0.8) ? 4 : 6, height = random.chance(0.8) ? 4 : 5;
    if (type == "irradiancemeter") {
        Node shape = meters[random.below(meters.size())];
        sensor = add_object(shape, "sensor", type);
        width = height = 1;
    } else {
        sensor = add_object(scene, "sensor", type);
    }
    if (type == "perspective" || type == "thinlens") add_view(sensor, room, 80.0, random);
    if (type == "thinlens") {
        add_number(sensor, "aperture_radius", random.between(0.01, 0.3));
        add_number(sensor, "focus_distance", random.between(1.0, 5.0));
    } else if (type == "orthographic") {
        Node transform = add_transform(sensor);
        add_operation(transform, "scale", fmt::format("{}", random.between(0.5, 1.5)));
        add_lookat(transform, room ? random.triple(-1.4, 1.4) : place_outside(random), random.triple(-0.5, 0.5));
    } else if (type == "distant") {
        add_value(sensor, "vector", "direction", random.triple(-1.0, 1.0));
        width = height = 1;
    } else if (type == "radiancemeter") {
        add_lookat(add_transform(sensor), room ? random.triple(-1.4, 1.4) : place_outside(random), random.triple(-0.5, 0.5));
        width = height = 1;
    } else if (type == "batch") {
        for (int i = 0; i < 2; ++i) add_view(add_object(sensor, "sensor", "perspective"), room, 80.0, random);
    }
    add_film(sensor, width, height, type == "batch" || type == "irradiancemeter" || type == "distant", random);
    if (random.chance(0.15)) add_object(sensor, "sampler", "independent");
}

}  // namespace neumann::search
