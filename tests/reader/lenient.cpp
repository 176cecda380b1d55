// What a lenient reader makes of things that it does not know: each is named with its place, and what is wrong stays an error.
#include "core/material/diffuse.h"
#include "tests/reader/xml_scene_files.h"

namespace neumann::lenient_test {

using Texts = std::vector<std::string>;

class Lenient : public XmlTest {
protected:
    SceneParts read_leniently(const std::string& body, const Definitions& definitions = {}) const {
        write("scene.xml", scene(body));
        return read_scene_parts(path("scene.xml"), definitions, {.lenient = true});
    }
    // Without the folder.
    Texts replaced(const std::string& name) const {
        Texts texts = read_scene_parts(path(name), {}, {.lenient = true}).replaced;
        for (std::string& text : texts)
            if (text.starts_with(path(""))) text.erase(0, path("").size());
        return texts;
    }
    Texts replaced_of(const std::string& body) const {
        write("scene.xml", scene(body));
        return replaced("scene.xml");
    }
    // Whether the strict reader's only errors are about what is not known.
    bool is_all_unknown(const std::string& body) const {
        write("scene.xml", scene(body));
        try {
            read_scene_parts(path("scene.xml"));
        } catch (const UnknownError&) {
            return true;
        } catch (const InputError&) {
        }
        return false;
    }
    std::string error_of_lenient(const std::string& body) const {
        try {
            read_leniently(body);
        } catch (const InputError& e) {
            return std::string(e.what()).substr(path("").size());
        }
        return "no error";
    }
};

// Of the front of a shape that is diffuse.
Rgb reflectance_of(const SceneParts& parts, std::size_t shape) {
    return std::get<Diffuse>(parts.bsdfs.at(static_cast<std::size_t>(parts.sides_of_shape.at(shape).front))).largest_albedo();
}

// A film that is not known may have a filter for each of its pictures.
TEST_F(Lenient, FiltersOfUnknownFilms) {
    const std::string film = "<film type='specfilm'><rfilter type='box'/><rfilter type='tent'/></film>";
    write("scene.xml",
          "<scene version='3.0.0'><sensor type='perspective'><float name='fov' value='40'/>\n" + film + "</sensor></scene>");
    EXPECT_EQ(replaced("scene.xml"), (Texts{"scene.xml:2:7: film type 'specfilm' is not supported; taken as 'hdrfilm'",
                                            "scene.xml:2:44: another <rfilter> in film 'specfilm'; ignored"}));
    EXPECT_TRUE(std::holds_alternative<BoxFilter>(read_scene_parts(path("scene.xml"), {}, {.lenient = true}).film.filter));
}

// As it stands when the shutter opens: what moves it until it closes is left out, in its own part of the file alone.
TEST_F(Lenient, WhatMovesInPbrt) {
    write("scene.pbrt",
          "Camera \"perspective\" Film \"rgb\" \"integer xresolution\" 8 \"integer yresolution\" 8\nWorldBegin\n"
          "AttributeBegin\nActiveTransform StartTime\nTranslate -1 0 0\nActiveTransform EndTime\nTranslate 5 0 0\n"
          "ActiveTransform All\nTranslate 0 2 0\nShape \"sphere\"\nActiveTransform EndTime\nAttributeEnd\n"
          "Translate 0 0 7\nShape \"sphere\"\n");
    const SceneParts parts = read_scene_parts(path("scene.pbrt"), {}, {.lenient = true});
    EXPECT_EQ(std::get<Sphere>(parts.shapes.at(0)).center, Vec3(-1, 2, 0));
    EXPECT_EQ(std::get<Sphere>(parts.shapes.at(1)).center, Vec3(0, 0, 7));
    EXPECT_EQ(
        replaced("scene.pbrt").front(),
        "scene.pbrt:4:1: ActiveTransform StartTime: motion is not supported; what moves stands where it is when the shutter opens");
}

TEST_F(Lenient, MaterialsBecomeGreyAndDiffuse) {
    const std::string body =
        "<bsdf type='measured' id='car'><string name='filename' value='paint.bsdf'/></bsdf>\n"
        "<shape type='sphere'><ref id='car'/></shape>\n"
        "<shape type='cube'><bsdf type='twosided'><bsdf type='cloth'/></bsdf></shape>\n"
        "<shape type='disk'><bsdf type='diffuse'><rgb name='reflectance' value='0.1'/></bsdf></shape>";
    EXPECT_TRUE(is_all_unknown(body));
    EXPECT_EQ(replaced_of(body),
              (Texts{"scene.xml:2:7: bsdf type 'measured' is not supported; taken as 'diffuse' of reflectance 0.5",
                     "scene.xml:4:48: bsdf type 'cloth' is not supported; taken as 'diffuse' of reflectance 0.5"}));
    const SceneParts parts = read_leniently(body);
    ASSERT_EQ(parts.shapes.size(), 3u);
    EXPECT_EQ(reflectance_of(parts, 0), Rgb(0.5));
    EXPECT_EQ(reflectance_of(parts, 1), Rgb(0.5));
    EXPECT_EQ(parts.sides_of_shape[1].back, parts.sides_of_shape[1].front);
    EXPECT_EQ(reflectance_of(parts, 2), Rgb(0.1));
}

// As if the parameter were missing.
TEST_F(Lenient, WordsAreIgnored) {
    const std::string body =
        "<shape type='sphere'><bsdf type='conductor'>\n<string name='material' value='unobtainium'/></bsdf></shape>\n"
        "<shape type='cube'><bsdf type='roughconductor'>\n<string name='distribution' value='gaussian'/></bsdf></shape>";
    EXPECT_TRUE(is_all_unknown(body));
    EXPECT_EQ(replaced_of(body), (Texts{"scene.xml:3:25: material 'unobtainium' of bsdf 'conductor' is unknown; ignored",
                                        "scene.xml:5:29: distribution is 'gaussian'; ignored"}));
    EXPECT_EQ(read_leniently(body).shapes.size(), 2u);
}

TEST_F(Lenient, LightsAreLeftOut) {
    const std::string body =
        "<emitter type='avg_sunsky'/>\n<emitter type='laser'><float name='power' value='1'/></emitter>\n"
        "<shape type='disk'><emitter type='lantern'/></shape>\n<emitter type='constant'/>";
    EXPECT_TRUE(is_all_unknown(body));
    EXPECT_EQ(replaced_of(body), (Texts{"scene.xml:2:10: emitter type 'avg_sunsky' is not supported; left out",
                                        "scene.xml:3:10: emitter type 'laser' is not supported; left out",
                                        "scene.xml:4:29: emitter type 'lantern' is not supported; left out"}));
    const SceneParts parts = read_leniently(body);
    EXPECT_TRUE(parts.lights.area.empty());
    EXPECT_EQ(parts.lights.of_shape, (std::vector<int>{Emitters::none}));
    EXPECT_TRUE(parts.lights.delta.empty());
    EXPECT_TRUE(parts.lights.environment.has_value());  // that which is known
}

TEST_F(Lenient, ShapesAreLeftOut) {
    const std::string body =
        "<shape type='sdfgrid'><string name='filename' value='no such file'/></shape>\n<shape type='sphere'/>\n"
        "<shape type='shapegroup' id='g'><shape type='hair'/><shape type='cube'/></shape>\n<shape type='instance'><ref "
        "id='g'/></shape>";
    EXPECT_TRUE(is_all_unknown(body));
    EXPECT_EQ(replaced_of(body), (Texts{"scene.xml:2:8: shape type 'sdfgrid' is not supported; left out",
                                        "scene.xml:4:40: shape type 'hair' is not supported; left out"}));
    EXPECT_EQ(read_leniently(body).shapes.size(), 2u);
}

TEST_F(Lenient, TexturesAndSpectraBecomeGreyAndBlackInLights) {
    const std::string body =
        "<shape type='disk'><bsdf type='diffuse'>\n<texture type='noise' name='reflectance'/></bsdf></shape>\n"
        "<shape type='disk'><emitter type='area'>\n<texture type='noise' name='radiance'/></emitter></shape>\n"
        "<shape type='disk'><bsdf type='diffuse'>\n<spectrum type='laser' name='reflectance'/></bsdf></shape>\n"
        "<shape type='disk'><emitter type='area'>\n<spectrum type='laser' name='radiance'/></emitter></shape>\n";
    EXPECT_TRUE(is_all_unknown(body));
    EXPECT_EQ(replaced_of(body), (Texts{"scene.xml:3:10: texture type 'noise' is not supported; taken as 0.5",
                                        "scene.xml:5:10: texture type 'noise' is not supported; taken as black",
                                        "scene.xml:7:11: spectrum type 'laser' is not supported; taken as '0.5'",
                                        "scene.xml:9:11: spectrum type 'laser' is not supported; taken as '0'"}));
    const SceneParts parts = read_leniently(body);
    ASSERT_EQ(parts.shapes.size(), 4u);
    EXPECT_EQ(reflectance_of(parts, 0), Rgb(0.5));
    EXPECT_EQ(reflectance_of(parts, 2), Rgb(0.5));
    ASSERT_EQ(parts.lights.area.size(), 2u);
    for (const AreaLight& light : parts.lights.area) EXPECT_EQ(light.largest, Rgb(0.0));
}

TEST_F(Lenient, ParametersAreIgnored) {
    const std::string body =
        "<shape type='sphere'>\n<float name='glow' value='1'/>\n<float name='radius' value='2'/>\n<texture type='checkerboard' "
        "name='to_world'/>\n<film type='hdrfilm'/>\n<bsdf type='plastic'>\n<float name='int_iro' value='2'/></bsdf></shape>";
    EXPECT_TRUE(is_all_unknown(body));
    EXPECT_EQ(replaced_of(body),
              (Texts{"scene.xml:3:8: unknown parameter 'glow' of shape 'sphere'; ignored",
                     "scene.xml:5:30: parameter 'to_world' of shape 'sphere' is a texture, which is not supported there; ignored",
                     "scene.xml:6:1: unexpected <film> in shape 'sphere'; ignored",
                     "scene.xml:8:8: unknown parameter 'int_iro' of bsdf 'plastic'; ignored"}));
    EXPECT_EQ(std::get<Sphere>(read_leniently(body).shapes.at(0)).radius, 2.0);
}

// What refers to a medium is named, too; -D of what only a medium uses is no error.
TEST_F(Lenient, MediaAreLeftOut) {
    const std::string body =
        "<medium type='homogeneous' id='fog'>\n<float name='scale' value='$density'/>\n<volume type='gridvolume' "
        "id='smoke'/></medium>\n<alias id='fog' as='mist'/>\n<shape type='cube'>\n<ref name='interior' id='fog'/>\n<ref "
        "name='exterior' id='mist'/>\n<subsurface type='dipole'/><ref id='smoke'/></shape>";
    EXPECT_EQ(replaced_of(body), (Texts{"scene.xml:2:1: <medium> is not supported; left out",
                                        "scene.xml:5:8: alias of 'fog', which is left out; left out",
                                        "scene.xml:7:22: reference to 'fog' in shape 'cube', which is left out; ignored",
                                        "scene.xml:8:22: reference to 'mist' in shape 'cube', which is left out; ignored",
                                        "scene.xml:9:1: <subsurface> is not supported; left out",
                                        "scene.xml:9:33: reference to 'smoke' in shape 'cube', which is left out; ignored"}));
    EXPECT_EQ(read_leniently(body, {{"density", "2"}}).shapes.size(), 1u);
}

TEST_F(Lenient, WhatRendersIsTakenAsTheUsual) {
    write("scene.xml",
          "<scene version='3.0.0'><integrator type='bdpt'>\n<integer name='max_depth' value='4'/>\n<float name='x' "
          "value='1'/></integrator>\n<sensor type='fisheye'>\n<float name='fov' value='50'/><film type='specfilm'>\n<integer "
          "name='width' value='12'/><rfilter type='sharp'/></film>\n<sampler type='blue'/></sensor></scene>");
    EXPECT_EQ(replaced("scene.xml"), (Texts{"scene.xml:1:36: integrator type 'bdpt' is not supported; taken as 'path'",
                                            "scene.xml:3:8: unknown parameter 'x' of integrator 'bdpt'; ignored",
                                            "scene.xml:4:9: sensor type 'fisheye' is not supported; taken as 'perspective'",
                                            "scene.xml:5:37: film type 'specfilm' is not supported; taken as 'hdrfilm'",
                                            "scene.xml:6:44: rfilter type 'sharp' is not supported; taken as 'gaussian'",
                                            "scene.xml:7:10: sampler type 'blue' is not supported; taken as 'independent'"}));
    const SceneParts parts = read_scene_parts(path("scene.xml"), {}, {.lenient = true});
    EXPECT_EQ(parts.bounces, 3);
    EXPECT_EQ(parts.film.width, 12);
    EXPECT_NEAR(parts.camera.fov, 50.0 * 3.14159265358979 / 180.0, 1e-12);
}

TEST_F(Lenient, WhatIsWrongStaysAnError) {
    EXPECT_EQ(error_of_lenient("<bsdf type='cloth'/>\n<shape type='sphere'><float name='radius' value='-1'/></shape>"),
              "scene.xml:3:43: radius is -1, expected more than 0");
    EXPECT_EQ(error_of_lenient("<bsdf type='cloth'>"), "scene.xml:4:3: broken XML: Start-end tags mismatch");
    EXPECT_EQ(error_of_lenient("<shape type='ply'><string name='filename' value='no.ply'/></shape>"),
              "scene.xml:2:43: there is no file 'no.ply'; looked in: " + path("").substr(0, path("").size() - 1));
    EXPECT_EQ(error_of_lenient("<bsdf kind='diffuse'/>"),
              "scene.xml:2:7: unknown attribute 'kind' of <bsdf>; allowed: type, id, name");
    EXPECT_EQ(error_of_lenient("<float name='x' value='1'/>").substr(0, 48), "scene.xml:2:1: <float> is not supported in <scen");
    EXPECT_FALSE(is_all_unknown("<bsdf type='cloth'/>\n<shape type='sphere'><float name='radius' value='-1'/></shape>"));
    EXPECT_FALSE(is_all_unknown("<float name='x' value='1'/>"));
}

TEST_F(Lenient, WhatIsKnownIsReadTheSame) {
    const std::string body = "<shape type='sphere'><bsdf type='plastic'/></shape><emitter type='constant'/>";
    const SceneParts strict = read(body), lenient = read_leniently(body);
    EXPECT_TRUE(lenient.replaced.empty());
    EXPECT_EQ(lenient.hash, strict.hash);
    EXPECT_EQ(lenient.warnings.counts(), strict.warnings.counts());
}

TEST_F(Lenient, PlacesAreInTheirOrderAmongWarningsToo) {
    std::string body;
    for (int i = 2; i <= 12; ++i) body += "<emitter type='laser'/>\n";
    const SceneParts parts = read_leniently(body);
    ASSERT_EQ(parts.replaced.size(), 11u);
    EXPECT_TRUE(parts.replaced[7].starts_with(path("scene.xml:9:"))) << parts.replaced[7];
    EXPECT_TRUE(parts.replaced[8].starts_with(path("scene.xml:10:"))) << parts.replaced[8];
    Texts warned;
    for (const auto& [text, count] : parts.warnings.counts()) warned.push_back(text);
    EXPECT_EQ(warned, parts.replaced);
}

TEST_F(Lenient, Pbrt) {
    write("scene.pbrt",
          "Film \"spectral\"\nCamera \"realistic\" \"string lensfile\" \"a.dat\"\nSampler \"blue\"\nIntegrator \"ambient\"\n"
          "PixelFilter \"sharp\"\nMakeNamedMedium \"fog\" \"string type\" \"homogeneous\"\nWorldBegin\nMediumInterface \"\" "
          "\"mist\"\n"
          "Smoke \"dense\" 1 Fog 2\nLightSource \"laser\" \"float power\" 1\nAreaLightSource \"glow\"\nMaterial \"hair\"\n"
          "Shape \"sphere\" \"float round\" 0\nShape \"curve\"\nTexture \"t\" \"spectrum\" \"wrinkled\"\n"
          "Material \"diffuse\" \"texture reflectance\" \"t\" \"float gloss\" 1\nShape \"sphere\"\n");
    EXPECT_EQ(replaced("scene.pbrt"),
              (Texts{"scene.pbrt:1:1: film type 'spectral' is not supported; taken as 'rgb'",
                     "scene.pbrt:2:1: camera type 'realistic' is not supported; taken as 'perspective'",
                     "scene.pbrt:2:20: unknown parameter 'lensfile' of camera 'realistic'; ignored",
                     "scene.pbrt:3:1: sampler type 'blue' is not supported; taken as 'zsobol'",
                     "scene.pbrt:4:1: integrator type 'ambient' is not supported; taken as 'path'",
                     "scene.pbrt:5:1: pixel filter type 'sharp' is not supported; taken as 'gaussian'",
                     "scene.pbrt:6:1: medium 'fog': media are not supported; left out",
                     "scene.pbrt:8:1: medium 'mist': media are not supported; ignored",
                     "scene.pbrt:9:1: unknown directive 'Smoke'; left out", "scene.pbrt:9:17: unknown directive 'Fog'; left out",
                     "scene.pbrt:10:1: light type 'laser' is not supported; left out",
                     "scene.pbrt:11:1: area light type 'glow' is not supported; left out",
                     "scene.pbrt:12:1: material type 'hair' is not supported; taken as 'diffuse' of reflectance 0.5",
                     "scene.pbrt:13:16: unknown parameter 'round' of shape 'sphere'; ignored",
                     "scene.pbrt:14:1: shape type 'curve' is not supported; left out",
                     "scene.pbrt:15:1: texture type 'wrinkled' is not supported; taken as 0.5",
                     "scene.pbrt:16:46: unknown parameter 'gloss' of material 'diffuse'; ignored"}));
    const SceneParts parts = read_scene_parts(path("scene.pbrt"), {}, {.lenient = true});
    ASSERT_EQ(parts.shapes.size(), 2u);
    for (std::size_t shape : {0u, 1u}) EXPECT_EQ(reflectance_of(parts, shape), Rgb(0.5));
    EXPECT_EQ(parts.lights.of_shape, (std::vector<int>{Emitters::none, Emitters::none}));
}

TEST_F(Lenient, Gltf) {
    write("scene.gltf", R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0, 1]}],
 "extensionsRequired": ["VENDOR_magic"], "extensionsUsed": ["VENDOR_magic", "KHR_lights_punctual"],
 "nodes": [{"mesh": 0}, {"extensions": {"KHR_lights_punctual": {"light": 0}}}],
 "extensions": {"KHR_lights_punctual": {"lights": [{"type": "laser"}]}},
 "materials": [{"extensions": {"KHR_materials_pbrSpecularGlossiness": {"glossinessFactor": 0.5}}, "alphaMod": "MASK"}],
 "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "material": 0}]}],
 "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3", "min": [0, 0, 0], "max": [1, 1, 0]}],
 "bufferViews": [{"buffer": 0, "byteLength": 36}],
 "buffers": [{"byteLength": 36, "uri": "data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"}]})");
    EXPECT_EQ(
        replaced("scene.gltf"),
        (Texts{"scene.gltf#/extensionsRequired/0: the file requires the extension VENDOR_magic, which is not supported; left out",
               "scene.gltf#/materials/0/alphaMod: unknown property 'alphaMod'; left out",
               "scene.gltf#/materials/0/extensions/KHR_materials_pbrSpecularGlossiness: KHR_materials_pbrSpecularGlossiness is "
               "not supported; the material is taken as diffuse, of reflectance 0.5",
               // where node 1 has it
               "scene.gltf#/extensions/KHR_lights_punctual/lights/0/type: type is 'laser'; the light is left out"}));
    const SceneParts parts = read_scene_parts(path("scene.gltf"), {}, {.lenient = true});
    ASSERT_EQ(parts.shapes.size(), 1u);
    EXPECT_EQ(reflectance_of(parts, 0), Rgb(0.5));
    EXPECT_TRUE(parts.lights.delta.empty());
}

