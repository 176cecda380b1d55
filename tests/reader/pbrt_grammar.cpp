// The language of pbrt files, and what is said about mistakes in it.
#include "tests/reader/pbrt_scene_files.h"

#include <zlib.h>

namespace neumann::pbrt_grammar_test {

class PbrtGrammar : public PbrtTest {
protected:
    static std::size_t shape_count(const SceneParts& parts) { return parts.shapes.size(); }
};

TEST_F(PbrtGrammar, WhatIsNotSaidIsAsInPbrt) {
    const SceneParts parts = read_pbrt_file("WorldBegin Shape \"sphere\"");
    EXPECT_EQ(parts.film.width, 1280);
    EXPECT_EQ(parts.film.height, 720);
    EXPECT_EQ(parts.bounces, 5);
    EXPECT_NEAR(parts.camera.fov, glm::radians(90.0), 1e-12);
    EXPECT_EQ(parts.camera.fov_axis, FovAxis::smaller);
    EXPECT_EQ(parts.sampler, SamplerKind::sobol);
    EXPECT_EQ(warning(parts), "");
}

TEST_F(PbrtGrammar, BlanksCommentsBracketsAndWindows) {
    const SceneParts parts = read_pbrt_file(
        "\xEF\xBB\xBF# a comment with \"quotes and [ brackets\r\n"
        "Camera\"perspective\"\"float fov\"[+4.0e1]\r\n"
        "WorldBegin\t# another\r\n"
        "AttributeBegin Translate 1 2 3 Shape \"sphere\" \"float radius\" .5 AttributeEnd\r\n"
        "Shape \"trianglemesh\" \"point P\" [0 0 0 1 0 0 0 1 0] \"integer indices\" [0\r\n1 2]");
    ASSERT_EQ(shape_count(parts), 2u);
    EXPECT_EQ(std::get<Sphere>(parts.shapes[0]).center, Vec3(1.0, 2.0, 3.0));
    EXPECT_EQ(std::get<Sphere>(parts.shapes[0]).radius, 0.5);
    EXPECT_NEAR(parts.camera.fov, glm::radians(40.0), 1e-12);
}

TEST_F(PbrtGrammar, FilesAreFoundFromTheMainFileAndBesideTheOneThatNamesThem) {
    write("parts and more/a b.pbrt", "Include \"inner.pbrt\"\nInclude \"parts and more\\\\\xc3\xa4.pbrt\"\nTranslate 0 0 1\n");
    write("parts and more/inner.pbrt", "Shape \"sphere\"");
    write("parts and more/\xc3\xa4.pbrt", "Shape \"sphere\" \"float radius\" 2");
    const SceneParts parts = read_pbrt("Include \"parts and more\\a b.pbrt\"\nShape \"sphere\"");
    ASSERT_EQ(shape_count(parts), 3u);
    EXPECT_EQ(std::get<Sphere>(parts.shapes[2]).center, Vec3(0.0, 0.0, 1.0));
    // What an imported file does to the state ends with it.
    const SceneParts imported = read_pbrt("Import \"parts and more/a b.pbrt\"\nShape \"sphere\"");
    ASSERT_EQ(shape_count(imported), 3u);
    EXPECT_EQ(std::get<Sphere>(imported.shapes[2]).center, Vec3(0.0));
}

TEST_F(PbrtGrammar, PackedFiles) {
    const std::string text = pbrt("Shape \"sphere\"");
    const gzFile packed = gzopen(path("scene.pbrt.gz").c_str(), "wb");
    gzwrite(packed, text.data(), static_cast<unsigned>(text.size()));
    gzclose(packed);
    EXPECT_EQ(shape_count(read_scene_parts(path("scene.pbrt.gz"))), 1u);
    write("broken.pbrt.gz", "no gzip file");
    EXPECT_EQ(error_of(path("broken.pbrt.gz")), "broken.pbrt.gz: is not a gzip file, or is damaged");
    write("empty.pbrt.gz", "");
    EXPECT_EQ(error_of(path("empty.pbrt.gz")), "empty.pbrt.gz: is empty, expected a file");
    EXPECT_EQ(error_of(path("none.pbrt")), "none.pbrt: there is no such file");
}

TEST_F(PbrtGrammar, AttributesGiveParametersToWhatFollows) {
    const SceneParts parts = read_pbrt(
        "AttributeBegin\nAttribute \"shape\" \"float radius\" 2 \"float unused\" 1\nShape \"sphere\"\n"
        "Shape \"sphere\" \"float radius\" 3\nAttribute \"shape\" \"float radius\" 4\nShape \"sphere\"\nAttributeEnd\nShape "
        "\"sphere\"");
    ASSERT_EQ(shape_count(parts), 4u);
    for (const auto& [i, radius] : {std::pair(0u, 2.0), std::pair(1u, 3.0), std::pair(2u, 4.0), std::pair(3u, 1.0)})
        EXPECT_EQ(std::get<Sphere>(parts.shapes[i]).radius, radius) << i;
}

TEST_F(PbrtGrammar, DefinitionsOfTheCommandLine) {
    write("scene.pbrt", pbrt("Shape \"sphere\""));
    const SceneParts parts = read_scene_parts(path("scene.pbrt"), {{"width", "20"}, {"height", "10"}, {"spp", "4"}});
    EXPECT_EQ(parts.film.width, 20);
    EXPECT_EQ(parts.film.height, 10);
    EXPECT_EQ(parts.camera.fov_axis, FovAxis::smaller);
    write("scene.pbrt", "WorldBegin Shape \"sphere\"");
    EXPECT_EQ(read_scene_parts(path("scene.pbrt"), {{"width", "640"}}).film.height, 360);  // pbrt's own film is 1280 × 720
    EXPECT_EQ(read_scene_parts(path("scene.pbrt"), {{"height", "360"}}).film.width, 640);
}

TEST_F(PbrtGrammar, SyntaxErrors) {
    EXPECT_EQ(pbrt_error("Shape \"sphere"), "scene.pbrt:3:7: the string does not end on its line, expected \"");
    EXPECT_EQ(pbrt_error("Shape \"sphere\" \"float radius\" [ 1"), "scene.pbrt:3:31: [ without ]");
    EXPECT_EQ(pbrt_error("Shape \"sphere\" \"float radius\" 1 ]"),
              "scene.pbrt:3:33: unexpected ']' after the parameters of shape 'sphere'");
    EXPECT_EQ(pbrt_error("Shape \"sphere\" \"float radius\" [ one ]"), "scene.pbrt:3:33: expected a number, found 'one'");
    EXPECT_EQ(pbrt_error("Shape \"sphere\" \"float radius\" 1e999"),
              "scene.pbrt:3:31: the number '1e999' is beyond the range of double precision");
    EXPECT_EQ(pbrt_error("Shape \"sphere\" \"float radius\" nan"),
              "scene.pbrt:3:31: the number 'nan' is beyond the range of double precision");
    EXPECT_EQ(pbrt_error("Shape \"sphere\" \"float radius\"\nShape \"sphere\""),
              "scene.pbrt:3:16: radius of shape 'sphere' has no value");
    EXPECT_EQ(pbrt_error("Shape \"sphere\" \"float radius\" [ ]"), "scene.pbrt:3:16: radius of shape 'sphere' has no value");
    EXPECT_EQ(
        pbrt_error("Shape \"sphere\" \"radius\" 1"),
        "scene.pbrt:3:16: unknown type 'radius'; allowed: blackbody, bool, float, integer, normal, point2, point3, rgb, spectrum, "
        "string, texture, vector2, vector3");
    EXPECT_EQ(
        pbrt_error("Shape \"sphere\" \"floot radius\" 1"),
        "scene.pbrt:3:16: unknown type 'floot'; allowed: blackbody, bool, float, integer, normal, point2, point3, rgb, spectrum, "
        "string, texture, vector2, vector3; did you mean 'float'?");
    EXPECT_EQ(pbrt_error("Shape \"sphere\" \"float radius\" 1 \"float radius\" 2"),
              "scene.pbrt:3:33: parameter 'radius' of shape 'sphere' is given twice, first at scene.pbrt:3:16");
    EXPECT_EQ(pbrt_error("Shape \"sphere\" \"float radius\" [1 2]"),
              "scene.pbrt:3:16: radius of shape 'sphere' has 2 values, expected one float");
    EXPECT_EQ(pbrt_error("Shape \"trianglemesh\" \"point3 P\" [0 0 0 1]"),
              "scene.pbrt:3:22: P of shape 'trianglemesh' has 4 numbers, expected 3 for each point3");
    EXPECT_EQ(pbrt_error("Shape \"loopsubdiv\" \"integer levels\" 1.5 \"point3 P\" [0 0 0]"),
              "scene.pbrt:3:37: expected an integer, found '1.5'");
    EXPECT_EQ(pbrt_error("AreaLightSource \"diffuse\" \"bool twosided\" yes"),
              "scene.pbrt:3:43: expected true or false, found 'yes'");
    EXPECT_EQ(pbrt_error("Shape"), "scene.pbrt:3:1: Shape without a type in quotes");
    EXPECT_EQ(pbrt_error("Translate 1 2\nShape \"sphere\""),
              "scene.pbrt:4:1: Translate has 2 of its 3 numbers, then comes 'Shape'");
    EXPECT_EQ(pbrt_error("Translate 1 2"), "scene.pbrt:3:1: Translate has 2 of its 3 numbers");
    EXPECT_EQ(pbrt_error("1 2 3"), "scene.pbrt:3:1: expected a directive, found '1'");
}

TEST_F(PbrtGrammar, UnknownNames) {
    EXPECT_EQ(pbrt_error("Shap \"sphere\""), "scene.pbrt:3:1: unknown directive 'Shap'; did you mean 'Shape'?");
    EXPECT_EQ(pbrt_error("Shape \"sphere\"\nWorldEnd"),
              "scene.pbrt:4:1: WorldEnd is no directive; this is pbrt-v3, expected pbrt-v4, into which 'pbrt --upgrade' of pbrt-v4 "
              "converts it");
    EXPECT_EQ(
        pbrt_error("Shape \"sphre\""),
        "scene.pbrt:3:1: shape type 'sphre' is not supported; allowed: bilinearmesh, cylinder, disk, loopsubdiv, plymesh, sphere, "
        "trianglemesh; did you mean 'sphere'?");
    EXPECT_EQ(
        pbrt_error("Shape \"curve\""),
        "scene.pbrt:3:1: shape type 'curve' is not supported; allowed: bilinearmesh, cylinder, disk, loopsubdiv, plymesh, sphere, "
        "trianglemesh");
    EXPECT_EQ(
        pbrt_error("Shape \"sphere\" \"float raduis\" 1"),
        "scene.pbrt:3:16: unknown parameter 'raduis' of shape 'sphere'; allowed: alpha, phimax, radius, zmax, zmin; did you mean "
        "'radius'?");
    EXPECT_EQ(pbrt_error("Attribute \"lihgt\" \"float scale\" 1"),
              "scene.pbrt:3:1: Attribute 'lihgt'; allowed: light, material, medium, shape, texture; did you mean 'light'?");
    EXPECT_EQ(
        pbrt_error("LightSource \"distand\""),
        "scene.pbrt:3:1: light type 'distand' is not supported; allowed: distant, goniometric, infinite, point, spot; did you mean "
        "'distant'?");
    EXPECT_EQ(pbrt_file_error("Film \"rbg\" WorldBegin"),
              "scene.pbrt:1:1: film type 'rbg' is not supported; allowed: gbuffer, rgb; did you mean 'rgb'?");
    EXPECT_EQ(
        pbrt_file_error("PixelFilter \"boxx\" WorldBegin"),
        "scene.pbrt:1:1: pixel filter type 'boxx' is not supported; allowed: box, gaussian, mitchell, sinc, triangle; did you "
        "mean 'box'?");
    EXPECT_EQ(pbrt_file_error("Sampler \"soboll\" WorldBegin"),
              "scene.pbrt:1:1: sampler type 'soboll' is not supported; allowed: halton, independent, paddedsobol, pmj02bn, sobol, "
              "stratified, zsobol; did you mean 'sobol'?");
    EXPECT_EQ(pbrt_file_error("Camera \"perspectiv\" WorldBegin"),
              "scene.pbrt:1:1: camera type 'perspectiv' is not supported; allowed: orthographic, perspective; did you mean "
              "'perspective'?");
    EXPECT_EQ(
        pbrt_file_error("Integrator \"paht\" WorldBegin"),
        "scene.pbrt:1:1: integrator type 'paht' is not supported; allowed: bdpt, lightpath, mlt, path, randomwalk, simplepath, "
        "simplevolpath, sppm, volpath; did you mean 'path'?");
    EXPECT_EQ(pbrt_error("Material \"difuse\""),
              "scene.pbrt:3:1: material type 'difuse' is not supported; allowed: coatedconductor, coateddiffuse, conductor, "
              "dielectric, diffuse, diffusetransmission, interface, mix, thindielectric; did you mean 'diffuse'?");
    EXPECT_EQ(pbrt_error("Texture \"t\" \"float\" \"imgemap\""),
              "scene.pbrt:3:1: texture type 'imgemap' is not supported; allowed: checkerboard, constant, imagemap, mix, scale; did "
              "you mean 'imagemap'?");
    EXPECT_EQ(pbrt_error("Texture \"t\" \"float\" \"imagemap\" \"string filename\" \"a.png\" \"string wrap\" \"repaet\""),
              "scene.pbrt:3:58: wrap of texture 'imagemap' is 'repaet'; allowed: clamp, repeat; did you mean 'repeat'?");
    EXPECT_EQ(pbrt_error("Shape \"sphere\" \"integer radius\" 1"),
              "scene.pbrt:3:16: radius of shape 'sphere' is of the type integer, which is not expected here");
    EXPECT_EQ(
        pbrt_error("Material \"matte\""),
        "scene.pbrt:3:1: material type 'matte' is not supported: it is of pbrt-v3, which 'pbrt --upgrade' of pbrt-v4 converts; "
        "allowed: coatedconductor, coateddiffuse, conductor, dielectric, diffuse, diffusetransmission, interface, mix, "
        "thindielectric");
    EXPECT_EQ(pbrt_error("NamedMaterial \"wal\"\nShape \"sphere\"\nMakeNamedMaterial \"wall\" \"string type\" \"diffuse\""),
              "scene.pbrt:3:1: there is no material 'wal'; did you mean 'wall'?");
    EXPECT_EQ(pbrt_error("ObjectInstance \"x\""), "scene.pbrt:3:1: there is no object 'x'");
    EXPECT_EQ(pbrt_error("CoordSysTransform \"x\""), "scene.pbrt:3:1: there is no coordinate system 'x'");
    EXPECT_EQ(pbrt_error("Include \"none.pbrt\""), "scene.pbrt:3:1: there is no file 'none.pbrt'; looked in: .");
    EXPECT_EQ(pbrt_error("LightSource \"projection\""),
              "scene.pbrt:3:1: light type 'projection' is not supported; allowed: distant, goniometric, infinite, point, spot");
    EXPECT_EQ(pbrt_file_error("Camera \"spherical\" WorldBegin"),
              "scene.pbrt:1:1: camera type 'spherical' is not supported; allowed: orthographic, perspective");
    EXPECT_EQ(pbrt_file_error("Film \"spectral\" WorldBegin"),
              "scene.pbrt:1:1: film type 'spectral' is not supported; allowed: gbuffer, rgb");
    EXPECT_EQ(pbrt_file_error("Integrator \"ao\" WorldBegin"),
              "scene.pbrt:1:1: integrator type 'ao' is not supported; allowed: bdpt, lightpath, mlt, path, randomwalk, simplepath, "
              "simplevolpath, sppm, volpath");
}

TEST_F(PbrtGrammar, Options) {
    EXPECT_EQ(pbrt_file_error("Option \"integer seed\" 7 Option \"bool disablepixeljitter\" false WorldBegin"), "no error");
    EXPECT_EQ(pbrt_file_error("Option \"bool disablepixeljitter\" true WorldBegin"),
              "scene.pbrt:1:8: disablepixeljitter is not supported");
    EXPECT_EQ(pbrt_file_error("Option \"bool forcediffuse\" true WorldBegin"), "scene.pbrt:1:8: forcediffuse is not supported");
    EXPECT_EQ(pbrt_file_error("Option \"bool forcedifuse\" true WorldBegin"),
              "scene.pbrt:1:8: unknown parameter 'forcedifuse' of Option; allowed: disablepixeljitter, disabletexturefiltering, "
              "disablewavelengthjitter, displacementedgescale, forcediffuse, msereferenceimage, msereferenceout, pixelstats, "
              "rendercoordsys, seed, wavefront; did you mean 'forcediffuse'?");
}

TEST_F(PbrtGrammar, BlocksAndOrder) {
    EXPECT_EQ(pbrt_error("AttributeBegin"), "scene.pbrt:3:1: AttributeBegin without an end");
    EXPECT_EQ(pbrt_error("AttributeEnd"), "scene.pbrt:3:1: AttributeEnd without AttributeBegin");
    EXPECT_EQ(pbrt_error("ObjectBegin \"a\"\nAttributeEnd\nObjectEnd"),
              "scene.pbrt:4:1: AttributeEnd without AttributeBegin; the ObjectBegin at scene.pbrt:3:1 has not ended");
    EXPECT_EQ(pbrt_error("WorldBegin"), "scene.pbrt:3:1: a second WorldBegin");
    EXPECT_EQ(pbrt_error("Film \"rgb\" \"integer xresolution\" 5"),
              "scene.pbrt:3:1: a second Film, the first is at scene.pbrt:1:37");
    EXPECT_EQ(pbrt_error("Sampler \"sobol\""), "scene.pbrt:3:1: Sampler after WorldBegin, expected before it");
    EXPECT_EQ(pbrt_file_error("Shape \"sphere\"\nWorldBegin"), "scene.pbrt:1:1: Shape before WorldBegin, expected after it");
    EXPECT_EQ(pbrt_file_error("Camera \"perspective\""),
              "scene.pbrt: has no WorldBegin, which stands between the camera and the shapes");
    EXPECT_EQ(pbrt_error("LookAt 0 0 0 0 0 1 0 0 2"), "scene.pbrt:3:1: the up vector of LookAt points along the view");
    EXPECT_EQ(pbrt_error("ActiveTransform EndTime"), "scene.pbrt:3:1: ActiveTransform EndTime: motion is not supported");
    EXPECT_EQ(pbrt_error("ColorSpace \"rec2020\""),
              "scene.pbrt:3:1: ColorSpace is 'rec2020', expected srgb; the others are not supported");
    EXPECT_EQ(pbrt_error("MakeNamedMedium \"fog\" \"string type\" \"homogeneous\"\nMediumInterface \"fog\" \"\""),
              "scene.pbrt:3:1: medium 'fog': media are not supported");
    EXPECT_EQ(pbrt_error("ObjectBegin \"a\"\nShape \"sphere\"\nObjectEnd\nObjectBegin \"a\"\nObjectEnd"),
              "scene.pbrt:6:1: a second object 'a', the first is at scene.pbrt:3:1");
}

TEST_F(PbrtGrammar, IncludesEnd) {
    write("other.pbrt", "Include \"scene.pbrt\"");
    EXPECT_EQ(pbrt_error("Include \"other.pbrt\""),
              "other.pbrt:1:1: include cycle: scene.pbrt includes other.pbrt includes scene.pbrt");
    // Each includes the next twice.
    for (int i = 0; i < 30; ++i) {
        const std::string next = "Include \"" + std::to_string(i + 1) + ".pbrt\"\n";
        write(std::to_string(i) + ".pbrt", next + next);
    }
    write("30.pbrt", "");
    EXPECT_NE(pbrt_error("Include \"0.pbrt\"").find("more than 10000 files are included"), std::string::npos);
}

TEST_F(PbrtGrammar, AllErrorsAtOnce) {
    EXPECT_EQ(
        pbrt_error(
            "Shape \"sphere\" \"float radius\" -1 \"float size\" 2\nNonsense 1 2 \"x\"\nMaterial \"diffuse\" \"rgb reflectance\" "
            "[2 0 0]\nShape \"sphere\""),
        "scene.pbrt:3:16: radius of shape 'sphere' is -1, expected more than 0\n"
        "scene.pbrt:3:34: unknown parameter 'size' of shape 'sphere'; allowed: alpha, phimax, radius, zmax, zmin\n"
        "scene.pbrt:4:1: unknown directive 'Nonsense'\n"
        "scene.pbrt:5:20: reflectance of material 'diffuse' is (2, 0, 0), expected at most 1");
}

}  // namespace neumann::pbrt_grammar_test
