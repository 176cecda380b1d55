#include "apps/output/files/method_json.h"

#include "operators/render/methods/method_options.h"

namespace neumann {

nlohmann::ordered_json as_json(const Method& method) {
    nlohmann::ordered_json json = {{"method", name_of(method)}};
    for (const MethodOption& o : method_options()) {
        const std::string text = o.text(method);
        if (text.empty()) continue;
        const bool is_json = o.kind == MethodOption::Kind::number || o.kind == MethodOption::Kind::flag;
        json[o.name] = is_json ? nlohmann::ordered_json::parse(text) : nlohmann::ordered_json(text);
    }
    return json;
}

Method method_from_json(const nlohmann::ordered_json& json) {
    MethodText text{json.at("method").get<std::string>()};
    for (const MethodOption& o : method_options()) {
        if (!json.contains(o.name)) continue;
        const auto& value = json.at(o.name);
        text.options.emplace_back(o.name, value.is_string() ? value.get<std::string>() : value.dump());
    }
    return make_method(text);
}

nlohmann::ordered_json as_json(const RecordedRender& render) {
    return {{"options", as_json(render.method)},
            {"seed", render.seed},
            {"bounces", render.bounces},
            {"rest_probability", render.rest_probability},
            {"replicate_size", render.replicate_size}};
}

RecordedRender recorded_render_from_json(const nlohmann::ordered_json& json) {
    return {method_from_json(json.at("options")), json.at("seed"), json.at("bounces"), json.at("rest_probability"),
            json.at("replicate_size")};
}

}  // namespace neumann
