// The methods that compute the terms of the series: a closed set, each with its own options and no others.
#pragma once

#include "core/scene/scene.h"
#include "operators/walk/walk_settings.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <variant>

namespace neumann {

namespace method {

enum class LeavingOut {
    by_plan,  // what the scene does not need, as its plan tells (operators/plan)
    nothing
};

// Of all that make paths.
struct PathOptions {
    std::optional<SamplerKind> sampler = {};  // the scene's without it, and Sobol' points where that has none
    LeavingOut plan = LeavingOut::by_plan;
    bool operator==(const PathOptions&) const = default;
};

// From the camera, by directions of the materials: one walk for all bounces.
struct Walk : PathOptions {
    static constexpr const char* name = "walk";
    DirectLightSettings direct = {};
    Roulette roulette = {};
    Split split = {};
    bool operator==(const Walk&) const = default;
};

// The same by directions from which light comes, as tables tell.
struct Guided : PathOptions {
    static constexpr const char* name = "guided";
    std::optional<std::size_t> patches = {};
    std::optional<std::uint32_t> directions = {};
    bool operator==(const Guided&) const = default;
};

// The same by points on all surfaces.
struct Surface : PathOptions {
    static constexpr const char* name = "surface";
    bool operator==(const Surface&) const = default;
};

// From the lights to the camera.
struct Light : PathOptions {
    static constexpr const char* name = "light";
    Roulette roulette = {};
    bool operator==(const Light&) const = default;
};

// From both ends, joined everywhere.
struct Bidirectional : PathOptions {
    static constexpr const char* name = "bidirectional";
    DirectLightSettings direct = {};  // of both, as it asks for lights and hits them
    Roulette roulette = {};
    Split split = {};
    std::optional<int> ways = {};  // the bounce of which every way is shown (ways.h)
    bool operator==(const Bidirectional&) const = default;
};

// The walk in mirrors and through glass alone.
struct Classic : PathOptions {
    static constexpr const char* name = "classic";
    bool operator==(const Classic&) const = default;
};

// Each bounce by itself.
struct Pointwise : PathOptions {
    static constexpr const char* name = "pointwise";
    bool operator==(const Pointwise&) const = default;
};

// Of all that have fields on patches. What is not given is chosen by the goal.
struct FieldOptions {
    std::optional<std::size_t> patches = {};
    std::optional<std::uint32_t> directions = {};  // rays of a side of a patch, of all replicates
    bool operator==(const FieldOptions&) const = default;
};

// T and R on patches, read at the pixel.
struct Matrix : FieldOptions {
    static constexpr const char* name = "matrix";
    bool operator==(const Matrix&) const = default;
};

// The same with K once more at the pixel.
struct Gather : FieldOptions {
    static constexpr const char* name = "gather";
    bool operator==(const Gather&) const = default;
};

// The patches as they are.
struct Patches : FieldOptions {
    static constexpr const char* name = "patches";
    bool importance = false;  // pictures of K*^i We
    bool operator==(const Patches&) const = default;
};

}  // namespace method

using Method = std::variant<method::Walk, method::Guided, method::Surface, method::Light, method::Bidirectional, method::Classic,
                            method::Pointwise, method::Matrix, method::Gather, method::Patches>;

inline const char* name_of(const Method& method) {
    return std::visit([](const auto& m) { return m.name; }, method);
}

template <class M>
concept MakesPaths = std::derived_from<M, method::PathOptions>;
template <class M>
concept HasFields = std::derived_from<M, method::FieldOptions>;

inline bool has_fields(const Method& method) {
    return std::visit([]<class M>(const M&) { return HasFields<M>; }, method);
}

}  // namespace neumann
