// What is wrong in scenes of Tungsten that are no text or made by a program; the other errors are in errors/tungsten.
#include "tests/reader/tungsten_scene_files.h"

namespace neumann::tungsten_errors_test {

class TungstenErrors : public TungstenTest {};

TEST_F(TungstenErrors, Files) {
    EXPECT_EQ(error_of_text("{\r\n  \"camera\": {\"fov\": 3,}}"),
              "scene.json:2:23: broken JSON: syntax error while parsing object key - unexpected '}'; expected string literal");
    write("marked.json", "\xEF\xBB\xBF" + scene_with({{"type", "null"}}).dump());
    EXPECT_EQ(read_scene_parts(path("marked.json")).shapes.size(), 1u);
}

TEST_F(TungstenErrors, DeepNesting) {
    Json deep = {{"type", "null"}};
    for (int i = 0; i < 200; ++i) deep = {{"type", "transparency"}, {"base", deep}};
    EXPECT_TRUE(tungsten_error(scene_with(deep)).ends_with("/base: bsdfs are nested more than 100 deep"));
}

}  // namespace neumann::tungsten_errors_test
