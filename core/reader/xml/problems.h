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
class AlreadyReported : public InputError {
public:
    AlreadyReported() : InputError("a problem that has been told") {}
};

// Thrown for something that is not known here, as opposed to something that is wrong.
class Unknown : public InputError {
public:
    // As an error the message is `what` and `expected`, which begins with the punctuation between them; to a lenient
    // reader it is `what` and what it does `instead`, such as "left out".
    Unknown(const Location& place, const std::string& what, const std::string& expected, const std::string& instead)
        : InputError(place, what + expected), replaced_(to_string(place) + ": " + what + "; " + instead) {}

    const std::string& replaced() const { return replaced_; }

private:
    std::string replaced_;
};

// Problems may be added from several threads at once.
class Problems {
public:
    // `lenient`: what is unknown is no problem; it is listed, and the reader goes on with the replacement.
    explicit Problems(bool lenient = false) : lenient_(lenient) {}
    bool lenient() const { return lenient_; }

    // `near` is the element that was being read. Problems that name no line of a scene file, such as those of meshes, are listed
    // there.
    void add(const InputError& problem, const Location& near);
    // Lists what is unknown if the reader is lenient, and otherwise throws it.
    void replace(const Unknown& unknown, const Location& near);

    // Calls f and returns its result, or nothing if it throws InputError. If f returns void, returns whether it did not throw.
    template <class F>
    auto attempt(const Location& near, F&& f) {
        using Result = std::invoke_result_t<F>;
        if constexpr (std::is_void_v<Result>) {
            return attempt(near, [&] { return f(), true; }).has_value();
        } else {
            try {
                return std::optional<Result>(f());
            } catch (const AlreadyReported&) {
                expect_reported(near);
            } catch (const InputError& problem) {
                add(problem, near);
            }
            return std::optional<Result>();
        }
    }

    bool any() const;
    // Throws InputError if there are problems: one per line, without repetition, in the order of the scene files and
    // their lines. It is an UnknownError if a lenient reader would have had none.
    void check(const std::vector<std::string>& files) const;
    // What a lenient reader replaced or left out, in the same order.
    std::vector<std::string> replaced(const std::vector<std::string>& files) const;

private:
    // Adds a problem if none explains why something could not be read, so that nothing is left out silently.
    void expect_reported(const Location& near);

    bool lenient_;
    mutable std::mutex mutex_;
    std::map<std::string, Location> near_, replaced_;  // by message
    bool all_unknown_ = true;
};

}  // namespace neumann::reader
