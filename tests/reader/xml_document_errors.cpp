// What is wrong with a file as a document: XML, elements, attributes, includes, $names, ids.
#include "tests/reader/xml_scene_files.h"

namespace neumann::xml_document_errors_test {

class XmlDocumentErrors : public XmlTest {};

TEST_F(XmlDocumentErrors, Utf16) {
    EXPECT_EQ(file_error("\xFF\xFE<"), "scene.xml: is in UTF-16, expected UTF-8");
    EXPECT_EQ(file_error("\xFE\xFF"), "scene.xml: is in UTF-16, expected UTF-8");
}

TEST_F(XmlDocumentErrors, ElementsTooDeep) {
    std::string text;
    for (int i = 0; i < 101; ++i) text += "<bsdf type=\"mask\"    >";
    for (int i = 0; i < 101; ++i) text += "</bsdf>";
    EXPECT_EQ(error(text), "scene.xml:2:2201: elements are nested more than 100 deep");
}

TEST_F(XmlDocumentErrors, EndlesslyGrowingValues) {
    std::string body = "<default name=\"a0\" value=\"0123456789abcdef\"/>\n";
    for (int i = 1; i < 40; ++i) {
        const std::string before = "$a" + std::to_string(i - 1) + " ";
        body += "<default name=\"a" + std::to_string(i) + "\" value=\"" + before + before + "\"/>\n";
    }
    EXPECT_EQ(error(body), "scene.xml:22:21: the value is longer than 16777216 characters once its parameters are put in");
}

TEST_F(XmlDocumentErrors, IncludesTooDeep) {
    for (int i = 0; i < 20; ++i)
        write(std::to_string(i) + ".xml",
              "<scene version=\"3.0.0\"><include filename=\"" + std::to_string(i + 1) + ".xml\"/></scene>");
    EXPECT_EQ(error("<include filename=\"0.xml\"/>"), "14.xml:1:33: includes are nested more than 15 deep");
}

}  // namespace neumann::xml_document_errors_test
