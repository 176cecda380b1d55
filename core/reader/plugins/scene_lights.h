// Reads the <emitter>s without a shape: `constant`, `envmap` and `sunsky`, which surround the scene, and `directional`,
// `point`, `projector` and `spot`, which have no extent.
#pragma once

#include "core/emitter/emitters.h"
#include "core/reader/plugins/context.h"
#include "core/reader/xml/properties.h"

namespace neumann::reader {

// Reads a factor of radiance; 1 if it is missing.
double read_scale(Properties& p, const std::string& name);

class SceneLights {
public:
    explicit SceneLights(const Context& context) : context_(context) {}

    // Throws InputError for an emitter with errors, or for a second environment. Ignores lights of shapes, which AreaLights reads.
    void add(const Element& e);

    std::optional<Environment> take_environment() { return std::move(environment_); }
    std::vector<DeltaLight> take_delta() { return std::move(delta_); }

private:
    void set_environment(const Element& e, Environment environment);

    const Context& context_;
    std::optional<Environment> environment_;
    Location environment_place_;
    std::vector<DeltaLight> delta_;
};

}  // namespace neumann::reader
