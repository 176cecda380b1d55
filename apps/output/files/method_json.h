// A method in JSON, option by option as in operators/render/methods/method_options.h. Reading it back gives the same method.
#pragma once

#include "operators/render/methods/recorded_render.h"

#include <nlohmann/json.hpp>

namespace neumann {

// {"method": "walk", "direct": "mis", …}
nlohmann::ordered_json as_json(const Method& method);
// The object may have other members as well. Throws InputError, or the JSON library's exception if there is no method.
Method method_from_json(const nlohmann::ordered_json& json);

// {"options": {"method": …}, "seed": 0, …}: part of a state on disk, and of a message to another process. As above.
nlohmann::ordered_json as_json(const RecordedRender& render);
RecordedRender recorded_render_from_json(const nlohmann::ordered_json& json);

}  // namespace neumann
