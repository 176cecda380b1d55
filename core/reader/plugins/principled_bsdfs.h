// Reads <bsdf type="principled"> and <bsdf type="principledthin">.
#pragma once

#include "core/material/bsdf.h"
#include "core/reader/plugins/context.h"

#include <optional>

namespace neumann::reader {

struct PrincipledSides {
    Bsdf outside;
    std::optional<Bsdf> inside;  // the inner side, if the material transmits light
};
PrincipledSides read_principled(const Element& e, const Context& context);
Bsdf read_principled_thin(const Element& e, const Context& context);

}  // namespace neumann::reader
