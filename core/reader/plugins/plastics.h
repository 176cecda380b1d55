// Reads <bsdf type="plastic"> and <bsdf type="roughplastic">.
#pragma once

#include "core/material/bsdf.h"
#include "core/reader/plugins/context.h"

namespace neumann::reader {

Bsdf read_plastic(const Element& e, const Context& context);
Bsdf read_rough_plastic(const Element& e, const Context& context);

}  // namespace neumann::reader
