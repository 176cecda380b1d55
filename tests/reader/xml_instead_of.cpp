// Plugins of Mitsuba that are not read: the message says what can be done.
#include "tests/reader/xml_scene_files.h"

namespace neumann::xml_instead_of_test {

using XmlInsteadOf = XmlTest;

TEST_F(XmlInsteadOf, Materials) {
    EXPECT_EQ(
        error("<bsdf type='roughcoating'><bsdf type='diffuse'/></bsdf>"),
        "scene.xml:2:7: bsdf type 'roughcoating' is not supported: 'coating' is a smooth layer over any material, 'roughplastic' a "
        "rough one over a matt base");
    EXPECT_EQ(
        error("<bsdf type='measured'/>"),
        "scene.xml:2:7: bsdf type 'measured' is not supported: measured materials are not read; 'principled' or 'roughconductor' "
        "can be fitted to them");
    EXPECT_EQ(error("<bsdf type='hair'/>"), "scene.xml:2:7: bsdf type 'hair' is not supported: hair is not simulated");
}

TEST_F(XmlInsteadOf, Lights) {
    for (const std::string type : {"avg_sunsky", "timed_sunsky"})
        EXPECT_EQ(
            error("<emitter type='" + type + "'/>"),
            "scene.xml:2:10: emitter type '" + type + "' is not supported: 'sunsky' is the sky and the sun of one time of day");
    EXPECT_EQ(error("<emitter type='sun'/>"),
              "scene.xml:2:10: emitter type 'sun' is not supported: 'sunsky' with sky_scale 0 is the sun alone");
    EXPECT_EQ(error("<emitter type='sky'/>"),
              "scene.xml:2:10: emitter type 'sky' is not supported: 'sunsky' with sun_scale 0 is the sky alone");
}

TEST_F(XmlInsteadOf, MediaAndMotion) {
    for (const std::string tag : {"medium", "phase", "volume", "subsurface"})
        EXPECT_EQ(error("<shape type='cube'>\n<" + tag + " type='homogeneous'/></shape>"),
                  "scene.xml:3:1: <" + tag + "> is not supported: media are not simulated, only surfaces");
    EXPECT_EQ(error("<shape type='cube'>\n<animation name='toWorld'/></shape>"),
              "scene.xml:3:1: <animation> is not supported: nothing moves while a picture is taken");
}

TEST_F(XmlInsteadOf, Shapes) {
    EXPECT_EQ(error("<shape type='sdfgrid'/>"),
              "scene.xml:2:8: shape type 'sdfgrid' is not supported: a mesh of its surface, written as ply, can stand for it");
}

TEST_F(XmlInsteadOf, SensorsAndIntegrators) {
    const auto sensor = [&](const std::string& type) {
        return file_error("<scene version=\"3.0.0\"><sensor type=\"" + type + "\"/></scene>");
    };
    EXPECT_EQ(
        sensor("hdistant"),
        "scene.xml:1:32: sensor type 'hdistant' is not supported: 'distant' is the same for one direction; several of them can "
        "stand in a 'batch'");
    EXPECT_EQ(
        error("<integrator type='depth'/>"),
        "scene.xml:2:13: integrator type 'depth' is not supported: it shows distances and no light; 'path' renders the scene");
}

}  // namespace neumann::xml_instead_of_test
