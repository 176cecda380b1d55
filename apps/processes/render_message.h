// The data that a process needs to sample shares of a render, as JSON.
#pragma once

#include "apps/processes/scene_on_disk.h"
#include "operators/render/from_fields/field_pictures.h"
#include "operators/render/from_paths/share.h"
#include "operators/render/methods/recorded_render.h"

#include <glm/glm.hpp>
#include <nlohmann/json.hpp>

#include <cstddef>
#include <optional>
#include <span>

namespace neumann {

struct RenderMessage {
    SceneOnDisk scene;
    int threads = 0;
    RecordedRender render;
    std::optional<glm::dmat3> colors;
};
nlohmann::ordered_json as_json(const RenderMessage& message);
RenderMessage render_message_from(const nlohmann::ordered_json& json);

// The settings as bytes in memory, for a process of the same program.
std::span<const std::byte> as_bytes(const FieldSettings& settings);
FieldSettings field_settings_from(std::span<const std::byte> bytes);

nlohmann::ordered_json as_json(const Share& share);
Share share_from(const nlohmann::ordered_json& json);

}  // namespace neumann
