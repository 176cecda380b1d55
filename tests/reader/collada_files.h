// COLLADA files that differ in a few places from a small one, and what the reader makes of them.
#pragma once

#include "tests/reader/xml_scene_files.h"

namespace neumann {

class ColladaTest : public XmlTest {
public:
    using Changes = std::vector<std::pair<std::string, std::string>>;

protected:
    // A square of a red material, a light and a camera.
    static std::string small() {
        return R"(<?xml version="1.0" encoding="utf-8"?>
<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
<asset><up_axis>Z_UP</up_axis></asset>
<library_cameras><camera id="cam"><optics><technique_common>
<perspective><xfov>60</xfov><aspect_ratio>2</aspect_ratio><znear>0.1</znear><zfar>90</zfar></perspective>
</technique_common></optics></camera></library_cameras>
<library_lights><light id="lamp"><technique_common>
<point><color>1 2 3</color><constant_attenuation>0</constant_attenuation><quadratic_attenuation>0.5</quadratic_attenuation></point>
</technique_common></light></library_lights>
<library_effects><effect id="paint-effect"><profile_COMMON><technique sid="common">
<lambert><diffuse><color>0.6 0.2 0.1 1</color></diffuse></lambert>
</technique></profile_COMMON></effect></library_effects>
<library_materials><material id="red"><instance_effect url="#paint-effect"/></material></library_materials>
<library_geometries><geometry id="square"><mesh>
<source id="positions"><float_array id="numbers" count="12">-1 -1 0 1 -1 0 1 1 0 -1 1 0</float_array>
<technique_common><accessor source="#numbers" count="4" stride="3"><param name="X"/><param name="Y"/><param name="Z"/></accessor>
</technique_common></source>
<vertices id="corners"><input semantic="POSITION" source="#positions"/></vertices>
<polylist material="paint" count="1"><input semantic="VERTEX" source="#corners" offset="0"/>
<vcount>4</vcount><p>0 1 2 3</p></polylist>
</mesh></geometry></library_geometries>
<library_visual_scenes><visual_scene id="main">
<node id="eye"><translate>0 0 5</translate><instance_camera url="#cam"/></node>
<node id="bulb"><translate>0 0 2</translate><instance_light url="#lamp"/></node>
<node id="floor"><translate>1 2 3</translate><scale>2 2 2</scale>
<instance_geometry url="#square"><bind_material><technique_common>
<instance_material symbol="paint" target="#red"/>
</technique_common></bind_material></instance_geometry></node>
</visual_scene></library_visual_scenes>
<scene><instance_visual_scene url="#main"/></scene>
</COLLADA>
)";
    }

    static std::string changed(const Changes& changes) {
        std::string text = small();
        for (const auto& [before, after] : changes) {
            const std::size_t at = text.find(before);
            EXPECT_NE(at, std::string::npos) << before;
            if (at != std::string::npos) text.replace(at, before.size(), after);
        }
        return text;
    }

    SceneParts read_dae(const std::string& text, const Definitions& definitions = {}) const {
        write("scene.dae", text);
        return read_scene_parts(path("scene.dae"), definitions);
    }
    SceneParts read_changed(const Changes& changes) const { return read_dae(changed(changes)); }
    std::string dae_error(const std::string& text) const {
        write("scene.dae", text);
        return error_of(path("scene.dae"));
    }
    std::string error_with(const Changes& changes) const { return dae_error(changed(changes)); }

    static const TriangleMesh& mesh(const SceneParts& parts, std::size_t i = 0) {
        return std::get<TriangleMesh>(parts.shapes.at(i));
    }
    // The corners of its triangles, in their order.
    static std::vector<Vec3> corners(const TriangleMesh& m) {
        std::vector<Vec3> points;
        for (const auto& t : m.triangles)
            for (const std::uint32_t i : t) points.push_back(m.vertices[i]);
        return points;
    }
    static std::vector<std::string> warnings(const SceneParts& parts) {
        std::vector<std::string> texts;
        for (const auto& [text, count] : parts.warnings.counts()) texts.push_back(text);
        return texts;
    }
    static const Bsdf& front(const SceneParts& parts, std::size_t shape = 0) {
        return parts.bsdfs.at(static_cast<std::size_t>(parts.sides_of_shape.at(shape).front));
    }
};

}  // namespace neumann
