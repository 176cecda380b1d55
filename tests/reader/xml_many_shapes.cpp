// Shapes are read side by side; nothing of that shows.
#include "tests/reader/xml_scene_files.h"

#include <fmt/format.h>

namespace neumann::xml_many_shapes_test {

class XmlManyShapes : public XmlTest {
protected:
    // A triangle whose first vertex is at (index, 0, 0), behind enough comments that small files overtake large ones.
    void write_obj(int index, int comments = 0) const {
        std::string text;
        for (int i = 0; i < comments; ++i) text += "# a comment\n";
        write(fmt::format("{}.obj", index), text + fmt::format("v {} 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 3\n", index));
    }
    static std::string obj(const std::string& name) {
        return "<shape type='obj'><string name='filename' value='" + name + "'/></shape>\n";
    }
};

TEST_F(XmlManyShapes, KeepTheirOrder) {
    constexpr int count = 300;
    std::string text;
    for (int i = 0; i < count; ++i) {
        write_obj(i, i % 7 == 0 ? 5000 : 0);
        text += obj(fmt::format("{}.obj", i));
    }
    const SceneParts parts = read(text);
    ASSERT_EQ(parts.shapes.size(), static_cast<std::size_t>(count));
    for (int i = 0; i < count; ++i)
        EXPECT_EQ(std::get<TriangleMesh>(parts.shapes[static_cast<std::size_t>(i)]).vertices[0], Vec3(i, 0, 0));
    EXPECT_EQ(read(text).hash, parts.hash);
}

TEST_F(XmlManyShapes, AllErrorsAreToldInTheOrderOfTheShapes) {
    std::string text;
    for (int i = 0; i < 100; ++i) {
        write_obj(i);
        text += obj(fmt::format("{}.obj", i));
    }
    write("10.obj", std::string(100'000, '\n') + "v 0 0 zero\n");  // found last
    write("11.obj", "v 0 0\n");
    write("90.obj", "v");
    const std::string all =
        "10.obj:100001:7: expected a number, found 'zero'\n"
        "11.obj:1:6: expected a number, found the end of the line\n"
        "90.obj:1:2: expected a number, found the end of the file";
    for (int i = 0; i < 5; ++i) ASSERT_EQ(error(text), all);
    const std::string wrong = "<shape type='cube'><bsdf type='diffuse'><float name='reflectance' value='x'/></bsdf></shape>\n";
    EXPECT_EQ(error(wrong + text), "scene.xml:2:67: 'x' is not a number\n" + all);
    EXPECT_EQ(error(text + wrong), all + "\nscene.xml:102:67: 'x' is not a number");
    EXPECT_EQ(error("<shape type='instance'/>\n" + text),
              "scene.xml:2:1: shape 'instance' has no shapegroup inside, expected one\n" + all);
}

}  // namespace neumann::xml_many_shapes_test
