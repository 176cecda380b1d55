// Collects all errors of a scene, so that they are reported at once. The reader of an element catches InputError, adds it, and goes
// on with a neutral replacement. Elements that depend on a broken one report no errors of their own because of it.
#pragma once

#include "core/base/error.h"

#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <type_traits>
#include <vector>

namespace neumann::reader {

// Thrown if something cannot be read because of a problem that is already in the list.
class Told : public InputError {
public:
    Told() : InputError("a problem that has been told") {}
};

// May be added to from several threads at once.
class Problems {
public:
    // `near` is the element that was being read. Problems that name no line of a scene file, such as those of meshes, are listed
    // there.
    void add(const InputError& problem, const Location& near);

    // Calls f and returns its result, or nothing if it throws InputError. If f returns void: whether it did not throw.
    template <class F>
    auto attempt(const Location& near, F&& f) {
        using Result = std::invoke_result_t<F>;
        if constexpr (std::is_void_v<Result>) {
            return attempt(near, [&] { return f(), true; }).has_value();
        } else {
            try {
                return std::optional<Result>(f());
            } catch (const Told&) {
            } catch (const InputError& problem) {
                add(problem, near);
            }
            return std::optional<Result>();
        }
    }

    bool any() const;
    // Throws InputError if there are problems: one per line, without repetition, in the order of the scene files and their lines.
    void check(const std::vector<std::string>& files) const;

private:
    mutable std::mutex mutex_;
    std::map<std::string, Location> near_;  // by message
};

}  // namespace neumann::reader
