// Round shapes, and shapes without a material.
#include "tests/reader/xml_scene_files.h"

namespace neumann::xml_shapes_test {

using XmlShapes = XmlTest;

TEST_F(XmlShapes, ShapesWithoutBsdf) {
    const SceneParts parts = read(
        "<shape type='cube'/><shape type='disk'/>"
        "<shape type='cube'><emitter type='area'><float name='radiance' value='3'/></emitter></shape>");
    EXPECT_EQ(parts.bsdfs.size(), 1u);
    EXPECT_EQ(largest_albedo(parts.bsdfs[0]), Rgb(0.5));
    EXPECT_EQ(parts.sides_of_shape.at(1).front, 0);
    EXPECT_EQ(parts.sides_of_shape.at(2).front, Materials::absorbing);  // a lamp without a material is black in Mitsuba
    EXPECT_EQ(parts.lights.of_shape, (std::vector<int>{Emitters::none, Emitters::none, 0}));
    EXPECT_EQ(parts.lights.area.at(0).largest, Rgb(3.0));
}

TEST_F(XmlShapes, Spheres) {
    const Sphere sphere = std::get<Sphere>(
        read("<shape type='sphere'><point name='center' x='1' y='2' z='3'/><float name='radius' value='2'/>"
             "<boolean name='flip_normals' value='true'/>"
             "<transform name='to_world'><scale value='3'/><rotate z='1' angle='90'/><translate x='10'/></transform></shape>")
            .shapes.at(0));
    EXPECT_NEAR(glm::length(sphere.center - Vec3(4.0, 3.0, 9.0)), 0.0, 1e-14);
    EXPECT_DOUBLE_EQ(sphere.radius, 6.0);
    EXPECT_TRUE(sphere.flip_normals);
    const Sphere small = std::get<Sphere>(
        read("<shape type='sphere'><transform name='to_world'><scale value='1e-200'/></transform></shape>").shapes.at(0));
    EXPECT_DOUBLE_EQ(small.radius, 1e-200);
}

TEST_F(XmlShapes, Cylinders) {
    const auto cylinder = [&](const std::string& inside) {
        return std::get<Cylinder>(read("<shape type='cylinder'>" + inside + "</shape>").shapes.at(0));
    };
    const Cylinder plain = cylinder("");
    EXPECT_EQ(plain.base, Vec3(0.0));
    EXPECT_EQ(plain.axis, Vec3(0, 0, 1));
    EXPECT_EQ(plain.length, 1.0);
    EXPECT_EQ(plain.radius, 1.0);
    EXPECT_FALSE(plain.flip_normals);
    const Cylinder placed = cylinder(
        "<point name='p0' x='1' y='2' z='3'/><point name='p1' x='1' y='2' z='7'/><float name='radius' value='0.5'/>"
        "<boolean name='flip_normals' value='true'/>"
        "<transform name='to_world'><scale value='3'/><rotate y='1' angle='90'/><translate z='10'/></transform>");
    EXPECT_NEAR(glm::length(placed.base - Vec3(9.0, 6.0, 7.0)), 0.0, 1e-14);
    EXPECT_NEAR(glm::length(placed.axis - Vec3(1, 0, 0)), 0.0, 1e-15);
    EXPECT_DOUBLE_EQ(placed.length, 12.0);
    EXPECT_DOUBLE_EQ(placed.radius, 1.5);
    EXPECT_TRUE(placed.flip_normals);
    // A scale along the axis makes it longer, one for all directions may be tiny.
    const Cylinder longer = cylinder("<transform name='to_world'><scale z='5'/></transform>");
    EXPECT_DOUBLE_EQ(longer.length, 5.0);
    EXPECT_DOUBLE_EQ(longer.radius, 1.0);
    const Cylinder small = cylinder("<transform name='to_world'><scale value='1e-200'/></transform>");
    EXPECT_DOUBLE_EQ(small.length, 1e-200);
    EXPECT_DOUBLE_EQ(small.radius, 1e-200);
}

}  // namespace neumann::xml_shapes_test
