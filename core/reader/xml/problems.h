// All that is wrong with a scene, told at once. What reads an element catches InputError there, keeps it, and goes on with
// something neutral in its place; what depends on that element then adds nothing of its own.
#pragma once

#include "core/base/error.h"

#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <type_traits>
#include <vector>

namespace neumann::reader {

// Something cannot be read because of a problem that is in the list already.
class Told : public InputError {
public:
    Told() : InputError("a problem that has been told") {}
};

// May be added to from several threads at once.
class Problems {
public:
    // `near` is the element that was being read. What names no line of a scene file, such as a mesh, is listed there.
    void add(const InputError& problem, const Location& near);

    // What `f` returns, or nothing where it throws InputError; of what returns nothing, whether it ends.
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
    // Throws InputError if there is a problem: one a line, each once, in the order of the scene files and of their lines.
    void check(const std::vector<std::string>& files) const;

private:
    mutable std::mutex mutex_;
    std::map<std::string, Location> near_;  // by message
};

}  // namespace neumann::reader
