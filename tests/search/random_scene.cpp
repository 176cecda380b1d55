#include "tests/search/random_scene.h"

#include "tests/search/scene_elements.h"

#include <fstream>

namespace neumann::search {

namespace {

// All methods have their turn; those that take long more rarely.
std::vector<std::string> choose_methods(RandomNumbers& random) {
    static const std::array<const char*, 15> walks{"walk:direct=bsdf",
                                                   "walk:direct=projected",
                                                   "walk:direct=mis-projected",
                                                   "walk:direct=light:lights=all",
                                                   "walk:direct=surfaces",
                                                   "walk:lights=contribution",
                                                   "walk:split=2,3",
                                                   "walk:reuse=true",
                                                   "walk:tree=sum",
                                                   "walk:indirect=uniform",
                                                   "walk:indirect=cosine",
                                                   "walk:lights=seen",
                                                   "walk:tree=place",
                                                   "walk:adaptive=all",
                                                   "walk:plan=full"};
    std::vector<std::string> methods{"walk", "bidirectional"};
    const auto some = [&](const char* method, double probability) {
        if (random.chance(probability)) methods.emplace_back(method);
    };
    methods.emplace_back(random.one_of(walks));
    some("corrected", 0.2);
    some("guided", 0.3);
    some("surface", 0.2);
    some("light", 0.5);
    some("shooting", 0.2);
    some("mixed", 0.02);
    some("photon", 0.3);
    some("photon:gather=true", 0.15);
    some("cache:accuracy=0.4:directions=64", 0.1);  // a pass takes as long for a small picture as for a large one
    some("metropolis", 0.3);
    some("classic", 0.1);
    some("pointwise", 0.2);
    some("matrix", 0.6);
    some("gather", 0.4);
    some("patches", 0.3);
    some("auto", 0.02);
    return methods;
}

}  // namespace

RandomScene random_scene(std::uint64_t number) {
    RandomScene made;
    RandomNumbers random(number);
    Making making{random, made.files};
    Node scene = made.xml.append_child("scene");
    scene.append_attribute("version") = "3.0.0";
    if (random.chance(0.05)) add_value(add_object(scene, "integrator", "path"), "boolean", "hide_emitters", "true");
    const bool room = random.chance(0.5);
    const std::vector<Node> meters = add_shapes(scene, room, making);
    add_lights(scene, made.xml.select_node("//emitter").node().empty(), making);
    add_camera(scene, room, meters, making);
    made.methods = choose_methods(random);
    return made;
}

void write(const pugi::xml_document& xml, const std::filesystem::path& path) { xml.save_file(path.c_str(), "    "); }

void write_files(const RandomScene& scene, const std::filesystem::path& folder) {
    for (const auto& [name, bytes] : scene.files) std::ofstream(folder / name, std::ios::binary) << bytes;
}

}  // namespace neumann::search
