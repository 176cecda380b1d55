// What is wrong with a file as a document: XML, elements, attributes, includes, $names, ids.
#include "tests/reader/xml_scene_files.h"

namespace neumann::xml_document_errors_test {

class XmlDocumentErrors : public XmlTest {};

TEST_F(XmlDocumentErrors, MissingFile) { EXPECT_EQ(error_of(path("none.xml")), "none.xml: there is no such file"); }

TEST_F(XmlDocumentErrors, FolderInsteadOfFile) { EXPECT_EQ(error_of(path(".")), ".: is a folder, expected a scene file"); }

TEST_F(XmlDocumentErrors, Utf16) {
    EXPECT_EQ(file_error("\xFF\xFE<"), "scene.xml: is in UTF-16, expected UTF-8");
    EXPECT_EQ(file_error("\xFE\xFF"), "scene.xml: is in UTF-16, expected UTF-8");
}

TEST_F(XmlDocumentErrors, EmptyFile) { EXPECT_EQ(file_error(""), "scene.xml: is empty, expected a scene file"); }

TEST_F(XmlDocumentErrors, BrokenXml) {
    EXPECT_EQ(file_error("<scene version=\"3.0.0\">\n  <shape type=\"sphere\">\n</scene>\n"),
              "scene.xml:3:3: broken XML: Start-end tags mismatch");
    EXPECT_EQ(file_error("<scene version=\"3.0.0\">\n  <shape type=sphere/>\n</scene>\n"),
              "scene.xml:2:15: broken XML: Error parsing element attribute");
}

TEST_F(XmlDocumentErrors, SecondRoot) {
    EXPECT_EQ(file_error("<scene version=\"3.0.0\"/>\n<scene version=\"3.0.0\"/>\n"),
              "scene.xml:2:1: a second outermost element <scene>, expected the end of the file");
}

TEST_F(XmlDocumentErrors, WrongRoot) {
    EXPECT_EQ(file_error("<mesh/>"), "scene.xml:1:1: the outermost element is <mesh>, expected <scene>");
    EXPECT_EQ(file_error("<bsdf version=\"3.0.0\" type=\"diffuse\"/>"),
              "scene.xml:1:1: the outermost element is <bsdf>, expected <scene>");
}

TEST_F(XmlDocumentErrors, Versions) {
    EXPECT_EQ(file_error("<scene/>"), "scene.xml:1:1: <scene> lacks the attribute 'version'");
    EXPECT_EQ(file_error("<scene version=\"0.3.0\"/>"), "scene.xml:1:8: scene version 0.3.0 is not known, expected 0.4 to 3.x");
    EXPECT_EQ(file_error("<scene version=\"4.0.0\"/>"), "scene.xml:1:8: scene version 4.0.0 is not known, expected 0.4 to 3.x");
    for (const char* bad : {"three", "", "3.", "3.0.0.0", "3.0.0b", "-3.0.0"})
        EXPECT_EQ(file_error(std::string("<scene version=\"") + bad + "\"/>"),
                  std::string("scene.xml:1:8: '") + bad + "' is not a version, expected for example 3.0.0");
}

TEST_F(XmlDocumentErrors, UnknownElements) {
    EXPECT_EQ(
        error("<fog type=\"isotropic\"/>"),
        "scene.xml:2:1: <fog> is not supported in <scene>; allowed: alias, bsdf, default, emitter, film, include, integrator, "
        "path, rfilter, sampler, sensor, shape, texture");
    EXPECT_EQ(
        error("<bsdf type=\"diffuse\">\n  <fog name=\"reflectance\" type=\"isotropic\"/></bsdf>"),
        "scene.xml:3:3: <fog> is not supported in <bsdf>; allowed: boolean, bsdf, default, emitter, film, float, include, "
        "integer, integrator, point, ref, rfilter, rgb, sampler, sensor, shape, spectrum, string, texture, transform, vector");
    EXPECT_EQ(error("<shape type=\"sphere\"><transform name=\"to_world\"><shear/></transform></shape>"),
              "scene.xml:2:49: <shear> is not supported in <transform>; allowed: lookat, matrix, rotate, scale, translate");
    EXPECT_EQ(error("<shape type=\"sphere\"><float name=\"radius\" value=\"1\"><ref id=\"a\"/></float></shape>"),
              "scene.xml:2:53: <ref> is not supported in <float>; expected nothing inside");
}

TEST_F(XmlDocumentErrors, TextBetweenElements) {
    EXPECT_EQ(error("<shape type=\"sphere\">radius 2</shape>"),
              "scene.xml:2:1: <shape> contains the text 'radius, 2', expected elements only");
}

TEST_F(XmlDocumentErrors, Attributes) {
    EXPECT_EQ(error("<shape type=\"sphere\" kind=\"round\"/>"),
              "scene.xml:2:22: unknown attribute 'kind' of <shape>; allowed: type, id, name");
    EXPECT_EQ(error("<shape type='sphere'\n       type='cube'/>"), "scene.xml:3:8: attribute 'type' of <shape> is given twice");
    EXPECT_EQ(error("<shape/>"), "scene.xml:2:1: <shape> lacks the attribute 'type'");
    EXPECT_EQ(error("<bsdf type=\"diffuse\"><spectrum name=\"reflectance\" file=\"a.spd\"/></bsdf>"),
              "scene.xml:2:51: unknown attribute 'file' of <spectrum>; allowed: name, value, filename, type");
}

TEST_F(XmlDocumentErrors, ElementsTooDeep) {
    std::string text;
    for (int i = 0; i < 101; ++i) text += "<bsdf type=\"mask\"    >";
    for (int i = 0; i < 101; ++i) text += "</bsdf>";
    EXPECT_EQ(error(text), "scene.xml:2:2201: elements are nested more than 100 deep");
}

TEST_F(XmlDocumentErrors, UndefinedParameter) {
    EXPECT_EQ(error("<shape type=\"$kind\"/>"), "scene.xml:2:8: $kind is not defined; no parameter is");
    EXPECT_EQ(error("<default name=\"b\" value=\"1\"/><default name=\"a\" value=\"1\"/><shape type=\"$kind\"/>"),
              "scene.xml:2:66: $kind is not defined; defined: a, b");
    EXPECT_EQ(error("<shape type=\"$\"/>"), "scene.xml:2:8: $ is not defined; no parameter is");
}

TEST_F(XmlDocumentErrors, UnusedDefinition) {
    EXPECT_EQ(error("", {{"spp", "16"}}), "scene.xml: -D spp=16: nothing in the scene uses $spp; it has no parameters");
    EXPECT_EQ(error("<default name=\"kind\" value=\"sphere\"/><shape type=\"$kind\"/>", {{"knid", "cube"}}),
              "scene.xml: -D knid=cube: nothing in the scene uses $knid; its parameters: kind");
}

TEST_F(XmlDocumentErrors, EndlesslyGrowingValues) {
    std::string body = "<default name=\"a0\" value=\"0123456789abcdef\"/>\n";
    for (int i = 1; i < 40; ++i) {
        const std::string before = "$a" + std::to_string(i - 1) + " ";
        body += "<default name=\"a" + std::to_string(i) + "\" value=\"" + before + before + "\"/>\n";
    }
    EXPECT_EQ(error(body), "scene.xml:22:21: the value is longer than 16777216 characters once its parameters are put in");
}

TEST_F(XmlDocumentErrors, EmptyDefaultName) {
    EXPECT_EQ(error("<default name=\"\" value=\"1\"/>"), "scene.xml:2:10: the name of a <default> is empty");
}

TEST_F(XmlDocumentErrors, MissingInclude) {
    EXPECT_EQ(error("<include filename=\"none.xml\"/>"), "scene.xml:2:10: there is no file 'none.xml'; looked in: .");
    write("sub/inner.xml", "<scene version=\"3.0.0\">\n<include filename=\"none.xml\"/></scene>");
    EXPECT_EQ(error("<include filename=\"sub/inner.xml\"/>"), "sub/inner.xml:2:10: there is no file 'none.xml'; looked in: ., sub");
}

TEST_F(XmlDocumentErrors, IncludeCycle) {
    EXPECT_EQ(error("<include filename=\"scene.xml\"/>"), "scene.xml:2:10: include cycle: scene.xml includes scene.xml");
    write("a.xml", "<scene version=\"3.0.0\">\n<include filename=\"b.xml\"/></scene>");
    write("b.xml", "<scene version=\"3.0.0\">\n <include filename=\"./a.xml\"/></scene>");
    EXPECT_EQ(error("<include filename=\"a.xml\"/>"), "b.xml:2:11: include cycle: a.xml includes b.xml includes ./a.xml");
}

TEST_F(XmlDocumentErrors, IncludesTooDeep) {
    for (int i = 0; i < 20; ++i)
        write(std::to_string(i) + ".xml",
              "<scene version=\"3.0.0\"><include filename=\"" + std::to_string(i + 1) + ".xml\"/></scene>");
    EXPECT_EQ(error("<include filename=\"0.xml\"/>"), "14.xml:1:33: includes are nested more than 15 deep");
}

TEST_F(XmlDocumentErrors, BrokenInclude) {
    write("inner.xml", "<scene version=\"3.0.0\">\n");
    EXPECT_EQ(error("<include filename=\"inner.xml\"/>"), "inner.xml:1:24: broken XML: Start-end tags mismatch");
}

TEST_F(XmlDocumentErrors, IncludedWhereItMayNotStand) {
    write("inner.xml", "<scene version=\"3.0.0\"><alias id=\"a\" as=\"b\"/></scene>");
    EXPECT_EQ(error("<bsdf type=\"twosided\"><include filename=\"inner.xml\"/></bsdf>").substr(0, 56),
              "inner.xml:1:24: <alias> is not supported in <bsdf>; allo");
}

TEST_F(XmlDocumentErrors, MissingFolder) {
    EXPECT_EQ(error("<path value=\"meshes\"/>"), "scene.xml:2:7: there is no folder 'meshes'");
    write("sub/inner.xml", "<scene version=\"3.0.0\">\n<path value=\"meshes\"/></scene>");
    EXPECT_EQ(error("<include filename=\"sub/inner.xml\"/>"), "sub/inner.xml:2:7: there is no folder 'sub/meshes' or 'meshes'");
}

TEST_F(XmlDocumentErrors, References) {
    EXPECT_EQ(error("<shape type=\"sphere\"><ref id=\"foo\"/></shape>"),
              "scene.xml:2:27: reference to 'foo', which is not defined; no object has an id");
    EXPECT_EQ(
        error("<bsdf type=\"diffuse\" id=\"b\"/><bsdf type=\"diffuse\" id=\"a\"/><shape type=\"sphere\"><ref id=\"foo\"/></shape>"),
        "scene.xml:2:85: reference to 'foo', which is not defined; defined: a, b");
    EXPECT_EQ(error("<alias id=\"foo\" as=\"bar\"/>"), "scene.xml:2:8: alias of 'foo', which is not defined; no object has an id");
}

TEST_F(XmlDocumentErrors, IdsTakenTwice) {
    EXPECT_EQ(error("<bsdf type=\"diffuse\" id=\"a\"/>\n<bsdf type=\"diffuse\" id=\"a\"/>"),
              "scene.xml:3:22: the id 'a' is taken already, at scene.xml:2:22");
    EXPECT_EQ(error("<bsdf type=\"diffuse\" id=\"a\"/>\n<alias id=\"a\" as=\"a\"/>"),
              "scene.xml:3:15: the id 'a' is taken already, at scene.xml:2:22");
}

}  // namespace neumann::xml_document_errors_test
