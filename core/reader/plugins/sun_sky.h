// Reads <emitter type="sunsky">.
#pragma once

#include "core/emitter/environment.h"
#include "core/reader/plugins/context.h"
#include "core/reader/xml/properties.h"

namespace neumann::reader {

// The sun is black if it is below the horizon, as in Mitsuba.
Environment read_sunsky(Properties& p, const Context& context);

}  // namespace neumann::reader
