// Whether two files make the same scene.
#pragma once

#include "core/sensor/sensor.h"
#include "tests/reader/xml_scene_files.h"

#include <gtest/gtest.h>

#include <string>

namespace neumann {

class SameSceneTest : public XmlTest {
protected:
    // Of a Mitsuba scene that says the same.
    static constexpr const char* grey = "<bsdf type='twosided' id='grey'><bsdf type='diffuse'/></bsdf>";
    static std::string with_grey(const std::string& shape) { return grey + shape; }
    static std::string to_world(const std::string& inside) { return "<transform name='to_world'>" + inside + "</transform>"; }

    // The only warning; "" for none, and all of them if there are more.
    static std::string warning(const SceneParts& parts) {
        std::string all;
        for (const auto& [text, count] : parts.warnings.counts()) all += (all.empty() ? "" : " | ") + text;
        return all;
    }

    static void expect_near(const Vec3& a, const Vec3& b, double tolerance, const std::string& what) {
        for (int i = 0; i < 3; ++i) EXPECT_NEAR(a[i], b[i], tolerance * (1.0 + std::abs(b[i]))) << what << ", component " << i;
    }

    static void expect_same_shape(const Shape& a, const Shape& b, const std::string& what) {
        ASSERT_EQ(a.index(), b.index()) << what;
        constexpr double e = 1e-9;
        if (const auto* m = std::get_if<TriangleMesh>(&a)) {
            const auto& n = std::get<TriangleMesh>(b);
            ASSERT_EQ(m->triangles.size(), n.triangles.size()) << what;
            EXPECT_EQ(m->normals.empty(), n.normals.empty()) << what;
            for (std::size_t t = 0; t < m->triangles.size(); ++t)
                for (std::size_t i = 0; i < 3; ++i) {
                    const auto v = m->triangles[t][i], w = n.triangles[t][i];
                    expect_near(m->vertices.at(v), n.vertices.at(w), e, what + ": vertex");
                    if (!m->normals.empty() && !n.normals.empty())
                        expect_near(m->normals.at(v), n.normals.at(w), e, what + ": normal");
                    if (!m->uv.empty() && !n.uv.empty())
                        expect_near(Vec3(m->uv.at(v), 0.0), Vec3(n.uv.at(w), 0.0), e, what + ": coordinates");
                }
        } else if (const auto* s = std::get_if<Sphere>(&a)) {
            const auto& t = std::get<Sphere>(b);
            expect_near(s->center, t.center, e, what + ": centre");
            EXPECT_NEAR(s->radius, t.radius, e) << what;
            EXPECT_EQ(s->flip_normals, t.flip_normals) << what;
            expect_near(s->axes.n, t.axes.n, e, what + ": axis");
            expect_near(s->axes.s, t.axes.s, e, what + ": axis");
        } else if (const auto* d = std::get_if<Disk>(&a)) {
            const auto& f = std::get<Disk>(b);
            expect_near(d->center, f.center, e, what + ": centre");
            expect_near(d->u, f.u, e, what + ": u");
            expect_near(d->v, f.v, e, what + ": v");
            expect_near(d->normal, f.normal, e, what + ": normal");
        } else {
            const auto &c = std::get<Cylinder>(a), &g = std::get<Cylinder>(b);
            expect_near(c.base, g.base, e, what + ": base");
            expect_near(c.axis, g.axis, e, what + ": axis");
            EXPECT_NEAR(c.length, g.length, e) << what;
            EXPECT_NEAR(c.radius, g.radius, e) << what;
            EXPECT_EQ(c.flip_normals, g.flip_normals) << what;
        }
    }

    // By what the materials do with a few directions.
    static void expect_same_side(const SceneParts& a, int i, const SceneParts& b, int j, const std::string& what) {
        ASSERT_EQ(i == Materials::absorbing, j == Materials::absorbing) << what;
        if (i == Materials::absorbing) return;
        const Bsdf &f = a.bsdfs.at(static_cast<std::size_t>(i)), &g = b.bsdfs.at(static_cast<std::size_t>(j));
        ASSERT_EQ(f.index(), g.index()) << what;
        for (const Vec2 uv : {Vec2(0.3, 0.2), Vec2(0.8, 0.6), Vec2(0.1, 0.9)}) {
            const ShadingPoint p = point_with_coordinates(uv);
            for (const Vec3 wo : {Vec3(0.0, 0.0, 1.0), Vec3(0.6, 0.0, 0.8), Vec3(0.48, -0.8, 0.36)})
                for (const Vec3 wi : {Vec3(0.0, 0.0, 1.0), Vec3(-0.6, 0.0, 0.8), Vec3(0.0, 0.6, -0.8), Vec3(0.48, 0.36, 0.8)})
                    expect_near(eval(f, p, wo, wi), eval(g, p, wo, wi), 1e-6, what + ": fs");
            const Vec3 slant(0.6, 0.0, 0.8);
            const BsdfSample s = sample(f, p, slant, Vec2(0.37, 0.61)), t = sample(g, p, slant, Vec2(0.37, 0.61));
            expect_near(s.wi, t.wi, 1e-6, what + ": sampled direction");
            expect_near(s.weight, t.weight, 1e-6, what + ": weight");
        }
    }

