// What the courses CMU 15-462 and Berkeley CS184 add to COLLADA.
#include "tests/reader/collada_files.h"

namespace neumann::collada_course_test {

class ColladaCourse : public ColladaTest {
protected:
    static std::string technique(const std::string& inside) {
        return "<extra><technique profile=\"CMU462\">" + inside + "</technique></extra>";
    }
    SceneParts material(const std::string& inside) const { return read_changed({{"</effect>", technique(inside) + "</effect>"}}); }
    static Changes light(const std::string& inside, const std::string& node = "<translate>0 0 2</translate>") {
        return {{"</light>", technique(inside) + "</light>"}, {"<translate>0 0 2</translate>", node}};
    }
    static std::string with_mesh_lamp(const std::string& translate) {
        return changed({{"</light>", technique("<area><color>7 8 9</color></area>") + "</light>"},
                        {"</effect>", technique("<emission><radiance>7 8 9</radiance></emission>") + "</effect>"},
                        {"<translate>1 2 3</translate><scale>2 2 2</scale>", translate}});
    }
};

// A square of 1×1 around the node, facing its −z, scaled with it.
TEST_F(ColladaCourse, AreaLight) {
    const SceneParts parts =
        read_changed(light("<area><color>7 8 9</color></area>", "<matrix>0.6 0 0 1 0 0.8 0 2 0 0 1 3 0 0 0 1</matrix>"));
    ASSERT_EQ(parts.shapes.size(), 2u);
    double area = 0.0;
    const std::vector<Vec3> c = corners(mesh(parts));
    for (std::size_t i = 0; i < c.size(); i += 3) {
        const Vec3 normal = glm::cross(c[i + 1] - c[i], c[i + 2] - c[i]);
        EXPECT_LT(normal.z, 0.0);
        area += 0.5 * glm::length(normal);
        for (std::size_t k = i; k < i + 3; ++k) {
            EXPECT_NEAR(std::abs(c[k].x - 1.0), 0.3, 1e-15);
            EXPECT_NEAR(std::abs(c[k].y - 2.0), 0.4, 1e-15);
            EXPECT_EQ(c[k].z, 3.0);
        }
    }
    EXPECT_NEAR(area, 0.48, 1e-15);
    EXPECT_EQ(parts.lights.of_shape.at(0), 0);
    EXPECT_TRUE(parts.lights.delta.empty());  // in place of the common profile's
    // The same for a node that mirrors.
    const SceneParts mirrored =
        read_changed(light("<area><color>7 8 9</color></area>", "<matrix>-0.6 0 0 1 0 0.8 0 2 0 0 1 3 0 0 0 1</matrix>"));
    const std::vector<Vec3> m = corners(mesh(mirrored));
    EXPECT_LT(glm::cross(m[1] - m[0], m[2] - m[0]).z, 0.0);
}

// A mesh that is the visible body of an area light gives no light in addition; elsewhere it is a lamp of its own.
TEST_F(ColladaCourse, LampsCountOnce) {
    const SceneParts once = read_dae(with_mesh_lamp("<translate>0.2 0 2</translate><rotate>1 0 0 180</rotate>"));
    EXPECT_EQ(once.shapes.size(), 1u);
    EXPECT_EQ(
        once.warnings.counts().count("the geometry 'square' gives off light and lies on an area light: its light counts once, and "
                                     "the geometry is left out"),
        1u);
    EXPECT_EQ(read_dae(with_mesh_lamp("<translate>0 0 1.99</translate>")).shapes.size(), 2u);
    EXPECT_EQ(read_dae(with_mesh_lamp("<translate>4 0 2</translate>")).shapes.size(), 2u);
}

TEST_F(ColladaCourse, Materials) {
    const SceneParts lamp = material("<emission><radiance>4 5 6</radiance></emission>");
    EXPECT_EQ(lamp.lights.of_shape.at(0), 0);
    EXPECT_EQ(lamp.sides_of_shape.at(0).front, Materials::absorbing);

    const SceneParts mirror = material("<mirror><reflectance>0.9 0.8 0.7</reflectance></mirror>");
    EXPECT_EQ(sample(front(mirror), {}, Vec3(0.6, 0, 0.8), Vec2(0.5)).weight, Rgb(0.9, 0.8, 0.7));
    EXPECT_EQ(mirror.sides_of_shape.at(0).back, mirror.sides_of_shape.at(0).front);

    // (1 − 1/2)² / (1 + 2)² · 4 = 1/9 is reflected; radiance is 1/η² as large after light has left the glass.
    const SceneParts glass = material(
        "<glass><reflectance>1 1 0.5</reflectance><transmittance>1 0.75 "
        "0.5</transmittance><roughness>0</roughness><ior>2</ior></glass>");
    EXPECT_EQ(sample(front(glass), {}, Vec3(0, 0, 1), Vec2(0.05, 0.5)).weight, Rgb(1.0, 1.0, 0.5));
    EXPECT_EQ(sample(front(glass), {}, Vec3(0, 0, 1), Vec2(0.5, 0.5)).weight, Rgb(1.0, 0.75, 0.5) * 0.25);

    // 1/9 of the light is lost, since the program's refraction reflects nothing.
    const SceneParts refraction = material("<refraction><transmittance>1 0.75 0.5</transmittance><ior>2</ior></refraction>");
    Rgb reflected(0.0), let_through(0.0);
    constexpr int steps = 900;
    for (int i = 0; i < steps; ++i) {
        const BsdfSample s = sample(front(refraction), {}, Vec3(0, 0, 1), Vec2((i + 0.5) / steps, 0.5));
        (s.wi.z > 0.0 ? reflected : let_through) += s.weight / double{steps};
    }
    EXPECT_EQ(reflected, Rgb(0.0));
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(let_through[c], Rgb(1.0, 0.75, 0.5)[c] * 0.25 * 8.0 / 9.0, 1e-9);
    EXPECT_EQ(warnings(refraction).front(),
              "material 'red': a refraction lets through what Fresnel's equations leave, and not all as in the course's program");

    const SceneParts metal = material("<microfacet><eta>0.2 0.9 1.1</eta><k>3.9 2.4 2.2</k><alpha>0.05</alpha></microfacet>");
    EXPECT_TRUE(std::holds_alternative<RoughConductor<Beckmann>>(front(metal)));
    EXPECT_EQ(lobe(front(metal)).alpha, 0.05);
}

TEST_F(ColladaCourse, SpheresAreExact) {
    const SceneParts parts = read_changed({{"<mesh>", technique("<sphere><radius>0.3</radius></sphere>") + "<mesh>"}});
    const auto& sphere = std::get<Sphere>(parts.shapes.at(0));
    EXPECT_NEAR(sphere.radius, 0.6, 1e-15);
    EXPECT_EQ(sphere.center, Vec3(1, 2, 3));
}

// From above the horizon, whichever axis is up. The irradiance of a hemisphere of radiance 1 is π.
TEST_F(ColladaCourse, AmbientIsASky) {
    for (int axis = 0; axis < 3; ++axis) {
        Changes changes = light("<ambient><color>1 2 3</color></ambient>");
        changes.push_back({"Z_UP", std::string(1, "XYZ"[axis]) + "_UP"});
        const Environment sky = read_changed(changes).lights.environment.value();
        double irradiance = 0.0;
        constexpr int steps = 20000;
        for (int i = 0; i < steps; ++i) {
            const double sine = (i + 0.5) / steps;
            Vec3 w(std::sqrt(1.0 - sine * sine));
            w[axis] = 0.0;
            w /= std::sqrt(2.0);
            w[axis] = sine;
            irradiance += radiance(sky, w).r * sine;
            w[axis] = -sine;
            if (sine > 0.02) {
                EXPECT_EQ(radiance(sky, w).r, 0.0);
            }
        }
        EXPECT_NEAR(2.0 * M_PI * irradiance / steps, M_PI, 1e-4);
    }
}

// A light that the file does not have, and a camera that cannot be placed, are no errors in a course's file, as in its program.
TEST_F(ColladaCourse, WhatItsProgramForgives) {
    const std::string radius = technique("<sphere><radius>1</radius></sphere>") + "<mesh>";
    const SceneParts no_light = read_changed({{"<mesh>", radius}, {"url=\"#lamp\"", "url=\"#Hemi\""}});
    EXPECT_EQ(
        no_light.warnings.counts().count("the light 'Hemi', which the file does not have, is left out, as in the course's program"),
        1u);
    const SceneParts no_matrix =
        read_changed({{"<mesh>", radius}, {"<translate>0 0 5</translate>", "<matrix>-1 0 0 0 0 0 1 3 0 0 0 0 0 0 1</matrix>"}});
    // The sphere's box is [-1, 3] × [0, 4] × [1, 5]; the program's direction is (0, 3, 0) − (0, 1, 0).
    EXPECT_NEAR(glm::distance(Vec3(no_matrix.camera.to_world[3]), Vec3(1, 2 + 3 * std::sqrt(12.0), 3)), 0.0, 1e-13);
    EXPECT_NEAR(glm::distance(Vec3(no_matrix.camera.to_world[2]), Vec3(0, -1, 0)), 0.0, 1e-15);
}

// The view of its program unless the file's is asked for, with what clips there: both have the file's field of view.
TEST_F(ColladaCourse, WhoseView) {
    const std::string text = changed({{"<mesh>", technique("<sphere><radius>1</radius></sphere>") + "<mesh>"}});
    // The sphere's box is [-1, 3] × [0, 4] × [1, 5]; the program's direction is (0, 0, 5) − (0, 0, 1).
    const SceneParts program = read_dae(text), file = read_dae(text, {{"camera", "file"}});
    EXPECT_NEAR(glm::distance(Vec3(program.camera.to_world[3]), Vec3(1, 2, 3 + 3 * std::sqrt(12.0))), 0.0, 1e-13);
    EXPECT_EQ(Vec3(file.camera.to_world[3]), Vec3(0, 0, 5));
    EXPECT_EQ(file.camera.far_clip, 90.0);
    EXPECT_NE(program.camera.far_clip, 90.0);
    EXPECT_EQ(program.camera.fov, file.camera.fov);
    EXPECT_EQ(program.warnings.counts().count(
                  "the camera's direction is the file's, and it stands where it sees the whole scene, as in the "
                  "course's program; -D camera=file takes its place, too"),
              1u);
    // Other files have no other view.
    EXPECT_EQ(Vec3(read_dae(small(), {{"camera", "file"}}).camera.to_world[3]), Vec3(0, 0, 5));
    // 16 numbers are a view as ever.
    EXPECT_EQ(Vec3(read_dae(text, {{"camera", "1 0 0 7 0 1 0 8 0 0 1 9 0 0 0 1"}}).camera.to_world[3]), Vec3(7, 8, 9));
}

}  // namespace neumann::collada_course_test
