// What each leaving-out saves: on scenes that do not need the part, seconds and rays with the plan, with only this part kept, and
// with nothing left out, in turn in one run. Seconds are of the processor, on one thread, the least, and beside them the median of
// the ratios to those with the plan in the same repetition, for a machine that does other work is slow by turns.
//
//     bench_plan [REPETITIONS]
#include "core/reader/read_scene.h"
#include "operators/render/from_paths/picture_sampler.h"
#include "operators/render/plan/plan.h"

#include <fmt/format.h>
#include <oneapi/tbb/global_control.h>
#include <algorithm>
#include <cstdio>
#include <ctime>
#include <memory>
#include <numeric>

namespace {

using namespace neumann;

constexpr int bounces = 8, resolution = 24;

double processor_seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

struct Run {
    explicit Run(const Scene& scene, const LeftOut& left_out)
        : sampler(scene, {.walk = {.bounces = bounces, .left_out = left_out, .rest_probability = 0.0}, .replicate_size = 32}) {}

    void once() {
        Tally tally(sampler.quantities());
        const double begin = processor_seconds();
        auto node = sampler.run(0, 1, tally, {}, std::move(memory));
        seconds.push_back(processor_seconds() - begin);
        memory = std::move(node->data);
        rays = std::accumulate(tally.rays.begin(), tally.rays.end(), std::uint64_t{0});
    }

    PictureSampler sampler;
    std::vector<double> seconds{};  // of each repetition
    std::uint64_t rays = 0;
    std::vector<double> memory{};
};

double median_ratio(const Run& a, const Run& b) {
    std::vector<double> ratios;
    for (std::size_t i = 0; i < a.seconds.size(); ++i) ratios.push_back(a.seconds[i] / b.seconds[i]);
    const auto middle = ratios.begin() + static_cast<std::ptrdiff_t>(ratios.size() / 2);
    std::nth_element(ratios.begin(), middle, ratios.end());
    return *middle;
}

Scene stock(const char* name) {
    return read_scene(std::string(SCENES "/") + name + "/" + name + ".xml", {{"res", std::to_string(resolution)}});
}

// Looks along +y.
SceneParts parts_seen_from(const Vec3& place) {
    SceneParts parts;
    parts.camera.to_world = Mat4(1.0);
    parts.camera.to_world[1] = {0.0, 0.0, 1.0, 0.0};
    parts.camera.to_world[2] = {0.0, 1.0, 0.0, 0.0};
    parts.camera.to_world[3] = {place, 1.0};
    parts.camera.fov = 1.2;
    parts.film.width = parts.film.crop_width = parts.film.height = parts.film.crop_height = resolution;
    parts.film.filter = BoxFilter();
    return parts;
}

void add(SceneParts& parts, const Mat4& to_world, bool inwards, double reflectance, std::optional<double> radiance) {
    parts.shapes.push_back(make_cube(to_world, inwards));
    parts.sides_of_shape.push_back({static_cast<int>(parts.bsdfs.size()), Materials::absorbing});
    parts.bsdfs.push_back(Diffuse(Rgb(reflectance)));
    parts.lights.of_shape.push_back(radiance ? static_cast<int>(parts.lights.area.size()) : Emitters::none);
    if (radiance) parts.lights.area.push_back(AreaLight(Rgb(*radiance)));
}

Mat4 box(const Vec3& center, const Vec3& half) {
    Mat4 m(1.0);
    for (int i = 0; i < 3; ++i) m[i][i] = half[i];
    m[3] = {center, 1.0};
    return m;
}

// A room whose walls shine with two different radiances: no furnace.
Scene convex_room() {
    SceneParts parts = parts_seen_from({0.0, -0.9, 0.0});
    add(parts, box(Vec3(0.0), Vec3(1.0)), true, 0.7, std::nullopt);
    auto& mesh = std::get<TriangleMesh>(parts.shapes.front());
    TriangleMesh lamp = mesh;
    lamp.triangles.erase(lamp.triangles.begin(), lamp.triangles.end() - 2);
    mesh.triangles.resize(mesh.triangles.size() - 2);
    add(parts, Mat4(1.0), true, 0.7, 1.0);
    parts.shapes.back() = lamp;
    return make_scene(std::move(parts));
}
Scene grey_room_with_boxes() {
    SceneParts parts = parts_seen_from({0.0, -0.9, 0.0});
    add(parts, box(Vec3(0.0), Vec3(1.0)), true, 0.7, std::nullopt);
    add(parts, box({-0.4, 0.4, -0.6}, {0.3, 0.3, 0.4}), false, 0.7, std::nullopt);
    add(parts, box({0.4, 0.1, -0.8}, {0.2, 0.2, 0.2}), false, 0.7, std::nullopt);
    add(parts, box({0.0, 0.2, 0.9}, {0.3, 0.3, 0.05}), false, 0.7, 5.0);
    return make_scene(std::move(parts));
}
Scene room_lit_by_a_point() {
    SceneParts parts = parts_seen_from({0.0, -0.9, 0.0});
    add(parts, box(Vec3(0.0), Vec3(1.0)), true, 0.7, std::nullopt);
    add(parts, box({-0.4, 0.4, -0.6}, {0.3, 0.3, 0.4}), false, 0.5, std::nullopt);
    parts.bsdfs.back() = Diffuse(Rgb(0.6, 0.4, 0.2));
    parts.lights.delta = {PointLight({0.2, 0.0, 0.8}, Rgb(1.0))};
    return make_scene(std::move(parts));
}
// Two-sided walls and a lamp, seen from outside: the camera sees backs, where no light comes.
Scene room_seen_from_outside() {
    SceneParts parts = parts_seen_from({0.0, -6.0, 0.0});
    add(parts, box(Vec3(0.0), Vec3(1.0)), true, 0.7, std::nullopt);
    parts.sides_of_shape.back().back = 0;
    add(parts, box({0.0, 0.2, 0.9}, {0.3, 0.3, 0.05}), false, 0.7, 5.0);
    return make_scene(std::move(parts));
}
Scene box_under_a_sky() {
    SceneParts parts = parts_seen_from({0.0, -3.0, 0.0});
    add(parts, box(Vec3(0.0), Vec3(1.0)), false, 0.7, std::nullopt);
    Image sky(8, 5);
    for (std::size_t i = 0; i < sky.pixels.size(); ++i) sky.pixels[i] = Rgb(0.1 * static_cast<double>(i), 1.0, 2.0);
    parts.lights.environment = EnvironmentMap(sky, 1.0, Mat4(1.0));
    return make_scene(std::move(parts));
}

}  // namespace

