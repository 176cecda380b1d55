// Scenes of Tungsten, and whether they make the same scene as Mitsuba files.
#pragma once

#include "tests/reader/same_scene.h"

#include <nlohmann/json.hpp>

namespace neumann {

using Json = nlohmann::json;

class TungstenTest : public SameSceneTest {
protected:
    // A scene of one primitive; it says as little as it can.
    static Json scene_of(const Json& primitive, const Json& bsdfs = Json::array()) {
        return {{"bsdfs", bsdfs},
                {"primitives", {primitive}},
                {"camera", {{"type", "pinhole"}, {"fov", 40}, {"resolution", 8}, {"transform", Json::object()}}}};
    }
    // A quad of this material.
    static Json scene_with(const Json& bsdf) { return scene_of({{"type", "quad"}, {"bsdf", bsdf}}); }

    SceneParts read_tungsten(const Json& file, const Definitions& definitions = {}) const {
        write("scene.json", file.dump());
        return read_scene_parts(path("scene.json"), definitions);
    }
    std::string tungsten_error(const Json& file) const {
        write("scene.json", file.dump());
        return error_of(path("scene.json"));
    }
    std::string error_of_text(const std::string& text) const {
        write("scene.json", text);
        return error_of(path("scene.json"));
    }
    // What a lenient reader lists.
    std::string replaced(const Json& file) const {
        write("scene.json", file.dump());
        std::string all;
        for (const std::string& what : read_scene_parts(path("scene.json"), {}, {.lenient = true}).replaced)
            all += what.substr(path("").size()) + "\n";
        return all;
    }
    // All but that there is no light, a line each.
    static std::string warnings(const SceneParts& parts) {
        std::string all;
        for (const auto& [text, count] : parts.warnings.counts())
            if (!text.starts_with("the file has no light")) all += text + "\n";
        return all;
    }

    // The camera and the light of scene_of().
    static constexpr const char* rest =
        "<integrator type='path'><integer name='max_depth' value='64'/></integrator><sensor type='perspective'><float name='fov' "
        "value='40'/><film type='hdrfilm'><integer name='width' value='8'/><integer name='height' value='8'/><rfilter "
        "type='tent'/></film></sensor>";
    static constexpr const char* surroundings = "<emitter type='constant'><rgb name='radiance' value='1'/></emitter>";
    using SameSceneTest::expect_same;
    void expect_same(const Json& file, const std::string& elements, const std::string& light = surroundings) const {
        SCOPED_TRACE(file.dump());
        expect_same(read_tungsten(file), read(rest + light + elements));
    }
    // A material, against the same <bsdf>.
    void expect_material(const Json& bsdf, const std::string& same) const {
        expect_same(scene_with(bsdf), "<shape type='rectangle'>" +
                                          to_world("<matrix value='0.5 0 0 0 0 0 1 0 0 0.5 0 0 0 0 0 1'/>") + same + "</shape>");
    }
    static std::string two_sided(const std::string& inner) { return "<bsdf type='twosided'>" + inner + "</bsdf>"; }
};

}  // namespace neumann
