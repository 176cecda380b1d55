// Merged shapes are read as if each of them stood in the scene.
#include "tests/reader/xml_scene_files.h"

namespace neumann::xml_merge_test {

using XmlMerge = XmlTest;

const std::string red = "<bsdf type='diffuse' id='red'><rgb name='reflectance' value='1, 0, 0'/></bsdf>";
const std::string inside =
    "<shape type='cube'><ref id='red'/></shape>"
    "<shape type='rectangle'><emitter type='area'><float name='radiance' value='2'/></emitter></shape>"
    "<shape type='sphere'><transform name='to_world'><translate x='3'/></transform></shape>";

TEST_F(XmlMerge, IsTheSceneWithoutIt) {
    const SceneParts merged = read(red + "<shape type='disk'/><shape type='merge'>" + inside + "</shape><shape type='cylinder'/>"),
                     apart = read(red + "<shape type='disk'/>" + inside + "<shape type='cylinder'/>");
    ASSERT_EQ(merged.shapes.size(), 5u);
    ASSERT_EQ(apart.shapes.size(), 5u);
    for (std::size_t i = 0; i < 5; ++i) {
        EXPECT_EQ(merged.shapes[i].index(), apart.shapes[i].index());
        EXPECT_EQ(merged.sides_of_shape[i].front, apart.sides_of_shape[i].front);
        EXPECT_EQ(merged.lights.of_shape[i], apart.lights.of_shape[i]);
    }
    EXPECT_EQ(std::get<TriangleMesh>(merged.shapes[1]).vertices, std::get<TriangleMesh>(apart.shapes[1]).vertices);
    EXPECT_EQ(std::get<Sphere>(merged.shapes[3]).center, Vec3(3, 0, 0));
    EXPECT_EQ(merged.lights.area.size(), 1u);
    EXPECT_TRUE(merged.warnings.counts().empty());
}

TEST_F(XmlMerge, MayHoldReferencesAndInstances) {
    const SceneParts parts = read(
        "<shape type='shapegroup' id='g'><shape type='merge'><shape type='sphere'/><shape type='disk'/></shape></shape>"
        "<shape type='merge'><shape type='instance'><ref id='g'/></shape><shape type='cube'/></shape>");
    ASSERT_EQ(parts.shapes.size(), 3u);
    EXPECT_TRUE(std::holds_alternative<Sphere>(parts.shapes[0]));
    EXPECT_TRUE(std::holds_alternative<Disk>(parts.shapes[1]));
    EXPECT_TRUE(std::holds_alternative<TriangleMesh>(parts.shapes[2]));
}

}  // namespace neumann::xml_merge_test