TEST_F(Lenient, Collada) {
    write("scene.dae", R"(<COLLADA version="1.4.1"><gadgets/>
<library_lights><light id="l"><technique_common>
<neon/></technique_common></light></library_lights>
<library_effects><effect id="e"><profile_COMMON><technique sid="t">
<toon/></technique></profile_COMMON></effect></library_effects>
<library_materials><material id="m"><instance_effect url="#e"/></material></library_materials>
<library_geometries><geometry id="g"><mesh><source id="p"><float_array id="f" count="9">0 0 0 1 0 0 0 1 0</float_array>
<technique_common><accessor source="#f" count="3" stride="3"><param name="X" type="float"/><param name="Y" type="float"/><param
name="Z" type="float"/></accessor></technique_common></source><vertices id="v"><input semantic="POSITION" source="#p"/></vertices>
<triangles count="1" material="s"><input semantic="VERTEX" source="#v" offset="0"/><p>0 1 2</p></triangles></mesh></geometry>
<geometry id="h">
<spline/></geometry></library_geometries>
<library_visual_scenes><visual_scene id="s"><node><instance_light url="#l"/><instance_geometry url="#g"><bind_material>
<technique_common><instance_material symbol="s" target="#m"/></technique_common></bind_material></instance_geometry>
<instance_geometry url="#h"/>
<instance_controller url="#c"/></node></visual_scene></library_visual_scenes>
<scene><instance_visual_scene url="#s"/></scene></COLLADA>)");
    EXPECT_EQ(replaced("scene.dae"),
              (Texts{"scene.dae:1:26: unknown element <gadgets> in <COLLADA>; left out",
                     "scene.dae:3:1: unknown element <neon> in <technique_common>; left out",
                     "scene.dae:4:49: <technique> has no shader; the material is taken as diffuse, of reflectance 0.5",
                     "scene.dae:11:1: <geometry> has no <mesh> inside; left out",
                     "scene.dae:16:1: <instance_controller> is not supported; left out"}));
    const SceneParts parts = read_scene_parts(path("scene.dae"), {}, {.lenient = true});
    ASSERT_EQ(parts.shapes.size(), 1u);
    EXPECT_EQ(reflectance_of(parts, 0), Rgb(0.5));
}

}  // namespace neumann::lenient_test
