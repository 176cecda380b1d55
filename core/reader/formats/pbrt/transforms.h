// Reads directives that change the current transformation matrix.
#pragma once

#include "core/reader/formats/pbrt/parameters.h"
#include "core/reader/formats/pbrt/tokens.h"

#include <optional>

namespace neumann::reader::pbrt {

// How many numbers follow the directive; nothing if it changes no matrix.
std::optional<std::size_t> transform_size(const std::string& directive);
// The matrix after a directive with these numbers; it may have no inverse. Throws InputError.
Mat4 transformed_by(const std::string& directive, const std::vector<double>& numbers, const Mat4& current, const Location& place);

}  // namespace neumann::reader::pbrt
