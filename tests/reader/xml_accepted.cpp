// What the reader makes of scenes that are right: documents, includes, references and what is not given.
#include "tests/reader/xml_scene_files.h"

#include <numbers>

namespace neumann::xml_accepted_test {

using XmlAccepted = XmlTest;

TEST_F(XmlAccepted, Defaults) {
    const SceneParts parts = read("");
    EXPECT_TRUE(parts.shapes.empty());
    EXPECT_TRUE(parts.bsdfs.empty());
    EXPECT_FALSE(parts.bounces);
    EXPECT_FALSE(parts.sampler);
    EXPECT_EQ(parts.film.width, 768);
    EXPECT_EQ(parts.film.height, 576);
    EXPECT_EQ(parts.film.crop_width, 768);
    EXPECT_EQ(parts.film.crop_height, 576);
    ASSERT_TRUE(std::holds_alternative<GaussianFilter>(parts.film.filter));
    EXPECT_EQ(std::get<GaussianFilter>(parts.film.filter).radius(), 2.0);
    EXPECT_EQ(parts.camera.to_world, Mat4(1.0));
    EXPECT_DOUBLE_EQ(parts.camera.fov, 40.0 * std::numbers::pi / 180.0);
    EXPECT_EQ(parts.camera.fov_axis, FovAxis::x);
    EXPECT_EQ(parts.camera.near_clip, 1e-2);
    EXPECT_EQ(parts.camera.far_clip, 1e4);
    EXPECT_TRUE(parts.warnings.counts().empty());
}

TEST_F(XmlAccepted, OldestCompatibleVersion) {
    EXPECT_NO_THROW(
        read_file("\xEF\xBB\xBF<?xml version='1.0' encoding='utf-8'?>\n<!-- a scene -->\n<scene version=\"2.0.0\">"
                  "<sensor type=\"perspective\"><float name=\"fov\" value=\"40\"/></sensor></scene>"));
}

// As in Mitsuba, what <path> names comes first, the last one before the others.
TEST_F(XmlAccepted, OrderOfFolders) {
    const auto sphere = [](int radius) {
        return "<scene version='3.0.0'><shape type='sphere'><float name='radius' value='" + std::to_string(radius) +
               "'/></shape></scene>";
    };
    write("one/a.xml", sphere(1));
    write("two/a.xml", sphere(2));
    write("a.xml", sphere(3));
    const auto radius = [&](const std::string& body) { return std::get<Sphere>(read(body).shapes.at(0)).radius; };
    EXPECT_EQ(radius("<include filename='a.xml'/>"), 3.0);
    EXPECT_EQ(radius("<path value='one'/><include filename='a.xml'/>"), 1.0);
    EXPECT_EQ(radius("<path value='one'/><path value='two'/><include filename='a.xml'/>"), 2.0);
}

// As in Mitsuba, a file looks for the folder of a <path> in its own <path>s, beside itself, and then where the file looks that
// includes it.
TEST_F(XmlAccepted, FoldersOfIncludedFiles) {
    const auto sphere = [](int radius) {
        return "<scene version='3.0.0'><shape type='sphere'><float name='radius' value='" + std::to_string(radius) +
               "'/></shape></scene>";
    };
    write("meshes/a.xml", sphere(1));
    write("parts/inner.xml", "<scene version='3.0.0'><path value='meshes'/><include filename='a.xml'/></scene>");
    const std::string body = "<include filename='parts/inner.xml'/>";
    const auto radius = [&](const std::string& text) { return std::get<Sphere>(read(text).shapes.at(0)).radius; };
    EXPECT_EQ(radius(body), 1.0);
    write("other/meshes/a.xml", sphere(2));
    EXPECT_EQ(radius("<path value='other'/>" + body), 2.0);
    write("parts/meshes/a.xml", sphere(3));
    EXPECT_EQ(radius("<path value='other'/>" + body), 3.0);
}

TEST_F(XmlAccepted, Substitution) {
    const std::string body =
        "<default name='r' value='2'/><default name='radius' value='$r.5'/><default name='r' value='7'/>"
        "<shape type='sphere'><float name='$kind' value='$radius'/></shape>";
    // The longest name wins ($radius, not $r and "adius"), and the first default stands.
    EXPECT_EQ(std::get<Sphere>(read(body, {{"kind", "radius"}}).shapes.at(0)).radius, 2.5);
    EXPECT_EQ(std::get<Sphere>(read(body, {{"kind", "radius"}, {"r", "3"}}).shapes.at(0)).radius, 3.5);
    EXPECT_EQ(std::get<Sphere>(read(body, {{"kind", "radius"}, {"radius", "9"}}).shapes.at(0)).radius, 9.0);
}

TEST_F(XmlAccepted, EscapedDollarAndLiteralReplacement) {
    write("$r.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    EXPECT_EQ(read("<shape type='obj'><string name='filename' value='\\$r.obj'/></shape>").shapes.size(), 1u);
    EXPECT_EQ(
        read("<default name='f' value='$g'/><shape type='obj'><string name='filename' value='$f'/></shape>", {{"g", "$r.obj"}})
            .shapes.size(),
        1u);
}

TEST_F(XmlAccepted, IncludesAndFolders) {
    const std::string triangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
    write("meshes/main.obj", triangle);
    write("parts/beside.obj", triangle);
    write("far/away/searched.obj", triangle);
    write("parts/inner.xml",
          "<scene version='3.0.0'><default name='size' value='4'/>"
          "<shape type='obj'><string name='filename' value='meshes/main.obj'/></shape>"
          "<shape type='obj'><string name='filename' value='beside.obj'/></shape>"
          "<shape type='obj'><string name='filename' value='searched.obj'/></shape></scene>");
    const SceneParts parts = read(
        "<path value='far/away'/><include filename='parts/inner.xml'/>"
        "<shape type='sphere'><float name='radius' value='$size'/></shape>");
    ASSERT_EQ(parts.shapes.size(), 4u);
    EXPECT_EQ(std::get<Sphere>(parts.shapes[3]).radius, 4.0);
}

TEST_F(XmlAccepted, IncludeOfOneObject) {
    write("grey.xml", "<bsdf version='3.0.0' type='diffuse'><float name='reflectance' value='0.25'/></bsdf>");
    const SceneParts parts = read("<shape type='cube'><include filename='grey.xml'/></shape>");
    EXPECT_EQ(largest_albedo(parts.bsdfs.at(0)), Rgb(0.25));
}

TEST_F(XmlAccepted, IncludeTwiceIsNoCycle) {
    write("one.xml", "<scene version='3.0.0'><shape type='cube'/></scene>");
    EXPECT_EQ(read("<include filename='one.xml'/><include filename='one.xml'/>").shapes.size(), 2u);
}

TEST_F(XmlAccepted, SharedReferences) {
    const SceneParts parts = read(
        "<shape type='cube'><ref id='grey'/></shape><shape type='cube'><ref name='bsdf' id='gray'/></shape>"
        "<bsdf type='diffuse' id='grey'><float name='reflectance' value='0.25'/></bsdf><alias id='grey' as='gray'/>"
        "<bsdf type='diffuse' id='unused'/>");
    EXPECT_EQ(parts.bsdfs.size(), 1u);
    EXPECT_EQ(parts.sides_of_shape.at(0).front, 0);
    EXPECT_EQ(parts.sides_of_shape.at(1).front, 0);
    EXPECT_EQ(parts.sides_of_shape.at(1).back, Materials::absorbing);
}

TEST_F(XmlAccepted, EmittersByReference) {
    const SceneParts parts = read(
        "<shape type='cube'><ref id='lamp'/></shape>"
        "<emitter type='area' id='lamp'><rgb name='radiance' value='1, 2, 3'/></emitter>"
        "<emitter type='area'><rgb name='radiance' value='9'/></emitter>");
    EXPECT_EQ(parts.lights.of_shape, std::vector<int>{0});
    ASSERT_EQ(parts.lights.area.size(), 1u);
    EXPECT_EQ(parts.lights.area[0].largest, Rgb(1.0, 2.0, 3.0));
}

}  // namespace neumann::xml_accepted_test