int main(int argc, char** argv) {
    const int repetitions = argc > 1 ? std::stoi(argv[1]) : 101;
    const oneapi::tbb::global_control one_thread(oneapi::tbb::global_control::max_allowed_parallelism, 1);
    fmt::print("{}², 32 samples, bounces 0 to {}, no rest; {} repetitions\n\n", resolution, bounces, repetitions);
    fmt::print("{:<24} {:<66} {:>9} {:>7} {:>7}\n", "scene", "kept of what the plan leaves out", "seconds", "time", "rays");
    const std::pair<const char*, Scene (*)()> scenes[] = {
        {"cornell-box", [] { return stock("cornell-box"); }}, {"furnace", [] { return stock("furnace"); }},
        {"grey room with boxes", grey_room_with_boxes},       {"convex room", convex_room},
        {"room lit by a point", room_lit_by_a_point},         {"box under a sky", box_under_a_sky},
        {"room from outside", room_seen_from_outside}};
    for (const auto& [name, make] : scenes) {
        const Scene whole = make();
        const Plan plan = make_plan(whole);
        const std::optional<Scene> reduced = without_unlit_materials(plan, whole);
        const Scene& scene = reduced ? *reduced : whole;
        struct Kept {
            std::string part;
            const Scene* scene;
            LeftOut left_out;
        };
        std::vector<Kept> cases{{"nothing: the plan", &scene, plan.walk}};
        for (const PlanPart& part : plan.parts) {
            if (!part.decision) continue;
            cases.push_back({part.part, &scene, plan.walk});
            cases.back().left_out.*part.decision = false;
        }
        if (!plan.sides.empty()) cases.push_back({"materials where no light arrives", &whole, plan.walk});
        cases.push_back({"all of it: --plan full", &whole, LeftOut{}});
        std::vector<std::unique_ptr<Run>> runs;
        for (const Kept& c : cases) runs.push_back(std::make_unique<Run>(*c.scene, c.left_out));
        for (int r = 0; r < repetitions; ++r)
            for (const auto& run : runs) run->once();
        for (std::size_t i = 0; i < runs.size(); ++i)
            fmt::print("{:<24} {:<66} {:>9.4f} {:>7.3f} {:>7.3f}\n", i == 0 ? name : "", cases[i].part,
                       *std::min_element(runs[i]->seconds.begin(), runs[i]->seconds.end()), median_ratio(*runs[i], *runs[0]),
                       static_cast<double>(runs[i]->rays) / static_cast<double>(runs[0]->rays));
        std::fflush(stdout);
    }
}
