// The processes that render fields on patches together with this one.
#pragma once

#include "operators/render/from_fields/field_progress.h"
#include "operators/watch.h"

#include <optional>

namespace neumann {

class Scene;

class FieldTeam {
public:
    virtual ~FieldTeam() = default;
    // The number of these processes that share the memory of this machine.
    virtual int on_this_machine() const = 0;
    // Calls render_fields() in all of them.
    virtual std::optional<FieldPictures> render(const Scene& scene, const FieldSettings& settings, const Watch& watch,
                                                FieldSaving* saving) = 0;
};

}  // namespace neumann
