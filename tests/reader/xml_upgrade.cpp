// Files of older versions mean what the same scene means in today's names.
#include "tests/reader/xml_scene_files.h"

namespace neumann::xml_upgrade_test {

const std::string names = "old scene file: a name in camelCase taken in snake_case";
const std::string lookat = "old scene file: <lookAt> taken as <lookat>";

class XmlUpgrade : public XmlTest {
protected:
    SceneParts read_version(const std::string& version, const std::string& body) const {
        return read_file("<scene version=\"" + version + "\">\n" + body + "</scene>");
    }
};

TEST_F(XmlUpgrade, WholeScene) {
    const SceneParts now = read_version(
        "3.0.0",
        "<integrator type='path'><integer name='max_depth' value='5'/><integer name='rr_depth' value='3'/>"
        "<boolean name='hide_emitters' value='true'/></integrator>"
        "<sensor type='perspective'><float name='fov' value='30'/><string name='fov_axis' value='smaller'/>"
        "<float name='near_clip' value='10'/><float name='far_clip' value='2800'/><float name='focus_distance' value='1000'/>"
        "<transform name='to_world'><lookat origin='0 1 5' target='0 1 0' up='0 1 0'/></transform>"
        "<sampler type='independent'><integer name='sample_count' value='32'/></sampler>"
        "<film type='hdrfilm'><integer name='width' value='64'/><integer name='height' value='32'/>"
        "<integer name='crop_offset_x' value='4'/><string name='pixel_format' value='rgb'/><rfilter type='tent'/></film></sensor>"
        "<shape type='sphere'><float name='radius' value='2'/><boolean name='flip_normals' value='true'/>"
        "<transform name='to_world'><translate x='1'/></transform>"
        "<bsdf type='diffuse'><rgb name='reflectance' value='0.1, 0.2, 0.3'/></bsdf></shape>"
        "<shape type='cube'><bsdf type='roughconductor'><float name='alpha_u' value='0.2'/><float name='alpha_v' value='0.2'/>"
        "<rgb name='specular_reflectance' value='0.9'/></bsdf></shape>");
    const std::string old_text =
        "<integrator type='path'><integer name='maxDepth' value='5'/><integer name='rrDepth' value='3'/>"
        "<boolean name='hideEmitters' value='true'/></integrator>"
        "<sensor type='perspective'><float name='fov' value='30'/><string name='fovAxis' value='smaller'/>"
        "<float name='nearClip' value='10'/><float name='farClip' value='2800'/><float name='focusDistance' value='1000'/>"
        "<transform name='toWorld'><lookAt origin='0 1 5' target='0 1 0' up='0 1 0'/></transform>"
        "<sampler type='independent'><integer name='sampleCount' value='32'/></sampler>"
        "<film type='hdrfilm'><integer name='width' value='64'/><integer name='height' value='32'/>"
        "<integer name='cropOffsetX' value='4'/><string name='pixelFormat' value='rgb'/><rfilter type='tent'/></film></sensor>"
        "<shape type='sphere'><float name='radius' value='2'/><boolean name='flipNormals' value='true'/>"
        "<transform name='toWorld'><translate x='1'/></transform>"
        "<bsdf type='diffuse'><rgb name='diffuseReflectance' value='0.1, 0.2, 0.3'/></bsdf></shape>"
        "<shape type='cube'><bsdf type='roughconductor'><float name='alphaU' value='0.2'/><float name='alphaV' value='0.2'/>"
        "<rgb name='specularReflectance' value='0.9'/></bsdf></shape>";
    EXPECT_TRUE(now.warnings.counts().empty());
    for (const char* version : {"0.4.0", "0.5.0", "0.6.0", "1.0.0"}) {
        const SceneParts old = read_version(version, old_text);
        EXPECT_EQ(old.bounces, now.bounces);
        EXPECT_EQ(old.hide_emitters, now.hide_emitters);
        EXPECT_TRUE(old.hide_emitters);
        EXPECT_EQ(old.sampler, now.sampler);
        EXPECT_EQ(old.camera.to_world, now.camera.to_world);
        EXPECT_EQ(old.camera.fov, now.camera.fov);
        EXPECT_EQ(old.camera.fov_axis, now.camera.fov_axis);
        EXPECT_EQ(old.camera.near_clip, now.camera.near_clip);
        EXPECT_EQ(old.camera.far_clip, now.camera.far_clip);
        EXPECT_EQ(old.film.width, now.film.width);
        EXPECT_EQ(old.film.crop_x, now.film.crop_x);
        EXPECT_EQ(old.film.crop_width, now.film.crop_width);
        EXPECT_EQ(old.film.filter.index(), now.film.filter.index());
        ASSERT_EQ(old.shapes.size(), now.shapes.size());
        const auto &old_sphere = std::get<Sphere>(old.shapes[0]), &sphere = std::get<Sphere>(now.shapes[0]);
        EXPECT_EQ(old_sphere.center, sphere.center);
        EXPECT_EQ(old_sphere.radius, sphere.radius);
        EXPECT_EQ(old_sphere.flip_normals, sphere.flip_normals);
        ASSERT_EQ(old.bsdfs.size(), now.bsdfs.size());
        for (std::size_t i = 0; i < now.bsdfs.size(); ++i) EXPECT_EQ(largest_albedo(old.bsdfs[i]), largest_albedo(now.bsdfs[i]));
        EXPECT_EQ(lobe(old.bsdfs[1]).alpha, 0.2);
        EXPECT_EQ(old.warnings.counts(),
                  (Warnings::Counts{
                      {names, 17}, {lookat, 1}, {"old scene file: diffuseReflectance of bsdf 'diffuse' taken as reflectance", 1}}));
    }
}

TEST_F(XmlUpgrade, ParametersKeepTheirNames) {
    const SceneParts parts = read_version("0.6.0",
                                          "<default name='maxDepth' value='7'/>"
                                          "<integrator type='path'><integer name='maxDepth' value='$maxDepth'/></integrator>"
                                          "<sensor type='perspective'><float name='fov' value='40'/></sensor>");
    EXPECT_EQ(parts.bounces, 6);
}

TEST_F(XmlUpgrade, EachFileHasItsVersion) {
    write("old.xml",
          "<scene version='0.5.0'><bsdf type='diffuse' id='grey'><float name='diffuseReflectance' value='0.25'/></bsdf></scene>");
    const SceneParts parts = read("<include filename='old.xml'/><shape type='cube'><ref id='grey'/></shape>");
    EXPECT_EQ(largest_albedo(parts.bsdfs.at(0)), Rgb(0.25));
}

// What Mitsuba 3 no longer has, and which picture it asks for all the same.
TEST_F(XmlUpgrade, WhatIsGone) {
    write("a.pgm", "P2 2 1 255\n0 255\n");
    const SceneParts parts = read_version(
        "0.5.0",
        "<integrator type='path'><boolean name='strictNormals' value='true'/><integer name='maxDepth' value='65'/></integrator>"
        "<sensor type='perspective'><float name='fov' value='40'/>"
        "<sampler type='sobol'><integer name='sampleCount' value='64'/><integer name='scramble' value='0'/></sampler>"
        "<film type='ldrfilm'><integer name='width' value='64'/><integer name='height' value='32'/>"
        "<string name='fileFormat' value='png'/><string name='pixelFormat' value='rgb'/><float name='gamma' value='2.2'/>"
        "<boolean name='highQualityEdges' value='true'/><boolean name='banner' value='false'/><rfilter "
        "type='tent'/></film></sensor>"
        "<shape type='cube'><bsdf type='diffuse'><texture type='bitmap' name='reflectance'>"
        "<string name='filename' value='a.pgm'/><string name='filterType' value='trilinear'/></texture></bsdf></shape>");
    EXPECT_EQ(parts.bounces, 64);
    EXPECT_EQ(parts.sampler, SamplerKind::sobol);
    EXPECT_EQ(parts.film.width, 64);
    EXPECT_TRUE(parts.film.sample_border);
    EXPECT_EQ(parts.warnings.counts(), (Warnings::Counts{{names, 7},
                                                         {"old scene file: sampler 'sobol' taken as 'ldsampler'", 1},
                                                         {"old scene file: film 'ldrfilm' taken as 'hdrfilm'", 1},
                                                         {"old scene file: the texture filter 'trilinear' taken as 'bilinear'", 1},
                                                         {"old scene file: strictNormals of an integrator left out", 1}}));
}

// What exporters write: metals in air, opacities as colours, pictures with their gamma.
TEST_F(XmlUpgrade, IndicesOpacityAndGamma) {
    const std::string sensor = "<sensor type='perspective'><float name='fov' value='40'/></sensor>";
    write("a.pgm", "P2 1 1 255\n51\n");
    const auto bitmap = [&](const std::string& gamma) {
        const SceneParts parts = read_version("0.5.0", sensor +
                                                           "<shape type='cube'><bsdf type='diffuse'><texture type='bitmap' "
                                                           "name='reflectance'><string name='filename' value='a.pgm'/>" +
                                                           gamma + "</texture></bsdf></shape>");
        return reflectance(parts.bsdfs.at(0), point_with_coordinates({0.5, 0.5})).g;
    };
    EXPECT_DOUBLE_EQ(bitmap("<float name='gamma' value='1'/>"), 0.2);
    for (const char* srgb : {"-1", "2.2"}) EXPECT_EQ(bitmap(std::string("<float name='gamma' value='") + srgb + "'/>"), bitmap(""));

    const SceneParts metal =
        read_version("0.5.0", sensor +
                                  "<shape type='cube'><bsdf type='roughconductor'><float name='extEta' value='1'/>"
                                  "<string name='material' value='Cu'/></bsdf></shape>");
    const SceneParts same =
        read("<shape type='cube'><bsdf type='roughconductor'><string name='material' value='Cu'/></bsdf></shape>");
    EXPECT_EQ(largest_albedo(metal.bsdfs.at(0)), largest_albedo(same.bsdfs.at(0)));
    EXPECT_EQ(metal.warnings.counts().count("old scene file: extEta of a metal left out, which is air"), 1u);

    const SceneParts glass =
        read_version("0.5.0", sensor +
                                  "<shape type='cube'><bsdf type='roughdielectric'><float name='intEta' value='1.4'/>"
                                  "<float name='extEta' value='1.2'/></bsdf></shape>");
    EXPECT_DOUBLE_EQ(refractive_ratio(glass.bsdfs.at(0)), 1.4 / 1.2);

    const auto opacity = [&](const std::string& rgb) {
        const SceneParts parts = read_version("0.5.0", sensor + "<shape type='cube'><bsdf type='mask'><rgb name='opacity' value='" +
                                                           rgb + "'/><bsdf type='diffuse'/></bsdf></shape>");
        return 1.0 - largest_albedo(parts.bsdfs.at(static_cast<std::size_t>(parts.sides_of_shape.at(0).back))).g;
    };
    EXPECT_DOUBLE_EQ(opacity("0.3"), 0.3);
    EXPECT_NEAR(opacity("0.2, 0.3, 0.7"), 0.4, 1e-15);
}

// Mitsuba 0.6 sees everything under equal energy, where a surface that reflects 0.78 of all wavelengths is not grey in sRGB.
TEST_F(XmlUpgrade, SpectraUnderEqualEnergy) {
    const std::string grey = "400:0.78, 700:0.78";
    const auto parts = [&](const std::string& version, const std::string& value) {
        return read_version(version,
                            "<sensor type='perspective'><float name='fov' value='40'/></sensor>"
                            "<emitter type='point'><spectrum name='intensity' value='" +
                                value +
                                "'/></emitter><shape type='sphere'><bsdf type='diffuse'><spectrum name='reflectance' value='" +
                                value + "'/></bsdf></shape>");
    };
    const auto reflectance = [](const SceneParts& p) { return largest_albedo(p.bsdfs.at(0)); };
    const auto intensity = [](const SceneParts& p) {
        return std::visit([](const auto& light) { return light.beam(Vec3(0, 0, 1), {}).irradiance; }, p.lights.delta.at(0));
    };
    const SceneParts old = parts("0.5.0", grey), now = parts("3.0.0", grey);
    const Rgb equal(0.936461, 0.740433, 0.705267);  // of Mitsuba, as in spectrum_to_rgb.cpp
    for (int c = 0; c < 3; ++c) {
        EXPECT_NEAR(reflectance(old)[c], equal[c], 8e-4);
        EXPECT_EQ(intensity(old)[c], intensity(now)[c]);
    }
    EXPECT_LT(reflectance(now).r, 0.8);
    EXPECT_EQ(old.warnings.counts().count("old scene file: a spectrum taken as its colour under equal energy, as Mitsuba 0.6 does"),
              1u);
    // One value is that of all three channels, of light, too.
    EXPECT_EQ(reflectance(parts("0.6.0", "0.25")), Rgb(0.25));
    EXPECT_EQ(intensity(parts("0.6.0", "0.25")), Rgb(0.25));
    EXPECT_NE(intensity(parts("3.0.0", "0.25")), Rgb(0.25));
    EXPECT_EQ(reflectance(parts("0.6.0", "0.1, 0.2, 0.3")), Rgb(0.1, 0.2, 0.3));
}

// What changes nothing here, or has a new name.
TEST_F(XmlUpgrade, ParametersOfOldVersions) {
    const auto sensor = [](const std::string& inside) {
        return "<sensor type='perspective'><float name='fov' value='40'/>" + inside + "</sensor>";
    };
    EXPECT_EQ(read_version("0.5.0", sensor("<sampler type='ldsampler'><integer name='sampleCount' value='64'/>"
                                           "<integer name='dimension' value='4'/></sampler>"))
                  .sampler,
              SamplerKind::sobol);
    const std::string film = "<film type='hdrfilm'><boolean name='high_quality_edges' value='true'/></film>";
    for (const std::string version : {"2.0.0", "2.1.0", "2.2.1"})
        EXPECT_TRUE(read_version(version, sensor(film)).film.sample_border) << version;
    write("roof.obj", "v 0 0 0\nv 1 0 0\nv 1 1 1\nv 0 1 1\nv 1 2 0\nv 0 2 0\nf 1 2 3 4\nf 4 3 5 6\n");
    const auto roof = [&](const std::string& angle) {
        return read_version("0.6.0",
                            sensor("") +
                                "<shape type='obj'><string name='filename' value='roof.obj'/><float name='maxSmoothAngle' value='" +
                                angle + "'/></shape>");
    };
    EXPECT_TRUE(std::get<TriangleMesh>(roof("0").shapes.at(0)).normals.empty());
    EXPECT_FALSE(std::get<TriangleMesh>(roof("45").shapes.at(0)).normals.empty());
    EXPECT_EQ(roof("45").warnings.counts().count(
                  "old scene file: maxSmoothAngle of a shape left out: all of its edges are smooth, or as its normals have them"),
              1u);
}

TEST_F(XmlUpgrade, ColoursOfVertices) {
    write(
        "colours.ply",
        "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
        "property float r\nproperty float g\nproperty float b\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n"
        "0 0 0 1 0 0.5\n1 0 0 1 0 0.5\n1 1 0 1 0 0.5\n3 0 1 2\n");
    const SceneParts parts =
        read_version("0.6.0",
                     "<sensor type='perspective'><float name='fov' value='40'/></sensor>"
                     "<shape type='ply'><string name='filename' value='colours.ply'/><boolean name='collapse' value='true'/>"
                     "<bsdf type='diffuse'><texture name='reflectance' type='vertexcolors'/></bsdf></shape>");
    EXPECT_EQ(largest_albedo(parts.bsdfs.at(0)), Rgb(1.0, 0.0, 0.5));
    EXPECT_EQ(parts.warnings.counts(), (Warnings::Counts{{"old scene file: texture 'vertexcolors' taken as 'mesh_attribute'", 1}}));
}

// Mitsuba 0.6 has the sky's +y up, the north at −z and the east at +x.
TEST_F(XmlUpgrade, SkyAndSun) {
    const std::string sensor = "<sensor type='perspective'><float name='fov' value='40'/></sensor>";
    const auto surroundings = [&](const std::string& version, const std::string& type, const std::string& inside) {
        return read_version(version, sensor + "<emitter type='" + type + "'>" + inside + "</emitter>").lights.environment.value();
    };
    const auto expect_near = [](const Rgb& a, const Rgb& b) {
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(a[c], b[c], 1e-9 * (1.0 + b[c]));
    };
    const Vec3 sun(0.0, 0.8, 0.6), elsewhere = glm::normalize(Vec3(1, 3, 2));
    const SkyModel sky(3.0, Rgb(0.2), std::asin(0.8));
    const std::string direction = "<vector name='sunDirection' x='0' y='0.8' z='0.6'/>";
    const Rgb there = sky.radiance(elsewhere.y, glm::dot(elsewhere, sun));
    expect_near(radiance(surroundings("0.6.0", "sunsky", direction), elsewhere), there);
    expect_near(radiance(surroundings("0.6.0", "sunsky", direction + "<float name='skyScale' value='3'/>"), elsewhere),
                there * 3.0);
    const Environment alone = surroundings("0.5.0", "sky",
                                           direction + "<float name='scale' value='2'/><integer name='resolution' value='9'/>"),
                      other = surroundings("0.5.0", "sun", direction + "<float name='sunRadiusScale' value='10'/>");
    expect_near(radiance(alone, sun), sky.radiance(0.8, 1.0) * 2.0);
    EXPECT_EQ(radiance(other, elsewhere), Rgb(0.0));
    EXPECT_GT(radiance(other, glm::normalize(sun + Vec3(0.03, 0, 0))).r, 50.0);
    EXPECT_EQ(radiance(other, glm::normalize(sun + Vec3(0.05, 0, 0))), Rgb(0.0));

    // A June morning at 45° north: the sun is in the east, at +x, and somewhat in the north, at −z.
    const Environment morning =
        surroundings("0.6.0", "sunsky",
                     "<float name='latitude' value='45'/><float name='longitude' value='0'/><float name='timezone' value='0'/>"
                     "<integer name='month' value='6'/><integer name='day' value='21'/><float name='hour' value='6'/>");
    const Vec3 dir(std::cos(0.27) * std::cos(0.3), std::sin(0.27), -std::cos(0.27) * std::sin(0.3));
    EXPECT_GT(radiance(morning, dir).g, 2.0 * radiance(morning, {-dir.x, dir.y, dir.z}).g);
    EXPECT_GT(radiance(morning, dir).g, radiance(morning, {dir.x, dir.y, -dir.z}).g);

    const SceneParts parts = read_version("0.6.0", sensor + "<emitter type='sky'/>");
    EXPECT_EQ(parts.warnings.counts(), (Warnings::Counts{{"old scene file: emitter 'sky' taken as 'sunsky'", 1},
                                                         {"old scene file: emitter 'sunsky' turned, for its +y was up", 1}}));
}

}  // namespace neumann::xml_upgrade_test
