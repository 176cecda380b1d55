// What a command may take of the machine.
#pragma once

#include <memory>
#include <optional>

namespace neumann {

// Bytes, of so many GiB; half of what there is without them.
double memory_limit(const std::optional<double>& gibibytes);

// While it lives there are at most so many threads; all with 0.
class ThreadLimit {
public:
    explicit ThreadLimit(int threads);
    ~ThreadLimit();

private:
    struct Limit;
    std::unique_ptr<Limit> limit_;
};

}  // namespace neumann