    static void expect_same_camera(const SceneParts& a, const SceneParts& b) {
        EXPECT_EQ(a.film.width, b.film.width);
        EXPECT_EQ(a.film.height, b.film.height);
        EXPECT_EQ(a.film.crop_x, b.film.crop_x);
        EXPECT_EQ(a.film.crop_y, b.film.crop_y);
        EXPECT_EQ(a.film.crop_width, b.film.crop_width);
        EXPECT_EQ(a.film.crop_height, b.film.crop_height);
        for (const double x : {3.5, 3.9, 4.7, 5.2}) EXPECT_NEAR(a.film.weight_across(x, 4), b.film.weight_across(x, 4), 1e-12) << x;
        const Sensor s(a.camera, a.film), t(b.camera, b.film);
        ASSERT_EQ(s.has_lens(), t.has_lens());
        for (const Vec2 at : {Vec2(0.0, 0.0), Vec2(8.0, 0.0), Vec2(3.0, 5.0)})
            for (const Vec2 lens : {Vec2(0.5, 0.5), Vec2(0.9, 0.2)}) {
                const CameraRay r = s.ray(at, lens), q = t.ray(at, lens);
                expect_near(r.direction, q.direction, 1e-9, "direction of a camera ray");
                // They may begin at different near planes.
                expect_near(glm::cross(r.origin - q.origin, q.direction), Vec3(0.0), 1e-9, "line of a camera ray");
            }
    }

    static void expect_same_lights(const SceneParts& a, const SceneParts& b) {
        ASSERT_EQ(a.lights.of_shape.size(), b.lights.of_shape.size());
        for (std::size_t i = 0; i < a.lights.of_shape.size(); ++i) {
            const int x = a.lights.of_shape[i], y = b.lights.of_shape[i];
            ASSERT_EQ(x == Emitters::none, y == Emitters::none) << i;
            if (x == Emitters::none) continue;
            const AreaLight &f = a.lights.area.at(static_cast<std::size_t>(x)), &g = b.lights.area.at(static_cast<std::size_t>(y));
            expect_near(f.largest, g.largest, 1e-9, "radiance");
            ASSERT_EQ(static_cast<bool>(f.function), static_cast<bool>(g.function));
            if (!f.function) continue;
            for (const Vec2 uv : {Vec2(0.3, 0.2), Vec2(0.8, 0.6)}) {
                const ShadingPoint p = point_with_coordinates(uv);
                expect_near(f.function(p, Vec3(0, 0, 1)), g.function(p, Vec3(0, 0, 1)), 1e-6, "radiance");
            }
        }
        ASSERT_EQ(a.lights.delta.size(), b.lights.delta.size());
        const Surroundings around{Vec3(0.0), 10.0};
        for (std::size_t i = 0; i < a.lights.delta.size(); ++i)
            for (const Vec3 at : {Vec3(0.1, 0.2, 5.0), Vec3(1.0, -2.0, 3.0), Vec3(0.0, 0.0, -1.0)}) {
                const Beam x = beam(a.lights.delta[i], at, around), y = beam(b.lights.delta[i], at, around);
                expect_near(x.from, y.from, 1e-9, "position of a light");
                expect_near(x.irradiance, y.irradiance, 1e-9, "irradiance");
            }
        ASSERT_EQ(a.lights.environment.has_value(), b.lights.environment.has_value());
        if (!a.lights.environment) return;
        for (const Vec3 w : {Vec3(0.6, 0.0, 0.8), Vec3(0.48, -0.8, -0.36), Vec3(-1.0, 0.0, 0.0)})
            expect_near(radiance(*a.lights.environment, w), radiance(*b.lights.environment, w), 1e-6, "light from afar");
    }

    static void expect_same(const SceneParts& a, const SceneParts& b) {
        EXPECT_EQ(a.bounces, b.bounces);
        expect_same_camera(a, b);
        ASSERT_EQ(a.shapes.size(), b.shapes.size());
        for (std::size_t i = 0; i < a.shapes.size(); ++i) {
            const std::string what = "shape " + std::to_string(i);
            expect_same_shape(a.shapes[i], b.shapes[i], what);
            expect_same_side(a, a.sides_of_shape[i].front, b, b.sides_of_shape[i].front, what + ", front");
            expect_same_side(a, a.sides_of_shape[i].back, b, b.sides_of_shape[i].back, what + ", back");
        }
        expect_same_lights(a, b);
    }
    SceneParts read(const std::string& elements) const {
        return read_file("<scene version=\"3.0.0\">\n" + elements + "\n</scene>\n");
    }
};

}  // namespace neumann
