// What the reader makes of scenes that are right.
#include "tests/reader/xml_scene_files.h"

#include <numbers>

namespace neumann {

class XmlAccepted : public XmlTest {
protected:
    SceneParts read_sensor(const std::string& inside) const {
        return read_file("<scene version=\"3.0.0\"><sensor type=\"perspective\">\n" + inside + "</sensor></scene>");
    }
    static double radians(double degrees) { return degrees * std::numbers::pi / 180.0; }
    Rgb reflectance(const std::string& parameter) const {
        const SceneParts parts = read("<shape type='cube'><bsdf type='diffuse'>" + parameter + "</bsdf></shape>");
        return largest_albedo(parts.bsdfs.at(0));
    }
};

TEST_F(XmlAccepted, Defaults) {
    const SceneParts parts = read("");
    EXPECT_TRUE(parts.shapes.empty());
    EXPECT_TRUE(parts.bsdfs.empty());
    EXPECT_FALSE(parts.bounces);
    EXPECT_FALSE(parts.sampler);
    EXPECT_EQ(parts.film.width, 768);
    EXPECT_EQ(parts.film.height, 576);
    EXPECT_EQ(parts.film.crop_width, 768);
    EXPECT_EQ(parts.film.crop_height, 576);
    ASSERT_TRUE(std::holds_alternative<GaussianFilter>(parts.film.filter));
    EXPECT_EQ(std::get<GaussianFilter>(parts.film.filter).radius(), 2.0);
    EXPECT_EQ(parts.camera.to_world, Mat4(1.0));
    EXPECT_DOUBLE_EQ(parts.camera.fov, radians(40.0));
    EXPECT_EQ(parts.camera.fov_axis, FovAxis::x);
    EXPECT_EQ(parts.camera.near_clip, 1e-2);
    EXPECT_EQ(parts.camera.far_clip, 1e4);
    EXPECT_TRUE(parts.warnings.counts().empty());
}

TEST_F(XmlAccepted, OldestCompatibleVersion) {
    EXPECT_NO_THROW(
        read_file("\xEF\xBB\xBF<?xml version='1.0' encoding='utf-8'?>\n<!-- a scene -->\n<scene version=\"2.0.0\">"
                  "<sensor type=\"perspective\"><float name=\"fov\" value=\"40\"/></sensor></scene>"));
}

TEST_F(XmlAccepted, Camera) {
    const SceneParts parts = read_sensor(
        "<float name='fov' value='30'/><string name='fov_axis' value='smaller'/><float name='near_clip' value='10'/>"
        "<integer name='far_clip' value='2800'/><float name='focus_distance' value='1000'/>"
        "<float name='principal_point_offset_x' value='0.25'/><float name='principal_point_offset_y' value='-0.5'/>");
    EXPECT_DOUBLE_EQ(parts.camera.fov, radians(30.0));
    EXPECT_EQ(parts.camera.fov_axis, FovAxis::smaller);
    EXPECT_EQ(parts.camera.near_clip, 10.0);
    EXPECT_EQ(parts.camera.far_clip, 2800.0);
    EXPECT_EQ(parts.camera.principal_point_offset, Vec2(0.25, -0.5));
}

TEST_F(XmlAccepted, FocalLength) {
    for (const char* given : {"<string name='focal_length' value='50mm'/>", ""}) {
        const SceneParts parts = read_sensor(given);
        EXPECT_EQ(parts.camera.fov_axis, FovAxis::diagonal);
        EXPECT_NEAR(parts.camera.fov * 180.0 / std::numbers::pi, 46.7930, 1e-4);  // what a 50 mm lens is known for
    }
}

TEST_F(XmlAccepted, OtherSensors) {
    const auto camera = [&](const std::string& type, const std::string& inside) {
        return read_file("<scene version='3.0.0'><sensor type='" + type + "'>" + inside + "</sensor></scene>").camera;
    };
    const SensorOptions lens = camera("thinlens", "<float name='aperture_radius' value='0.1'/><float name='fov' value='30'/>");
    EXPECT_EQ(lens.kind, SensorOptions::Kind::thin_lens);
    EXPECT_EQ(lens.aperture_radius, 0.1);
    EXPECT_EQ(lens.focus_distance, 1e4);  // the far plane
    EXPECT_DOUBLE_EQ(lens.fov, radians(30.0));
    EXPECT_EQ(
        camera("thinlens", "<float name='aperture_radius' value='0.1'/><float name='focus_distance' value='3'/>").focus_distance,
        3.0);
    const SensorOptions flat = camera("orthographic", "<transform name='to_world'><scale x='10' y='10'/></transform>");
    EXPECT_EQ(flat.kind, SensorOptions::Kind::orthographic);
    EXPECT_EQ(flat.to_world[0][0], 10.0);
    EXPECT_EQ(flat.near_clip, 1e-2);
}

TEST_F(XmlAccepted, MirroredCamera) {
    const SceneParts parts = read_sensor("<float name='fov' value='9'/><transform name='to_world'><scale x='-1'/></transform>");
    EXPECT_EQ(parts.camera.to_world[0][0], -1.0);
}

TEST_F(XmlAccepted, FilmAndSampler) {
    const SceneParts parts = read_sensor(
        "<float name='fov' value='9'/><sampler type='multijitter'><integer name='sample_count' value='64'/>"
        "<integer name='seed' value='3'/></sampler>"
        "<film type='hdrfilm'><integer name='width' value='100'/><integer name='height' value='50'/>"
        "<integer name='crop_offset_x' value='20'/><integer name='crop_offset_y' value='10'/><integer name='crop_width' "
        "value='30'/>"
        "<string name='pixel_format' value='rgba'/><string name='component_format' value='float32'/>"
        "<string name='file_format' value='openexr'/><boolean name='banner' value='FALSE'/><rfilter type='box'/></film>");
    EXPECT_EQ(parts.sampler, SamplerKind::sobol);
    EXPECT_EQ(parts.film.width, 100);
    EXPECT_EQ(parts.film.height, 50);
    EXPECT_EQ(parts.film.crop_x, 20);
    EXPECT_EQ(parts.film.crop_y, 10);
    EXPECT_EQ(parts.film.crop_width, 30);
    EXPECT_EQ(parts.film.crop_height, 40);
    EXPECT_TRUE(std::holds_alternative<BoxFilter>(parts.film.filter));
}

TEST_F(XmlAccepted, Samplers) {
    for (const auto& [type, kind] : std::map<std::string, SamplerKind>{{"independent", SamplerKind::independent},
                                                                       {"ldsampler", SamplerKind::sobol},
                                                                       {"orthogonal", SamplerKind::sobol},
                                                                       {"stratified", SamplerKind::sobol}})
        EXPECT_EQ(read_sensor("<float name='fov' value='9'/><sampler type='" + type + "'/>").sampler, kind) << type;
}

TEST_F(XmlAccepted, MaxDepthCountsOneMoreThanBounces) {
    const auto bounces = [&](const std::string& inside) {
        return read("<integrator type='path'>" + inside + "</integrator>").bounces;
    };
    EXPECT_EQ(bounces("<integer name='max_depth' value='6'/><integer name='rr_depth' value='3'/>"), 5);
    EXPECT_EQ(bounces("<integer name='max_depth' value='1'/><boolean name='hide_emitters' value='false'/>"), 0);
    EXPECT_EQ(bounces("<integer name='max_depth' value='-1'/>"), std::nullopt);
    EXPECT_EQ(bounces(""), std::nullopt);
    for (const char* type : {"ptracer", "volpath", "volpathmis"})
        EXPECT_EQ(read(std::string("<integrator type='") + type + "'><integer name='max_depth' value='3'/></integrator>").bounces,
                  2);
}

TEST_F(XmlAccepted, Integrators) {
    const auto scene = [&](const std::string& integrator) { return read(integrator); };
    const SceneParts direct = scene("<integrator type='direct'><integer name='emitter_samples' value='0'/></integrator>");
    EXPECT_EQ(direct.bounces, 1);
    EXPECT_FALSE(direct.hide_emitters);
    EXPECT_EQ(scene("<integrator type='direct'><integer name='shading_samples' value='4'/></integrator>").bounces, 1);
    EXPECT_TRUE(scene("<integrator type='direct'><boolean name='hide_emitters' value='true'/></integrator>").hide_emitters);
    const SceneParts moment = scene(
        "<integrator type='moment'><integrator type='path' name='first'><integer name='max_depth' value='4'/>"
        "<boolean name='hide_emitters' value='true'/></integrator></integrator>");
    EXPECT_EQ(moment.bounces, 3);
    EXPECT_TRUE(moment.hide_emitters);
    EXPECT_EQ(scene("<integrator type='path'><integer name='samples_per_pass' value='8'/><integer name='block_size' value='32'/>"
                    "<float name='timeout' value='-1'/></integrator>")
                  .bounces,
              std::nullopt);
}

TEST_F(XmlAccepted, Filters) {
    const auto filter = [&](const std::string& inside) {
        return read_sensor("<float name='fov' value='9'/><film type='hdrfilm'>" + inside + "</film>").film.filter;
    };
    EXPECT_EQ(std::get<TentFilter>(filter("<rfilter type='tent'/>")).radius(), 1.0);
    EXPECT_EQ(std::get<TentFilter>(filter("<rfilter type='tent'><float name='radius' value='2.5'/></rfilter>")).radius(), 2.5);
    EXPECT_EQ(std::get<GaussianFilter>(filter("<rfilter type='gaussian'><float name='stddev' value='1'/></rfilter>")).radius(),
              4.0);
    const auto at = [&](const std::string& inside, double x) { return std::get<SignedFilter>(filter(inside))(x); };
    // Mitchell and Netravali's values at 0 and 1: 1 − B/3 and B/6.
    EXPECT_NEAR(at("<rfilter type='mitchell'/>", 0.0), 8.0 / 9.0, 1e-15);
    EXPECT_NEAR(at("<rfilter type='mitchell'/>", -1.0), 1.0 / 18.0, 1e-15);
    EXPECT_NEAR(at("<rfilter type='mitchell'><float name='B' value='1'/><float name='C' value='0'/></rfilter>", 1.0), 1.0 / 6.0,
                1e-15);
    EXPECT_NEAR(at("<rfilter type='catmullrom'/>", 0.0), 1.0, 1e-15);
    EXPECT_NEAR(at("<rfilter type='catmullrom'/>", 1.5), -0.0625, 1e-15);
    // sinc(3/2) sinc(1/2) = −4 / (3 π²).
    EXPECT_NEAR(at("<rfilter type='lanczos'/>", 1.5), -4.0 / (3.0 * std::numbers::pi * std::numbers::pi), 1e-15);
    EXPECT_EQ(std::get<SignedFilter>(filter("<rfilter type='lanczos'/>")).radius(), 3.0);
    EXPECT_EQ(std::get<SignedFilter>(filter("<rfilter type='lanczos'><integer name='lobes' value='5'/></rfilter>")).radius(), 5.0);
    EXPECT_FALSE(read("").film.sample_border);
    EXPECT_TRUE(read_sensor("<float name='fov' value='9'/><film type='hdrfilm'><boolean name='sample_border' value='true'/>"
                            "<string name='file_format' value='exr'/></film>")
                    .film.sample_border);
}

// As in Mitsuba, what <path> names comes first, the last one before the others.
TEST_F(XmlAccepted, OrderOfFolders) {
    const auto sphere = [](int radius) {
        return "<scene version='3.0.0'><shape type='sphere'><float name='radius' value='" + std::to_string(radius) +
               "'/></shape></scene>";
    };
    write("one/a.xml", sphere(1));
    write("two/a.xml", sphere(2));
    write("a.xml", sphere(3));
    const auto radius = [&](const std::string& body) { return std::get<Sphere>(read(body).shapes.at(0)).radius; };
    EXPECT_EQ(radius("<include filename='a.xml'/>"), 3.0);
    EXPECT_EQ(radius("<path value='one'/><include filename='a.xml'/>"), 1.0);
    EXPECT_EQ(radius("<path value='one'/><path value='two'/><include filename='a.xml'/>"), 2.0);
}

TEST_F(XmlAccepted, Substitution) {
    const std::string body =
        "<default name='r' value='2'/><default name='radius' value='$r.5'/><default name='r' value='7'/>"
        "<shape type='sphere'><float name='$kind' value='$radius'/></shape>";
    // The longest name wins ($radius, not $r and "adius"), and the first default stands.
    EXPECT_EQ(std::get<Sphere>(read(body, {{"kind", "radius"}}).shapes.at(0)).radius, 2.5);
    EXPECT_EQ(std::get<Sphere>(read(body, {{"kind", "radius"}, {"r", "3"}}).shapes.at(0)).radius, 3.5);
    EXPECT_EQ(std::get<Sphere>(read(body, {{"kind", "radius"}, {"radius", "9"}}).shapes.at(0)).radius, 9.0);
}

TEST_F(XmlAccepted, EscapedDollarAndLiteralReplacement) {
    write("$r.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    EXPECT_EQ(read("<shape type='obj'><string name='filename' value='\\$r.obj'/></shape>").shapes.size(), 1u);
    EXPECT_EQ(
        read("<default name='f' value='$g'/><shape type='obj'><string name='filename' value='$f'/></shape>", {{"g", "$r.obj"}})
            .shapes.size(),
        1u);
}

TEST_F(XmlAccepted, IncludesAndFolders) {
    const std::string triangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
    write("meshes/main.obj", triangle);
    write("parts/beside.obj", triangle);
    write("far/away/searched.obj", triangle);
    write("parts/inner.xml",
          "<scene version='3.0.0'><default name='size' value='4'/>"
          "<shape type='obj'><string name='filename' value='meshes/main.obj'/></shape>"
          "<shape type='obj'><string name='filename' value='beside.obj'/></shape>"
          "<shape type='obj'><string name='filename' value='searched.obj'/></shape></scene>");
    const SceneParts parts = read(
        "<path value='far/away'/><include filename='parts/inner.xml'/>"
        "<shape type='sphere'><float name='radius' value='$size'/></shape>");
    ASSERT_EQ(parts.shapes.size(), 4u);
    EXPECT_EQ(std::get<Sphere>(parts.shapes[3]).radius, 4.0);
}

TEST_F(XmlAccepted, IncludeOfOneObject) {
    write("grey.xml", "<bsdf version='3.0.0' type='diffuse'><float name='reflectance' value='0.25'/></bsdf>");
    const SceneParts parts = read("<shape type='cube'><include filename='grey.xml'/></shape>");
    EXPECT_EQ(largest_albedo(parts.bsdfs.at(0)), Rgb(0.25));
}

TEST_F(XmlAccepted, IncludeTwiceIsNoCycle) {
    write("one.xml", "<scene version='3.0.0'><shape type='cube'/></scene>");
    EXPECT_EQ(read("<include filename='one.xml'/><include filename='one.xml'/>").shapes.size(), 2u);
}

TEST_F(XmlAccepted, SharedReferences) {
    const SceneParts parts = read(
        "<shape type='cube'><ref id='grey'/></shape><shape type='cube'><ref name='bsdf' id='gray'/></shape>"
        "<bsdf type='diffuse' id='grey'><float name='reflectance' value='0.25'/></bsdf><alias id='grey' as='gray'/>"
        "<bsdf type='diffuse' id='unused'/>");
    EXPECT_EQ(parts.bsdfs.size(), 1u);
    EXPECT_EQ(parts.sides_of_shape.at(0).front, 0);
    EXPECT_EQ(parts.sides_of_shape.at(1).front, 0);
    EXPECT_EQ(parts.sides_of_shape.at(1).back, Materials::absorbing);
}

TEST_F(XmlAccepted, TwoSided) {
    const SceneParts parts = read(
        "<bsdf type='diffuse' id='a'/>"
        "<shape type='cube'><bsdf type='twosided'><ref id='a'/></bsdf></shape>"
        "<shape type='cube'><bsdf type='twosided'><ref id='a'/><bsdf type='diffuse'><float name='reflectance' "
        "value='1'/></bsdf></bsdf></shape>"
        "<shape type='cube'><ref id='a'/></shape>");
    EXPECT_EQ(parts.bsdfs.size(), 2u);
    EXPECT_EQ(parts.sides_of_shape.at(0).front, 0);
    EXPECT_EQ(parts.sides_of_shape.at(0).back, 0);
    EXPECT_EQ(parts.sides_of_shape.at(1).front, 0);
    EXPECT_EQ(parts.sides_of_shape.at(1).back, 1);
    EXPECT_EQ(parts.sides_of_shape.at(2).back, Materials::absorbing);
    EXPECT_EQ(largest_albedo(parts.bsdfs[1]), Rgb(1.0));
}

TEST_F(XmlAccepted, ShapesWithoutBsdf) {
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

TEST_F(XmlAccepted, EmittersByReference) {
    const SceneParts parts = read(
        "<shape type='cube'><ref id='lamp'/></shape>"
        "<emitter type='area' id='lamp'><rgb name='radiance' value='1, 2, 3'/></emitter>"
        "<emitter type='area'><rgb name='radiance' value='9'/></emitter>");
    EXPECT_EQ(parts.lights.of_shape, std::vector<int>{0});
    ASSERT_EQ(parts.lights.area.size(), 1u);
    EXPECT_EQ(parts.lights.area[0].largest, Rgb(1.0, 2.0, 3.0));
}

TEST_F(XmlAccepted, Colours) {
    EXPECT_EQ(reflectance("<rgb name='reflectance' value='0.1, +0.2 3e-1'/>"), Rgb(0.1, 0.2, 0.3));
    EXPECT_EQ(reflectance("<rgb name='reflectance' value='0.5'/>"), Rgb(0.5));
    EXPECT_EQ(reflectance("<rgb name='reflectance' value='2'/>"), Rgb(2.0));
    EXPECT_EQ(reflectance("<spectrum name='reflectance' value=' 0.25 '/>"), Rgb(0.25));
    EXPECT_EQ(reflectance("<integer name='reflectance' value='1'/>"), Rgb(1.0));
    const Rgb hex = reflectance("<rgb name='reflectance' value='#ff8000'/>");
    EXPECT_DOUBLE_EQ(hex.r, 1.0);
    EXPECT_NEAR(hex.g, 0.2158605, 1e-7);
    EXPECT_EQ(hex.b, 0.0);
}

TEST_F(XmlAccepted, Wavelengths) {
    const Rgb white = reflectance("<spectrum name='reflectance' value='360:0.5, 830:0.5'/>");
    for (int i = 0; i < 3; ++i) EXPECT_NEAR(white[i], 0.5, 1e-4);
    const SceneParts parts =
        read("<shape type='cube'><emitter type='area'><spectrum name='radiance' value='360:2, 830:2'/></emitter></shape>");
    const Rgb lamp = parts.lights.area.at(0).largest;
    EXPECT_NEAR(lamp.r, 2.0 * 1.2048, 1e-3);
    EXPECT_NEAR(lamp.g, 2.0 * 0.9483, 1e-3);
    EXPECT_NEAR(lamp.b, 2.0 * 0.9089, 1e-3);
    EXPECT_TRUE(parts.warnings.counts().empty());
}

TEST_F(XmlAccepted, WavelengthsOutsideSrgb) {
    const SceneParts parts = read(
        "<shape type='cube'><bsdf type='diffuse'>"
        "<spectrum name='reflectance' value='500:1 520:1'/></bsdf></shape>");
    const Rgb green = largest_albedo(parts.bsdfs.at(0));
    EXPECT_EQ(green.r, 0.0);  // negative before
    EXPECT_GT(green.g, 0.1);
    EXPECT_EQ(parts.warnings.counts(),
              (std::map<std::string, std::uint64_t>{{"spectrum outside the colours of sRGB, cut to them", 1}}));
}

TEST_F(XmlAccepted, Conductors) {
    const auto reflected = [&](const std::string& inside) {
        const SceneParts parts = read("<shape type='cube'><bsdf type='conductor'>" + inside + "</bsdf></shape>");
        EXPECT_EQ(parts.sides_of_shape.at(0).back, Materials::absorbing);
        EXPECT_EQ(lobe(parts.bsdfs.at(0)).kind, Lobe::Kind::specular);
        return sample(parts.bsdfs.at(0), {}, Vec3(0, 0, 1), Vec2(0.5)).weight;
    };
    const auto at_normal = [](double n, double k) { return ((n - 1) * (n - 1) + k * k) / ((n + 1) * (n + 1) + k * k); };
    EXPECT_EQ(reflected(""), Rgb(1.0));
    EXPECT_EQ(reflected("<string name='material' value='none'/><rgb name='specular_reflectance' value='1, 0.5, 0.25'/>"),
              Rgb(1.0, 0.5, 0.25));
    const Rgb gold = reflected("<rgb name='eta' value='0.143, 0.374, 1.442'/><rgb name='k' value='3.983, 2.385, 1.603'/>");
    EXPECT_NEAR(gold.r, at_normal(0.143, 3.983), 1e-14);
    EXPECT_NEAR(gold.g, at_normal(0.374, 2.385), 1e-14);
    EXPECT_NEAR(gold.b, at_normal(1.442, 1.603), 1e-14);
    EXPECT_NEAR(reflected("<float name='eta' value='2'/><integer name='k' value='3'/>").g, at_normal(2.0, 3.0), 1e-14);
    EXPECT_NEAR(reflected("<float name='eta' value='2'/>").g, at_normal(2.0, 1.0), 1e-14);
    EXPECT_EQ(reflected("<float name='k' value='5'/>"), Rgb(1.0));
    const SceneParts both = read("<shape type='cube'><bsdf type='twosided'><bsdf type='conductor'/></bsdf></shape>");
    EXPECT_EQ(both.sides_of_shape.at(0).front, both.sides_of_shape.at(0).back);
}

TEST_F(XmlAccepted, RoughConductors) {
    const auto material = [&](const std::string& inside) {
        return read("<shape type='cube'><bsdf type='roughconductor'>" + inside + "</bsdf></shape>").bsdfs.at(0);
    };
    EXPECT_TRUE(std::holds_alternative<RoughConductor<Beckmann>>(material("")));
    EXPECT_EQ(lobe(material("")).kind, Lobe::Kind::rough);
    EXPECT_EQ(lobe(material("")).alpha, 0.1);
    EXPECT_EQ(largest_albedo(material("")), Rgb(1.0));
    const Bsdf ggx = material(
        "<string name='distribution' value='ggx'/><float name='alpha_u' value='0.3'/><float name='alpha_v' value='0.3'/>"
        "<boolean name='sample_visible' value='false'/><rgb name='specular_reflectance' value='0.9, 0.8, 0.7'/>"
        "<float name='eta' value='0.2'/><float name='k' value='3'/>");
    ASSERT_TRUE(std::holds_alternative<RoughConductor<Ggx>>(ggx));
    EXPECT_EQ(lobe(ggx).alpha, 0.3);
    EXPECT_EQ(largest_albedo(ggx), Rgb(0.9, 0.8, 0.7));
    // At normal incidence on both sides G = 1 and D = 1/(π α²); Mitsuba's masking is the separable one.
    const Vec3 up(0, 0, 1), slant(0.6, 0, 0.8);
    const double F = (0.64 + 9.0) / (1.44 + 9.0);
    EXPECT_NEAR(eval(ggx, {}, up, up).g, 0.8 * F * inv_pi / 0.09 / 4.0, 1e-13);
    const double G1 = 2.0 / (1.0 + std::sqrt(1.0 + 0.09 * 0.5625));
    const Bsdf perfect = material("<string name='distribution' value='ggx'/><float name='alpha' value='0.3'/>");
    EXPECT_NEAR(eval(perfect, {}, slant, slant).g, G1 * G1 * 0.09 * inv_pi / std::pow(0.36 + 0.09 * 0.64, 2) / (4.0 * 0.64), 1e-13);
}

TEST_F(XmlAccepted, NamedMetals) {
    // As they are often quoted for Mitsuba's RGB modes.
    const auto at_normal = [](double n, double k) { return ((n - 1) * (n - 1) + k * k) / ((n + 1) * (n + 1) + k * k); };
    const Bsdf gold =
        read("<shape type='cube'><bsdf type='conductor'><string name='material' value='Au'/></bsdf></shape>").bsdfs.at(0);
    const Rgb reflected = sample(gold, {}, Vec3(0, 0, 1), Vec2(0.5)).weight;
    EXPECT_NEAR(reflected.r, at_normal(0.143, 3.983), 1e-3);
    EXPECT_NEAR(reflected.g, at_normal(0.375, 2.385), 1e-3);
    EXPECT_NEAR(reflected.b, at_normal(1.442, 1.603), 1e-3);
    // Wavelengths are integrated under D65, so that 2 is 2 in all channels, and 5 is not cut.
    const Bsdf grey = read(
                          "<shape type='cube'><bsdf type='conductor'><spectrum name='eta' value='300:2 900:2'/>"
                          "<spectrum name='k' value='300:5 900:5'/></bsdf></shape>")
                          .bsdfs.at(0);
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(sample(grey, {}, Vec3(0, 0, 1), Vec2(0.5)).weight[c], at_normal(2.0, 5.0), 2e-4);
}

TEST_F(XmlAccepted, BrushedMetals) {
    const Bsdf brushed = read(
                             "<shape type='cube'><bsdf type='roughconductor'><string name='distribution' value='ggx'/>"
                             "<float name='alpha_u' value='0.1'/><float name='alpha_v' value='0.4'/></bsdf></shape>")
                             .bsdfs.at(0);
    EXPECT_TRUE(needs_coordinates(brushed));
    const Vec3 up(0, 0, 1);
    EXPECT_NEAR(eval(brushed, {}, up, up).g, inv_pi / 0.04 / 4.0, 1e-12);  // D = 1/(π αu αv)
}

TEST_F(XmlAccepted, Plastics) {
    const auto material = [&](const std::string& type, const std::string& inside) {
        const SceneParts parts = read("<shape type='cube'><bsdf type='" + type + "'>" + inside + "</bsdf></shape>");
        EXPECT_EQ(parts.sides_of_shape.at(0).back, Materials::absorbing);
        return parts.bsdfs.at(0);
    };
    const Vec3 up(0, 0, 1);
    // Towards the normal, with Egan and Hilgeman's fit inside.
    const auto diffuse = [](double rho, double in_fit, double eta) {
        const double F = std::pow((eta - 1.0) / (eta + 1.0), 2), n = 1.0 / eta;
        const double fit = -1.4399 * n * n + 0.7099 * n + 0.6681 + 0.0636 * eta;
        return rho * n * n / (1.0 - in_fit * fit) * (1.0 - F) * (1.0 - F) * inv_pi;
    };
    EXPECT_NEAR(eval(material("plastic", ""), {}, up, up).g, diffuse(0.5, 1.0, 1.49 / 1.000277), 1e-13);
    const std::string inside =
        "<rgb name='diffuse_reflectance' value='0.2, 0.6, 0.4'/><string name='int_ior' value='Water'/>"
        "<float name='ext_ior' value='1'/><boolean name='nonlinear' value='true'/>";
    EXPECT_NEAR(eval(material("plastic", inside), {}, up, up).g, diffuse(0.6, 0.6, 1.333), 1e-13);
    EXPECT_EQ(sample(material("plastic", inside), {}, up, Vec2(0.0)).pdf, delta_pdf);
    EXPECT_TRUE(std::holds_alternative<RoughPlastic<Beckmann>>(material("roughplastic", "")));
    EXPECT_EQ(lobe(material("roughplastic", "")).alpha, 0.1);
    const Bsdf black = material("roughplastic",
                                "<string name='distribution' value='ggx'/><float name='alpha' value='0.3'/>"
                                "<float name='int_ior' value='1.5'/><float name='ext_ior' value='1'/>"
                                "<rgb name='diffuse_reflectance' value='0'/><float name='specular_reflectance' value='0.5'/>");
    EXPECT_NEAR(eval(black, {}, up, up).g, 0.5 * 0.04 * inv_pi / 0.09 / 4.0, 1e-13);
}

TEST_F(XmlAccepted, Principled) {
    const auto parts = [&](const std::string& type, const std::string& inside) {
        return read("<shape type='cube'><bsdf type='" + type + "'>" + inside + "</bsdf></shape>");
    };
    const Vec3 up(0, 0, 1);
    // `specular` 0.5 is F = 0.04, and roughness 0.5 is α = 0.25.
    const SceneParts plain = parts("principled", "");
    EXPECT_EQ(plain.sides_of_shape.at(0).back, Materials::absorbing);
    EXPECT_NEAR(eval(plain.bsdfs.at(0), {}, up, up).g, 0.5 * inv_pi + 0.04 * inv_pi / 0.0625 / 4.0, 1e-13);
    const SceneParts glass = parts("principled", "<float name='spec_trans' value='1'/><float name='eta' value='1.5'/>");
    EXPECT_EQ(glass.bsdfs.size(), 2u);
    EXPECT_EQ(glass.sides_of_shape.at(0).front, 0);
    EXPECT_EQ(glass.sides_of_shape.at(0).back, 1);
    const SceneParts sheet = parts("principledthin", "<float name='diff_trans' value='2'/>");
    EXPECT_EQ(sheet.sides_of_shape.at(0).front, sheet.sides_of_shape.at(0).back);
    EXPECT_NEAR(eval(sheet.bsdfs.at(0), {}, up, -up).g, 0.5 * inv_pi, 1e-15);
    EXPECT_EQ(eval(sheet.bsdfs.at(0), {}, up, up).g, 0.0);
}

TEST_F(XmlAccepted, Spheres) {
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

TEST_F(XmlAccepted, Cylinders) {
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

}  // namespace neumann
