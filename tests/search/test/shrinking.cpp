#include "tests/search/random_scene.h"
#include "tests/search/shrink.h"

#include <gtest/gtest.h>

#include <set>
#include <sstream>

namespace neumann::search::shrinking_test {

std::string text_of(const pugi::xml_document& xml) {
    std::ostringstream text;
    xml.save(text, "", pugi::format_raw | pugi::format_no_declaration);
    return text.str();
}

TEST(Shrink, LeavesWhatTheFailureNeeds) {
    pugi::xml_document scene;
    scene.load_string(
        R"(<scene><shape type="cube"><transform name="to_world"><scale value="0.137"/></transform><bsdf type="twosided"><bsdf type="mask"><float name="opacity" value="0.417"/><bsdf type="conductor"/></bsdf></bsdf></shape><emitter type="constant"/></scene>)");
    // As if a conductor on a shape failed, in a mask, of an opacity that is not 1.
    shrink(
        scene,
        [](const pugi::xml_document& s) {
            return s.select_node("//shape//bsdf[@type='mask' and float[@value!='1']]/bsdf[@type='conductor']");
        },
        [] { return false; });
    EXPECT_EQ(
        text_of(scene),
        R"(<scene><shape type="rectangle"><bsdf type="mask"><float name="opacity" value="0"/><bsdf type="conductor"/></bsdf></shape></scene>)");
}

TEST(Shrink, EndsWhenItIsTold) {
    pugi::xml_document scene;
    scene.load_string(R"(<scene><shape/><emitter/></scene>)");
    shrink(
        scene, [](const pugi::xml_document&) { return true; }, [] { return true; });
    EXPECT_EQ(text_of(scene), "<scene><shape/><emitter/></scene>");
}

TEST(RandomScenes, TheSameNumberIsTheSameScene) {
    EXPECT_EQ(text_of(random_scene(7).xml), text_of(random_scene(7).xml));
    EXPECT_NE(text_of(random_scene(7).xml), text_of(random_scene(8).xml));
}

// Each plugin that the generator knows stands in some of a few thousand scenes.
TEST(RandomScenes, HaveAllKindsOfParts) {
    std::set<std::string> found;
    for (std::uint64_t i = 0; i < 2000; ++i)
        for (const pugi::xpath_node& node : random_scene(i).xml.select_nodes("//*[@type]"))
            found.insert(node.node().attribute("type").value());
    for (const char* type : {"rectangle",
                             "disk",
                             "sphere",
                             "cylinder",
                             "cube",
                             "ply",
                             "shapegroup",
                             "instance",
                             "diffuse",
                             "twosided",
                             "conductor",
                             "roughconductor",
                             "plastic",
                             "roughplastic",
                             "dielectric",
                             "thindielectric",
                             "roughdielectric",
                             "mask",
                             "null",
                             "blendbsdf",
                             "mixturebsdf",
                             "coating",
                             "normalmap",
                             "phong",
                             "ward",
                             "principled",
                             "principledthin",
                             "retroreflector",
                             "checkerboard",
                             "bitmap",
                             "area",
                             "directionalarea",
                             "constant",
                             "envmap",
                             "sunsky",
                             "point",
                             "spot",
                             "directional",
                             "projector",
                             "perspective",
                             "thinlens",
                             "orthographic",
                             "irradiancemeter",
                             "distant",
                             "radiancemeter",
                             "batch"})
        EXPECT_TRUE(found.contains(type)) << type;
}

}  // namespace neumann::search::shrinking_test
