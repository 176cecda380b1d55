#include "apps/processes/render_message.h"

#include "apps/output/files/method_json.h"
#include "core/base/error.h"

#include <cstring>
#include <type_traits>

namespace neumann {

using Json = nlohmann::ordered_json;

Json as_json(const RenderMessage& message) {
    Json json = {{"scene", as_json(message.scene)}, {"threads", message.threads}, {"render", as_json(message.render)}};
    if (const auto& m = message.colors)
        for (int column = 0; column < 3; ++column)
            for (int row = 0; row < 3; ++row) json["colors"].push_back((*m)[column][row]);
    return json;
}

RenderMessage render_message_from(const Json& json) {
    RenderMessage message{scene_from(json.at("scene")), json.at("threads"), recorded_render_from_json(json.at("render")), {}};
    if (json.contains("colors")) {
        message.colors.emplace();
        for (int column = 0; column < 3; ++column)
            for (int row = 0; row < 3; ++row)
                (*message.colors)[column][row] = json.at("colors").at(static_cast<std::size_t>(3 * column + row));
    }
    return message;
}

std::span<const std::byte> as_bytes(const FieldSettings& settings) {
    static_assert(std::is_trivially_copyable_v<FieldSettings>);
    return std::as_bytes(std::span(&settings, 1));
}

FieldSettings field_settings_from(std::span<const std::byte> bytes) {
    FieldSettings settings;
    if (bytes.size() != sizeof settings) throw RunError("another version of this program has sent settings");
    std::memcpy(&settings, bytes.data(), sizeof settings);
    return settings;
}

Json as_json(const Share& share) { return {share.first, share.count, share.begin, share.end}; }
Share share_from(const Json& json) { return {json.at(0), json.at(1), json.at(2), json.at(3)}; }

}  // namespace neumann
