// Stores the progress of a render from fields in a state file.
#pragma once

#include "apps/output/files/state_file.h"
#include "operators/render/from_fields/field_progress.h"

#include <nlohmann/json.hpp>

#include <string_view>
#include <vector>

namespace neumann {

// The part of the header; appends the numbers that it counts to `numbers`, which refers to them.
nlohmann::ordered_json as_json(const FieldProgress& progress, std::vector<std::string_view>& numbers);
FieldProgress fields_from(const nlohmann::ordered_json& json, StateFile& file);

}  // namespace neumann
