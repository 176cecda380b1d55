#include "apps/output/pages/touch_page.h"

#include "apps/output/files/packed_bytes.h"
#include "apps/output/files/packed_pictures.h"
#include "apps/output/pages/page.h"
#include "operators/render/methods/method.h"
#include "operators/statistics/reduced_picture.h"

#include <fmt/format.h>

#include <bit>
#include <cmath>
#include <cstring>

namespace neumann {

namespace {

using Json = nlohmann::ordered_json;

static_assert(std::endian::native == std::endian::little,
              "typed arrays of JavaScript are little-endian on all machines that matter");
constexpr double weight_of_one = 8192.0;  // of the camera's rays, as numbers of 16 bits

// Typed arrays of JavaScript, each in an element of its own.
class Arrays {
public:
    template <class T, class Values>
    void add(const std::string& name, const Values& values) {
        std::string bytes;
        for (const auto& value : values) {
            const auto v = static_cast<T>(value);
            bytes.append(reinterpret_cast<const char*>(&v), sizeof v);
        }
        elements_ += fmt::format("<script type=\"text/plain\" id=\"{}\">{}</script>\n", name, packed_bytes(bytes));
    }
    // Channel after channel.
    void add(const std::string& name, const std::vector<Rgb>& colours) {
        std::vector<float> values;
        for (int c = 0; c < 3; ++c)
            for (const Rgb& colour : colours) values.push_back(static_cast<float>(colour[c]));
        add<float>(name, values);
    }
    void add_text(const std::string& name, const std::string& text) {
        elements_ += fmt::format("<script type=\"text/plain\" id=\"{}\">{}</script>\n", name, text);
    }
    const std::string& elements() const { return elements_; }

private:
    std::string elements_;
};

Json as_json(const Rgb& c) { return {c.r, c.g, c.b}; }

void add_scene(const SeparatedScene& scene, Json& data, Arrays& arrays) {
    std::vector<std::uint32_t> materials;
    std::vector<Rgb> reflectances;
    std::vector<double> areas;
    for (const SeparatedScene::Facet& facet : scene.facets) {
        materials.push_back(facet.material);
        reflectances.push_back(facet.reflectance);
        areas.push_back(facet.area);
    }
    arrays.add<std::uint16_t>("seen", scene.seen);
    arrays.add<std::uint16_t>("material", materials);
    arrays.add<float>("area", areas);
    arrays.add("reflectance", reflectances);
    arrays.add<std::uint32_t>("first", scene.camera.first);
    arrays.add<std::uint16_t>("facet", scene.camera.facet);
    std::vector<double> weights = scene.camera.weight;
    for (double& w : weights) w = std::round(w * weight_of_one);
    arrays.add<std::int16_t>("weight", weights);
    data["materials"] = Json::array();
    for (const SeparatedScene::Material& m : scene.materials)
        data["materials"].push_back({{"name", m.name}, {"reflectance", as_json(m.reflectance)}, {"even", m.is_even}});
    data["lamps"] = Json::array();
    for (const SeparatedScene::Lamp& lamp : scene.lamps) {
        const std::size_t j = data["lamps"].size();
        arrays.add(fmt::format("emitted-{}", j), lamp.emitted);
        arrays.add(fmt::format("arriving-{}", j), lamp.arriving);
        if (!lamp.background.empty()) arrays.add(fmt::format("background-{}", j), lamp.background);
        data["lamps"].push_back({{"name", lamp.name}, {"colour", as_json(lamp.colour)}, {"sky", !lamp.background.empty()}});
    }
}

}  // namespace

std::string touch_page(const SeparatedScene& scene, const BounceSeries& rendered, const std::string& name) {
    Json data = {{"name", name},
                 {"width", scene.width},
                 {"height", scene.height},
                 {"factor", scene.factor},
                 {"rays", scene.rays},
                 {"weight_of_one", weight_of_one},
                 {"method", name_of(rendered.method)}};
    Arrays arrays;
    add_scene(scene, data, arrays);
    const auto pictures = static_cast<std::size_t>(rendered.bounces()) + 1;
    PackedSeries packed(scene.width, scene.height, pictures);
    for (std::size_t i = 0; i < pictures; ++i) packed.add_term(i, reduced(rendered.term(i), scene.factor));
    packed.pack();
    data["rendered"] = Json::array();
    for (const PackedPicture& picture : packed.pictures()) {
        arrays.add_text(fmt::format("picture-{}", data["rendered"].size()), picture.bytes);
        data["rendered"].push_back(picture.head);
    }
    const std::string json = fmt::format("<script type=\"application/json\" id=\"data\">{}</script>\n", for_script(data));
    return page("touch.html", {json, arrays.elements()});
}

}  // namespace neumann
