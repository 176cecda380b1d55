// A method in JSON, option by option as operators/methods describes them; read back it is the same.
#pragma once

#include "operators/methods/method.h"

#include <nlohmann/json.hpp>

namespace neumann {

// {"method": "walk", "direct": "mis", …}
nlohmann::ordered_json as_json(const Method& method);
// Of an object that may hold other things as well. Throws InputError, and what JSON throws where there is no method.
Method method_from_json(const nlohmann::ordered_json& json);

}  // namespace neumann
