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

using PbrtGrammarSlow = PbrtGrammar;
TEST_F(PbrtGrammarSlow, IncludesEnd) {
    // Each includes the next twice.
    for (int i = 0; i < 30; ++i) {
        const std::string next = "Include \"" + std::to_string(i + 1) + ".pbrt\"\n";
        write(std::to_string(i) + ".pbrt", next + next);
    }
    write("30.pbrt", "");
    EXPECT_NE(pbrt_error("Include \"0.pbrt\"").find("more than 10000 files are included"), std::string::npos);
}

}  // namespace neumann::pbrt_grammar_test
