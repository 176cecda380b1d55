// Pixels of a crop are named by the film.
#include "tests/commands/render_output.h"

namespace neumann::crop_test {

class Crop : public RenderTest {};

// The pixel of a picture whose largest channel is largest.
std::pair<int, int> worst_of(const Image& image) {
    const auto of = [](const Rgb& p) { return max_component(p); };
    const auto worst = std::ranges::max_element(image.pixels, {}, of) - image.pixels.begin();
    return {static_cast<int>(worst) % image.width, static_cast<int>(worst) / image.width};
}

TEST_F(Crop, WorstPixels) {
    const std::string whole = plates("width=\"164\" height=\"40\""), film = "<film type=\"hdrfilm\">";
    write("scene.xml",
          std::string(whole).replace(whole.find(film), film.size(), film + R"(<integer name="crop_offset_x" value="60"/>
<integer name="crop_offset_y" value="10"/><integer name="crop_width" value="30"/><integer name="crop_height" value="20"/>)"));
    for (const std::string method : {"matrix", "photon"}) {
        render("scene.xml", "a", {"-n", "2", "--spp", "16", "--method", method, "--quiet", "--files", "pictures,tables"});
        const Image wrong = picture("a", "bounce_002.exr").discretisation;
        const auto [x, y] = worst_of(wrong);
        EXPECT_GT(max_component(wrong.at(x, y)), 0.0) << method;
        EXPECT_EQ(run_json("a").at("bounces").at(2).at("discretisation").at("worst_pixel"), (std::vector{60 + x, 10 + y}))
            << method;
        const std::string table = text_of(path("a/series.csv"));
        EXPECT_TRUE(table.ends_with(fmt::format(",{},{}\n", 60 + x, 10 + y))) << table;
    }
}

}  // namespace neumann::crop_test
