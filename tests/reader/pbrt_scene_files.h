// pbrt files, and whether they make the same scene as Mitsuba files.
#pragma once

#include "tests/reader/same_scene.h"

#include <string>

namespace neumann {

class PbrtTest : public SameSceneTest {
protected:
    static constexpr const char* camera =
        "Camera \"perspective\" \"float fov\" 40 Film \"rgb\" \"integer xresolution\" 8 \"integer yresolution\" 8\n";

    // `world` begins on line 3.
    static std::string pbrt(const std::string& world) { return camera + std::string("WorldBegin\n") + world; }

    SceneParts read_pbrt_file(const std::string& text, const Definitions& definitions = {}) const {
        write("scene.pbrt", text);
        return read_scene_parts(path("scene.pbrt"), definitions);
    }
    SceneParts read_pbrt(const std::string& world) const { return read_pbrt_file(pbrt(world)); }
    std::string pbrt_file_error(const std::string& text) const {
        write("scene.pbrt", text);
        return error_of(path("scene.pbrt"));
    }
    std::string pbrt_error(const std::string& world) const { return pbrt_file_error(pbrt(world)); }
    using SameSceneTest::expect_same;
    // The world of a pbrt file against the elements of a Mitsuba file.
    void expect_same(const std::string& world, const std::string& elements) const {
        SCOPED_TRACE(world);
        expect_same(read_pbrt(world), read(mitsuba_sensor() + elements));
    }
    // That of `camera`, with what pbrt has where nothing is said.
    static std::string mitsuba_sensor() {
        return "<integrator type='path'><integer name='max_depth' value='6'/></integrator>"
               "<sensor type='perspective'><float name='fov' value='40'/><transform name='to_world'><scale x='-1'/></transform>"
               "<film type='hdrfilm'><integer name='width' value='8'/><integer name='height' value='8'/></film></sensor>";
    }
};

}  // namespace neumann
