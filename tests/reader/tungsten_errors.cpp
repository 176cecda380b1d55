// What is wrong in Tungsten's scenes is told at its place, and all of it at once.
#include "tests/reader/tungsten_scene_files.h"

namespace neumann::tungsten_errors_test {

class TungstenErrors : public TungstenTest {};

TEST_F(TungstenErrors, Files) {
    EXPECT_EQ(error_of(path("none.json")), "none.json: there is no such file");
    EXPECT_EQ(error_of_text("{\r\n  \"camera\": {\"fov\": 3,}}"),
              "scene.json:2:23: broken JSON: syntax error while parsing object key - unexpected '}'; expected string literal");
    EXPECT_EQ(error_of_text("[]"), "scene.json: an array, expected an object");
    EXPECT_EQ(error_of_text("{\"asset\": {}}"),
              "scene.json: the file has no primitives, bsdfs nor camera, expected a scene of Tungsten");
    write("a.wo3", "");
    EXPECT_EQ(error_of(path("a.wo3")),
              "a.wo3: this is a mesh, not a scene; name it in a scene of Tungsten: {\"type\": \"mesh\", \"file\": \"a.wo3\"}");
    write("marked.json", "\xEF\xBB\xBF" + scene_with({{"type", "null"}}).dump());
    EXPECT_EQ(read_scene_parts(path("marked.json")).shapes.size(), 1u);
}

TEST_F(TungstenErrors, AllAtOnce) {
    Json file = scene_of({{"type", "quad"}, {"bsdf", "wal"}, {"emision", 3}});
    file["bsdfs"] = {{{"name", "wall"}, {"type", "lambert"}, {"albedo", "none.png"}, {"albdo", 1}},
                     {{"name", "glass"}, {"type", "dielectric"}, {"ior", 0}},
                     {{"type", "conductor"}, {"eta", 2}},
                     {{"name", "plastic"}},
                     3};
    file["primitives"].push_back({{"type", "sphere"}, {"bsdf", 2}, {"emission", true}});
    file["primitives"].push_back({{"type", "curves"}, {"file", "hair.fiber"}});
    file["primitives"].push_back({{"type", "sphere"}, {"int_medium", "fog"}, {"bump", "a.png"}});
    file["camrea"] = 3;
    EXPECT_EQ(tungsten_error(file),
              "scene.json#/bsdfs/0/albdo: unknown property 'albdo'; did you mean 'albedo'?\n"
              "scene.json#/bsdfs/0/albedo: there is no file 'none.png'; looked in: .\n"
              "scene.json#/bsdfs/1/ior: ior is 0, expected more than 0\n"
              "scene.json#/bsdfs/2/eta: eta is given without k, expected both\n"
              "scene.json#/bsdfs/3: type is missing, expected that of a bsdf\n"
              "scene.json#/bsdfs/4: a number, expected an object\n"
              "scene.json#/camrea: unknown property 'camrea'; did you mean 'camera'?\n"
              "scene.json#/primitives/0/bsdf: there is no bsdf 'wal'; did you mean 'wall'?\n"
              "scene.json#/primitives/1/bsdf: the bsdf is a number, expected the name of one or an object\n"
              "scene.json#/primitives/2/type: primitive type 'curves' is not supported; allowed: cube, cylinder, disk, "
              "infinite_sphere, instances, mesh, point, quad, sphere\n"
              "scene.json#/primitives/3/bump: bump is not supported: how deep it is depends on the picture's size\n"
              "scene.json#/primitives/3/int_medium: int_medium: media are not supported, expected empty space");
}

TEST_F(TungstenErrors, Metals) {
    for (const std::string name : {"Al_", "none"}) {
        const Json file = scene_with({{"type", "conductor"}, {"material", name}});
        EXPECT_EQ(tungsten_error(file), "scene.json#/primitives/0/bsdf/material: material '" + name + "' is not known" +
                                            (name == "none" ? "" : "; did you mean 'Al'?"));
        EXPECT_EQ(replaced(file), "scene.json#/primitives/0/bsdf/material: material '" + name + "' is not known; taken as 'Cu'\n");
    }
}

// What only the reader of Mitsuba's plugins knows is told at the same places.
TEST_F(TungstenErrors, OfPlugins) {
    EXPECT_EQ(tungsten_error(scene_of({{"type", "quad"}, {"emission", {1, -1, 1}}})),
              "scene.json#/primitives/0/emission: radiance is negative: '1, -1, 1'");
    EXPECT_EQ(tungsten_error(scene_with({{"type", "transparency"}, {"alpha", 2}})),
              "scene.json#/primitives/0/bsdf/alpha: opacity of bsdf 'mask' is 2, expected from 0 to 1");
}

TEST_F(TungstenErrors, Cycles) {
    Json file = scene_with("a");
    file["bsdfs"] = {{{"name", "a"}, {"type", "mixed"}, {"bsdf0", "b"}, {"bsdf1", "b"}},
                     {{"name", "b"}, {"type", "transparency"}, {"base", "a"}}};
    EXPECT_EQ(tungsten_error(file), "scene.json#/bsdfs/0: the bsdf stands inside itself");
    Json deep = {{"type", "null"}};
    for (int i = 0; i < 200; ++i) deep = {{"type", "transparency"}, {"base", deep}};
    EXPECT_TRUE(tungsten_error(scene_with(deep)).ends_with("/base: bsdfs are nested more than 100 deep"));
}

}  // namespace neumann::tungsten_errors_test
